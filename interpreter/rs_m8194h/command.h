// One command or macro line, as a value.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "interpreter/rs_m8194h/commands.h"

namespace understudy::interpreter::rs_m8194h {

/// Values that are not parameters are 0. Signed numbers are in two's complement, real numbers are stored as
/// their bits. Comparison operators have the codes of operators.h, whichever letter order the host used.
struct Command {
  std::uint16_t code = 0;
  std::array<std::uint32_t, kMaxParameters> values = {};

  constexpr Verb verb() const { return verb_of(code); }
  constexpr bool is_macro_line() const { return is_macro_code(code); }
  constexpr const CommandRow& row() const { return row_of(verb()); }
  constexpr std::int32_t signed_value(std::size_t parameter) const {
    return static_cast<std::int32_t>(values[parameter]);
  }
  /// Returns a parameter as a number, signed if its width is signed.
  constexpr std::int64_t number(std::size_t parameter) const {
    const bool has_sign = row().parameters[parameter].width == Width::signed_long;
    return has_sign ? std::int64_t{signed_value(parameter)} : std::int64_t{values[parameter]};
  }

  bool operator==(const Command&) const = default;
};

/// Returns true if a value stands for VARn.
constexpr bool is_variable(std::uint32_t value) {
  return value >= kVariable0 && value < kVariable0 + kVariableCount;
}
/// Returns true if a byte stands for bVARn.
constexpr bool is_byte_variable(std::uint32_t value) {
  return value >= kByteVariable0 && value < kByteVariable0 + kByteVariableCount;
}
constexpr std::size_t variable_number(std::uint32_t value) {
  return static_cast<std::size_t>(value - kVariable0);
}
constexpr std::size_t byte_variable_number(std::uint32_t value) {
  return static_cast<std::size_t>(value - kByteVariable0);
}

/// Returns true if a parameter of a macro line is read from a variable when the line runs. This includes
/// operands of program flow.
constexpr bool is_reference(const Command& command, std::size_t parameter) {
  if (!command.is_macro_line()) return false;
  const Parameter& row = command.row().parameters[parameter];
  const std::uint32_t value = command.values[parameter];
  if (row.reference == Reference::variable) return is_variable(value);
  return row.reference == Reference::byte_variable && is_byte_variable(value);
}

}  // namespace understudy::interpreter::rs_m8194h
