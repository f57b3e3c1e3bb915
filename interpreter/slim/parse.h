// Parses one line of text into a command. availability.h decides whether the command is allowed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"

namespace understudy::interpreter::slim {

inline constexpr std::size_t kLineLength = 127;
/// The longest line of any dialect.
inline constexpr std::size_t kLongestLine = 255;

/// Options about the language that the manual leaves open.
struct Dialect {
  /// `T1MA R0` is refused, or accepted: the manual prints variables for MA and XMA, and "the same function"
  /// for TpMA, without printing its syntax.
  enum class ModuleMoveFromVariable : std::uint8_t {
    refused,
    accepted
  } module_move_from_variable = ModuleMoveFromVariable::refused;
  std::size_t longest_line = kLineLength;  // longer lines are refused
  int integer_min = kIntegerMin;           // the minimum of integer variables
  int event_count = kEventCount;           // EV1 to EVn; 1 .. kEventCount
  bool helix_constants = true;  // SAA R0,R1,90,5 is accepted, as its form is printed, besides four variables
  bool quantities = false;      // the value of a query is also a function: N0=PE, JG VM,R0,$A

  bool operator==(const Dialect&) const = default;
};

struct ParseResult {
  Error error = Error::none;  // syntax or range, if there is an error
  ParsedLine line = {};       // valid if there is no error

  bool operator==(const ParseResult&) const = default;
};

/// The union of all dialects, for text that a dialect has accepted already.
inline constexpr Dialect kWidestDialect{.longest_line = kLongestLine, .quantities = true};

/// Parses a line and checks everything that needs no state. An empty line is not an error.
ParseResult parse_line(std::string_view text, const Dialect& dialect = {});

/// Parses a decimal number as a host writes it: sign, digits, point, exponent. Returns nothing for anything
/// else.
std::optional<Operand> parse_number(std::string_view text);

}  // namespace understudy::interpreter::slim
