#include "emulator/world/expression/number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/simulated_time.h"

namespace understudy::emulator::world {

namespace {

constexpr double kTwoTo63 = 9223372036854775808.0;
constexpr std::int64_t kBits = 64;

std::weak_ordering compare(std::int64_t whole, double real) {
  if (real >= kTwoTo63) return std::weak_ordering::less;
  if (real < -kTwoTo63) return std::weak_ordering::greater;
  const auto cut = static_cast<std::int64_t>(real);
  if (whole != cut) return whole <=> cut;
  const double rest = real - static_cast<double>(cut);  // exact, because the two are close or the rest is 0
  return rest > 0   ? std::weak_ordering::less
         : rest < 0 ? std::weak_ordering::greater
                    : std::weak_ordering::equivalent;
}

[[noreturn]] void overflow() { throw ArithmeticError("the result does not fit into 64 bits"); }

double finite(double real) {
  if (!std::isfinite(real)) throw ArithmeticError("the result is too large");
  return real;
}

[[noreturn]] void division_by_zero() { throw ArithmeticError("division by zero"); }

std::int64_t shifted(Operator operation, std::int64_t a, std::int64_t places) {
  if (places < 0 || places >= kBits) {
    throw ArithmeticError("a shift by " + std::to_string(places) + " places; expected 0 to 63");
  }
  if (operation == Operator::shift_right) return a >> places;
  const auto result = static_cast<std::int64_t>(static_cast<std::uint64_t>(a) << places);
  if (result >> places != a) overflow();
  return result;
}

Number apply_to_wholes(Operator operation, std::int64_t a, std::int64_t b) {
  std::int64_t result = 0;
  switch (operation) {
    case Operator::add:
      if (__builtin_add_overflow(a, b, &result)) overflow();
      return result;
    case Operator::subtract:
      if (__builtin_sub_overflow(a, b, &result)) overflow();
      return result;
    case Operator::multiply:
      if (__builtin_mul_overflow(a, b, &result)) overflow();
      return result;
    case Operator::divide:
      if (b == 0) division_by_zero();
      if (a == INT64_MIN && b == -1) overflow();
      return a / b;
    case Operator::remainder:
      if (b == 0) division_by_zero();
      return b == -1 ? 0 : a % b;  // because INT64_MIN % -1 traps on some processors
    case Operator::bit_or: return a | b;
    case Operator::bit_xor: return a ^ b;
    case Operator::bit_and: return a & b;
    case Operator::shift_left:
    case Operator::shift_right: return shifted(operation, a, b);
    default: throw std::logic_error("not an operator of two whole numbers");
  }
}

Number apply_to_reals(Operator operation, double a, double b) {
  switch (operation) {
    case Operator::add: return finite(a + b);
    case Operator::subtract: return finite(a - b);
    case Operator::multiply: return finite(a * b);
    case Operator::divide:
      if (b == 0) division_by_zero();
      return finite(a / b);
    default: throw ArithmeticError("bits, shifts and '%' require whole numbers");
  }
}

// Returns "2.5" for 2500 thousandths, exactly.
std::string decimal(std::int64_t value, std::int64_t one) {
  const bool negative = value < 0;
  const std::uint64_t magnitude =
      negative ? -static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
  const auto unit = static_cast<std::uint64_t>(one);
  std::string text = (negative ? "-" : "") + std::to_string(magnitude / unit);
  if (const std::uint64_t rest = magnitude % unit; rest != 0) {
    std::string digits = std::to_string(rest + unit).substr(1);
    while (digits.back() == '0') digits.pop_back();
    text += "." + digits;
  }
  return text;
}

std::string shortest(double real) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), real).ptr;
  return {digits.data(), end};
}

}  // namespace

std::weak_ordering operator<=>(Number a, Number b) {
  if (a.is_whole() && b.is_whole()) return a.whole() <=> b.whole();
  if (a.is_whole()) return compare(a.whole(), b.real());
  if (b.is_whole()) {
    const std::weak_ordering turned = compare(b.whole(), a.real());
    return std::is_lt(turned)   ? std::weak_ordering::greater
           : std::is_gt(turned) ? std::weak_ordering::less
                                : std::weak_ordering::equivalent;
  }
  return a.real() < b.real()   ? std::weak_ordering::less
         : a.real() > b.real() ? std::weak_ordering::greater
                               : std::weak_ordering::equivalent;
}

