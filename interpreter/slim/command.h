// The contents of a program line, as values.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/slim/commands.h"

namespace understudy::interpreter::slim {

struct Operand {
  enum class Kind : std::uint8_t {
    integer,           // number; also inputs, lines, milliseconds
    real,              // number
    integer_variable,  // N#: the index
    real_variable,     // R#: the index
    integer_array,     // NS(i): the index, or the index of the N variable that contains it
    real_array,        // RS(i): like integer_array
    port,              // index 1 to 4
    label,             // text, in capitals, without the $
    text,              // text
    analog,            // AIN
    clock,             // TM
    get_integer,       // GETI
    get_real,          // GETR
    event,             // index 1 to 8
    condition,         // index: a Condition
    quantity,          // the value that the query ?text shows, as a function
  };
  Kind kind = Kind::integer;
  double number = 0;
  int index = 0;
  bool index_is_variable = false;
  std::string text = {};

  bool operator==(const Operand&) const = default;
};

struct Command {
  Verb verb = Verb::home;
  int row = 0;      // index in kCommands; a query with a module has the row of `?Tp`
  int module = -1;  // module of the prefix; -1: no prefix, so T0
  std::vector<Operand> operands = {};
  std::string name = {};  // of a parameter or a queried item, in capitals

  bool operator==(const Command&) const = default;
};

/// A parsed line, which may be empty or contain only a label.
struct ParsedLine {
  std::string label = {};  // in capitals, without the $
  std::optional<Command> command = {};

  bool operator==(const ParsedLine&) const = default;
};

/// Returns true for GETI and GETR.
constexpr bool asks_host(Operand::Kind kind) {
  return kind == Operand::Kind::get_integer || kind == Operand::Kind::get_real;
}
/// Returns true if the command waits for a number from the host.
inline bool asks_host(const Command& command) {
  return command.verb == Verb::get_integer || command.verb == Verb::get_real ||
         std::ranges::any_of(command.operands,
                             [](const Operand& operand) { return asks_host(operand.kind); });
}

constexpr bool is_variable(Operand::Kind kind) {
  return kind >= Operand::Kind::integer_variable && kind <= Operand::Kind::real_array;
}
constexpr bool holds_integer(Operand::Kind kind) {
  return kind == Operand::Kind::integer_variable || kind == Operand::Kind::integer_array;
}
constexpr bool is_array(Operand::Kind kind) {
  return kind == Operand::Kind::integer_array || kind == Operand::Kind::real_array;
}

}  // namespace understudy::interpreter::slim
