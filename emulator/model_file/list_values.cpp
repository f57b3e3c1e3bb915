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

namespace understudy::emulator::model_file {

namespace {

constexpr int kMaxDigits = 12;
constexpr int kMaxPlaces = 9;

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

}  // namespace

std::string_view bare(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\n\"'";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

std::int64_t power_of_ten(int exponent) {
  std::int64_t power = 1;
  for (; exponent > 0; --exponent) power *= 10;
  return power;
}

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

bool may_have_thousands(std::string_view text) {
  constexpr std::size_t kGroup = 3;
  const std::string_view number = text.substr(0, length_of_decimal(text));
  const std::size_t comma = number.find(',');
  if (comma == std::string_view::npos || number.size() - comma - 1 != kGroup) return false;
  const std::size_t first = number.find_first_of("0123456789");
  return number[first] != '0' && comma - first <= kGroup;
}

std::string plain_cell(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kSigns{
      {{"\u00A0", " "}, {"\u202F", " "}, {"\u2009", " "}, {"\u3000", " "}, {"\u2212", "-"}, {"\u3001", ","}}};
  constexpr std::array<std::string_view, 10> kNone{"-",   "--",   "---", "–",    "—",
                                                   "n/a", "n.a.", "na",  "none", "/"};
  std::string made;
  while (!text.empty()) {
    const auto* const sign = std::find_if(kSigns.begin(), kSigns.end(),
                                          [&](const auto& entry) { return text.starts_with(entry.first); });
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
    if (sign != kSigns.end()) {
      made += sign->second;
      text.remove_prefix(sign->first.size());
    } else if (text.size() >= 3 && byte(0) == 0xEF && (byte(1) == 0xBC || byte(1) == 0xBD)) {
      // U+FF01 to U+FF5E are the full-width forms of 0x21 to 0x7E.
      const int number = (byte(1) - 0xBC) * 0x40 + (byte(2) - 0x80);
      const bool is_full_width = number >= 1 && number <= 0x5E;
      made +=
          is_full_width ? std::string(1, static_cast<char>(0x20 + number)) : std::string(text.substr(0, 3));
      text.remove_prefix(3);
    } else {
      made += text.front();
      text.remove_prefix(1);
    }
  }
  const std::string_view word = bare(made);
  std::string key(word);
  for (char& c : key) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(kNone.begin(), kNone.end(), key) != kNone.end() ? "" : made;
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
  const std::string_view after = bare(unit.substr(length_of_decimal(unit)));
  const auto first = after.empty() ? 'a' : static_cast<unsigned char>(after.front());
  if (first < 0x80 && std::isalpha(first) == 0 && first != '%') return std::nullopt;  // "4-20 mA", "1/min"
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
  constexpr std::array<std::string_view, 12> kBetween{"...", "..", "…", " to ", " bis ", "~",
                                                      "～",  "÷",  "–", "—",    "至",    "-"};
  std::string_view text = bare(range);
  const bool has_brackets =
      (text.starts_with('(') && text.ends_with(')')) || (text.starts_with('[') && text.ends_with(']'));
  if (has_brackets) text = bare(text.substr(1, text.size() - 2));
  for (const std::string_view between : kBetween) {
    const std::size_t at = text.find(between, 1);
    if (text.empty() || at == std::string_view::npos) continue;
    return std::pair(std::string(bare(text.substr(0, at))),
                     std::string(bare(text.substr(at + between.size()))));
  }
  return std::nullopt;
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
