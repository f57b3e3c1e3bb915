#include "emulator/play/reading/amounts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/world/expression/number.h"

namespace understudy::emulator::play {

namespace {

constexpr std::size_t kMaxDigits = 15;
constexpr std::int64_t kMaxCounted = INT64_MAX / 2;  // the difference between two amounts is also counted

struct AmountUnit {
  std::string_view name;
  Amount::Kind kind;
  std::int64_t size;
};
constexpr std::array<AmountUnit, 9> kAmountUnits{{{"", Amount::Kind::number, 1},
                                                  {"ns", Amount::Kind::duration, 1},
                                                  {"us", Amount::Kind::duration, 1'000},
                                                  {"ms", Amount::Kind::duration, 1'000'000},
                                                  {"s", Amount::Kind::duration, 1'000'000'000},
                                                  {"min", Amount::Kind::duration, 60'000'000'000},
                                                  {"h", Amount::Kind::duration, 3'600'000'000'000},
                                                  {"mV", Amount::Kind::voltage, 1},
                                                  {"V", Amount::Kind::voltage, 1'000}}};

std::int64_t power_of_ten(int exponent) {
  std::int64_t power = 1;
  for (; exponent > 0; --exponent) power *= 10;
  return power;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::optional<Amount> parse_amount(std::string_view text) {
  Amount amount;
  const bool is_negative = text.starts_with('-');
  if (is_negative) text.remove_prefix(1);
  std::size_t digits = 0;
  bool has_point = false;
  while (!text.empty() && (is_digit(text.front()) || (text.front() == '.' && !has_point))) {
    if (text.front() == '.') {
      has_point = true;
    } else {
      amount.digits = 10 * amount.digits + (text.front() - '0');
      if (has_point) ++amount.decimals;
      if (++digits > kMaxDigits) return std::nullopt;
    }
    text.remove_prefix(1);
  }
  if (digits == 0 || (has_point && amount.decimals == 0)) return std::nullopt;
  if (is_negative) amount.digits = -amount.digits;
  while (text.starts_with(' ')) text.remove_prefix(1);
  const auto* const unit = std::find_if(kAmountUnits.begin(), kAmountUnits.end(),
                                        [&](const auto& row) { return row.name == text; });
  if (unit == kAmountUnits.end()) return std::nullopt;
  amount.kind = unit->kind;
  amount.unit = unit->size;
  return amount;
}

std::string_view kind_name(Amount::Kind kind) {
  switch (kind) {
    case Amount::Kind::number: return "a number";
    case Amount::Kind::duration: return "a duration";
    case Amount::Kind::voltage: return "a voltage";
  }
  return "";
}

void AmountScale::include(const Amount& amount) {
  if (kind_ == Amount::Kind::number) {
    decimals_ = std::max(decimals_, amount.decimals);
    finest_ = 1;
    return;
  }
  const std::int64_t digit = std::max(amount.unit / power_of_ten(amount.decimals), std::int64_t{1});
  finest_ = finest_ == 0 ? digit : std::min(finest_, digit);
}

std::optional<std::int64_t> AmountScale::count_of(const Amount& amount) const {
  const bool is_number = kind_ == Amount::Kind::number;
  const std::int64_t size = is_number ? power_of_ten(decimals_ - amount.decimals) : amount.unit;
  std::int64_t count = 0;
  if (__builtin_mul_overflow(amount.digits, size, &count)) return {};
  if (!is_number) {
    const std::int64_t parts = power_of_ten(amount.decimals);
    if (count % parts != 0) return {};
    count /= parts;
  }
  if (count > kMaxCounted || count < -kMaxCounted) return {};
  return count;
}

std::string AmountScale::text_of(std::int64_t count) const {
  if (kind_ == Amount::Kind::voltage) return world::number_text(count, world::Unit::millivolts);
  if (kind_ == Amount::Kind::duration) return format_duration(SimTime{count});
  if (decimals_ == 0) return std::to_string(count);
  const std::int64_t one = power_of_ten(decimals_);
  const std::int64_t size = count < 0 ? -count : count;
  return (count < 0 ? "-" : "") + std::to_string(size / one) + "." +
         std::to_string(size % one + one).substr(1);
}

}  // namespace understudy::emulator::play
