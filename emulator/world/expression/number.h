// The values of expressions: whole numbers of 64 bits, or real ones.
//
// Registers, positions, durations (nanoseconds) and voltages (millivolts) are whole, and whole arithmetic is
// exact or refused, never rounded. Only what is a quotient by nature is real: a speed in pulses per second,
// or a literal with a decimal point. One kind would not do for both: a double rounds a 64-bit count, and an
// integer makes 1500.4 pps pass for 1500. A real number is always finite: what would not be is refused.
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
  /// Only if is_whole().
  constexpr std::int64_t whole() const { return *std::get_if<std::int64_t>(&value_); }
  /// The nearest real number, if it is a whole one.
  constexpr double real() const {
    return is_whole() ? static_cast<double>(whole()) : *std::get_if<double>(&value_);
  }
  constexpr bool is_true() const { return is_whole() ? whole() != 0 : real() != 0; }

 private:
  std::variant<std::int64_t, double> value_{std::int64_t{0}};
};

/// Exact, also between a whole and a real number: 9007199254740993 is more than 9007199254740992.0.
std::weak_ordering operator<=>(Number a, Number b);
inline bool operator==(Number a, Number b) { return (a <=> b) == std::weak_ordering::equivalent; }

/// A number that a device holds: whole where it is, and as near as a number gets where it is infinite, or
/// none (then 0).
Number finite_number(double value);

/// What a number counts. A number of one unit is not compared with, or added to, one of another.
enum class Unit : std::uint8_t { none, nanoseconds, millivolts };

/// "a number", "a duration", "a voltage": for messages.
std::string kind_of(Unit unit);
/// "-5", "1500.25", "3.05s", "2.5V", "300mV": exact (a real number: the shortest that is read back as it).
std::string number_text(Number number, Unit unit = Unit::none);

/// An operation without a result, one line: overflow, a division by zero, bits of a real number.
struct ArithmeticError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Operator : std::uint8_t {
  // of two numbers
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
  // of one
  negate,
  logical_not,
  bit_not,
  absolute,
};

/// As C computes them on 64 bits, but exact or refused (ArithmeticError): a whole quotient is cut towards
/// zero, `<<` multiplies by a power of two, `>>` keeps the sign. With a real operand the result is real.
Number apply(Operator operation, Number a, Number b);
Number apply(Operator operation, Number a);

/// Where `centre +- tolerance` ends, both ends within.
struct Bounds {
  Number low;
  Number high;
};
/// ArithmeticError if the tolerance is negative.
Bounds bounds_around(Number centre, Number tolerance);

/// A percentage in millionths of a percent, so that 0.57% is exactly that.
inline constexpr std::int64_t kPercent = 1'000'000;
/// That share of a number's magnitude; whole if it comes out even.
Number share_of(Number number, std::int64_t millionths_of_a_percent);

}  // namespace understudy::emulator::world
