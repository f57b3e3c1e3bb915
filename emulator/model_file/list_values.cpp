#include "emulator/model_file/list_values.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/parse_integer.h"

namespace understudy::emulator::model_file {

namespace {

constexpr int kMaxDigits = 12;
constexpr int kMaxPlaces = 9;

std::string_view bare(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\"'";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Returns the length of the decimal number at the beginning of the text, or 0.
std::size_t length_of_decimal(std::string_view text) {
  std::size_t at = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  const std::size_t begin = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  if (at == begin) return 0;
  const bool continues =
      at + 1 < text.size() && (text[at] == '.' || text[at] == ',') && is_digit(text[at + 1]);
  if (!continues) return at;
  ++at;
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

std::int64_t power_of_ten(int exponent) {
  std::int64_t power = 1;
  for (; exponent > 0; --exponent) power *= 10;
  return power;
}

}  // namespace

std::optional<Decimal> parse_decimal(std::string_view text, bool may_have_unit) {
  const std::size_t length = length_of_decimal(text);
  if (length == 0 || (length < text.size() && !may_have_unit)) return std::nullopt;
  Decimal made;
  bool is_behind_point = false;
  int digits = 0;
  for (const char c : text.substr(0, length)) {
    if (c == '.' || c == ',') is_behind_point = true;
    if (!is_digit(c)) continue;
    made.digits = made.digits * 10 + (c - '0');
    if (made.digits != 0) ++digits;
    if (is_behind_point) ++made.places;
    if (digits > kMaxDigits || made.places > kMaxPlaces) return std::nullopt;
  }
  if (text.front() == '-') made.digits = -made.digits;
  return made;
}

bool has_decimals(std::string_view text) {
  const std::size_t length = length_of_decimal(text);
  return text.substr(0, length).find_first_of(".,") != std::string_view::npos;
}

std::optional<std::int64_t> counts_of(const Decimal& value, const Step& step) {
  // Computes (value - offset) / step with integers, in units of the last decimal place.
  const int places = std::max({value.places, step.offset.places, step.step.places});
  const auto whole = [&](const Decimal& number) -> std::optional<std::int64_t> {
    std::int64_t made = 0;
    if (__builtin_mul_overflow(number.digits, power_of_ten(places - number.places), &made))
      return std::nullopt;
    return made;
  };
  const auto from = whole(value);
  const auto offset = whole(step.offset);
  const auto one = whole(step.step);
  std::int64_t above = 0;
  if (!from || !offset || !one || *one == 0 || __builtin_sub_overflow(*from, *offset, &above))
    return std::nullopt;
  if (above % *one != 0) return std::nullopt;
  return above / *one;
}

std::optional<Step> step_of_unit(std::string_view unit) {
  const auto step = parse_decimal(unit, true);
  if (!step || step->digits <= 0) return std::nullopt;
  return Step{.step = *step, .offset = {}, .text = std::string(unit)};
}

std::optional<Step> step_of_scale(std::string_view scale) {
  std::string_view text = bare(scale);
  bool divides = false;
  for (const std::string_view sign : {"1/", "/", "x", "X", "*", "×"}) {
    if (!text.starts_with(sign)) continue;
    divides = sign.ends_with('/');
    text = bare(text.substr(sign.size()));
    break;
  }
  const auto number = parse_decimal(text, false);
  if (!number || number->digits <= 0) return std::nullopt;
  const bool is_whole = number->places == 0 && number->digits > 1;
  if (!is_whole)
    return divides ? std::nullopt : std::optional(Step{.step = *number, .text = std::string(scale)});
  int places = 0;
  while (places < kMaxPlaces && power_of_ten(places) < number->digits) ++places;
  if (power_of_ten(places) != number->digits)
    return divides ? std::nullopt
                   : std::optional(Step{.step = *number, .offset = {}, .text = std::string(scale)});
  return Step{.step = {1, places}, .offset = {}, .text = std::string(scale)};
}

std::optional<std::pair<std::string, std::string>> ends_of(const std::string& range) {
  constexpr std::array<std::string_view, 9> kBetween{"...", "..", " to ", "~", "～", "–", "—", "至", "-"};
  for (const std::string_view between : kBetween) {
    const std::size_t at = range.find(between, 1);
    if (range.empty() || at == std::string::npos) continue;
    return std::pair(std::string(bare(std::string_view(range).substr(0, at))),
                     std::string(bare(std::string_view(range).substr(at + between.size()))));
  }
  return std::nullopt;
}

std::optional<std::vector<NamedValue>> parse_enumeration(std::string_view text) {
  std::vector<NamedValue> all;
  text = bare(text);
  if (text.starts_with('{') && text.ends_with('}')) text = text.substr(1, text.size() - 2);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(",;|", begin), text.size());
    const std::string_view part = bare(text.substr(begin, end - begin));
    begin = end + 1;
    if (part.empty()) continue;
    const std::size_t sign = part.find_first_of(":=", 1);
    if (sign == std::string_view::npos) return std::nullopt;
    std::string_view key = bare(part.substr(0, sign));
    const std::string_view name = bare(part.substr(sign + 1));
    NamedValue made{.name = std::string(name)};
    made.is_bit = key.starts_with('b') && key.size() > 1;
    if (made.is_bit) key.remove_prefix(1);
    const auto value = parse_integer(key);
    if (!value || name.empty()) return std::nullopt;
    made.value = *value;
    all.push_back(std::move(made));
  }
  return all.empty() ? std::nullopt : std::optional(std::move(all));
}

std::optional<std::int64_t> as_bcd(std::int64_t number, int words) {
  if (number < 0) return std::nullopt;
  std::int64_t made = 0;
  int shift = 0;
  for (; number > 0; number /= 10, shift += 4) {
    if (shift >= 16 * words) return std::nullopt;
    made |= (number % 10) << shift;
  }
  return made;
}

}  // namespace understudy::emulator::model_file