Number finite_number(double value) {
  constexpr double kLargest = 9e15;  // doubles hold all whole numbers up to this one
  if (std::isnan(value)) return 0;
  if (std::abs(value) <= kLargest && std::floor(value) == value) return static_cast<std::int64_t>(value);
  return std::clamp(value, -std::numeric_limits<double>::max(), std::numeric_limits<double>::max());
}

std::string kind_of(Unit unit) {
  switch (unit) {
    case Unit::nanoseconds: return "a duration";
    case Unit::millivolts: return "a voltage";
    case Unit::none: break;
  }
  return "a number";
}

std::string number_text(Number number, Unit unit) {
  if (!number.is_whole()) {
    return shortest(number.real()) + (unit == Unit::nanoseconds  ? "ns"
                                      : unit == Unit::millivolts ? "mV"
                                                                 : "");
  }
  const std::int64_t whole = number.whole();
  if (unit == Unit::nanoseconds && whole != INT64_MIN) return format_duration(SimTime{whole});
  if (unit == Unit::nanoseconds) return std::to_string(whole) + "ns";
  if (unit == Unit::none) return std::to_string(whole);
  return whole > -1000 && whole < 1000 && whole != 0 ? std::to_string(whole) + "mV"
                                                     : decimal(whole, 1000) + "V";
}

Number apply(Operator operation, Number a, Number b) {
  switch (operation) {
    case Operator::logical_or: return a.is_true() || b.is_true();
    case Operator::logical_and: return a.is_true() && b.is_true();
    case Operator::equal: return a == b;
    case Operator::not_equal: return a != b;
    case Operator::less: return a < b;
    case Operator::less_or_equal: return a <= b;
    case Operator::greater: return a > b;
    case Operator::greater_or_equal: return a >= b;
    case Operator::minimum: return b < a ? b : a;
    case Operator::maximum: return b > a ? b : a;
    default: break;
  }
  if (a.is_whole() && b.is_whole()) return apply_to_wholes(operation, a.whole(), b.whole());
  return apply_to_reals(operation, a.real(), b.real());
}

Number apply(Operator operation, Number a) {
  switch (operation) {
    case Operator::logical_not: return !a.is_true();
    case Operator::negate:
      if (!a.is_whole()) return -a.real();
      if (a.whole() == INT64_MIN) overflow();
      return -a.whole();
    case Operator::absolute: return a < 0 ? apply(Operator::negate, a) : a;
    case Operator::bit_not:
      if (!a.is_whole()) throw ArithmeticError("bits, shifts and '%' require whole numbers");
      return ~a.whole();
    default: throw std::logic_error("not an operator of one number");
  }
}

Bounds bounds_around(Number centre, Number tolerance) {
  if (tolerance < 0) throw ArithmeticError("a tolerance below zero (" + number_text(tolerance) + ")");
  if (centre.is_whole() && tolerance.is_whole()) {
    // A limit that does not fit in 64 bits is never reached by a whole number.
    std::int64_t low = 0;
    std::int64_t high = 0;
    const bool no_low = __builtin_sub_overflow(centre.whole(), tolerance.whole(), &low);
    const bool no_high = __builtin_add_overflow(centre.whole(), tolerance.whole(), &high);
    return {no_low ? Number(std::min(-kTwoTo63, centre.real() - tolerance.real())) : Number(low),
            no_high ? Number(std::max(kTwoTo63, centre.real() + tolerance.real())) : Number(high)};
  }
  return {finite(centre.real() - tolerance.real()), finite(centre.real() + tolerance.real())};
}

Number share_of(Number number, std::int64_t millionths_of_a_percent) {
  const Number magnitude =
      number.is_whole() && number.whole() == INT64_MIN ? Number(kTwoTo63) : apply(Operator::absolute, number);
  constexpr std::int64_t kAll = 100 * kPercent;
  std::int64_t product = 0;
  if (magnitude.is_whole() && !__builtin_mul_overflow(magnitude.whole(), millionths_of_a_percent, &product) &&
      product % kAll == 0) {
    return product / kAll;
  }
  return finite(magnitude.real() * static_cast<double>(millionths_of_a_percent) / static_cast<double>(kAll));
}

}  // namespace understudy::emulator::world
