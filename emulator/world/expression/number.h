// The values of expressions: 64-bit whole numbers, or real numbers.
//
// Registers, positions, durations (nanoseconds) and voltages (millivolts) are whole. Arithmetic on whole
// numbers is either exact or refused, but never rounded. Speeds in pulses per second, and literals with a
// decimal point, are real. A single type cannot represent both: a double rounds a 64-bit count, and an
// integer would turn 1500.4 pps into 1500. A real number is always finite; an infinite result is refused.
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>

namespace understudy::emulator::world {

class Number {
 public:
  constexpr Number() = default;
  template <std::integral T>
  requires(sizeof(T) < 8 || std::signed_integral<T>) constexpr Number(T whole)
      : value_(static_cast<std::int64_t>(whole)) {}
  constexpr Number(double real) : value_(real) {}

  constexpr bool is_whole() const { return std::holds_alternative<std::int64_t>(value_); }
  /// Call this only if is_whole().
  constexpr std::int64_t whole() const { return *std::get_if<std::int64_t>(&value_); }
  /// Returns the nearest real number.
  constexpr double real() const {
    return is_whole() ? static_cast<double>(whole()) : *std::get_if<double>(&value_);
  }
  constexpr bool is_true() const { return is_whole() ? whole() != 0 : real() != 0; }

 private:
  std::variant<std::int64_t, double> value_{std::int64_t{0}};
};

/// Compares exactly, even a whole number with a real number: 9007199254740993 is greater than
/// 9007199254740992.0.
std::weak_ordering operator<=>(Number a, Number b);
inline bool operator==(Number a, Number b) { return (a <=> b) == std::weak_ordering::equivalent; }

/// Converts a real number from a device: to a whole number if it is one, to the nearest finite number if it
/// is infinite, to 0 if it is NaN.
Number finite_number(double value);

/// The unit of a number. Numbers with different units cannot be compared or added.
enum class Unit : std::uint8_t { none, nanoseconds, millivolts };

/// Returns "a number", "a duration" or "a voltage", for messages.
std::string kind_of(Unit unit);
/// Returns the exact text: "-5", "1500.25", "3.05s", "2.5V", "300mV". For a real number, it is the shortest
/// text that parses to the same number.
std::string number_text(Number number, Unit unit = Unit::none);

/// Thrown for an operation without a result (overflow, division by zero, bits of a real number). The message
/// is one line.
struct ArithmeticError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Operator : std::uint8_t {
  // Operators with two operands.
  logical_or,
  logical_and,
  bit_or,
  bit_xor,
  bit_and,
  equal,
  not_equal,
  less,
  less_or_equal,
  greater,
  greater_or_equal,
  shift_left,
  shift_right,
  add,
  subtract,
  multiply,
  divide,
  remainder,
  minimum,
  maximum,
  // Operators with one operand.
  negate,
  logical_not,
  bit_not,
  absolute,
};

/// Computes like C with 64 bits, but throws ArithmeticError if the result is not exact. The quotient of whole
/// numbers is truncated towards zero, `<<` multiplies by a power of two, and `>>` keeps the sign. If an
/// operand is real, the result is real.
Number apply(Operator operation, Number a, Number b);
Number apply(Operator operation, Number a);

/// The limits of `centre +- tolerance`. Both limits are included.
struct Bounds {
  Number low;
  Number high;
};
/// Throws ArithmeticError if the tolerance is negative.
Bounds bounds_around(Number centre, Number tolerance);

/// Percentages are in millionths of a percent, so that 0.57% is exact.
inline constexpr std::int64_t kPercent = 1'000'000;
/// Returns this share of a number's magnitude, as a whole number if possible.
Number share_of(Number number, std::int64_t millionths_of_a_percent);

}  // namespace understudy::emulator::world
