// The argument and the result of an instruction's action.
#pragma once

#include <string_view>

#include "interpreter/simple2/execution/execution.h"
#include "interpreter/simple2/instructions.h"

namespace understudy::interpreter::simple2 {

/// Where the program continues after a line.
enum class Then : std::uint8_t {
  next_line,
  line_after_next,
  flag,  // the line with flag DATA1, or line 0 if there is no such line
  same_line,
  end,
  end_for_nested_loop,
  end_for_cut_wait,
};

struct Step {
  const Line& line;
  int line_number;
  std::int64_t now_ms;
  Execution& execution;
  const Program& program;
  const Dialect& dialect;
  Machine& machine;

  /// Return the parameters whose numbers are in DATA1 and DATA2.
  std::int32_t first_parameter() const { return machine.parameter(line.data1); }
  std::int32_t second_parameter() const { return machine.parameter(line.data2); }
  /// Returns true for a jump to an impossible flag, if a choice ignores such jumps.
  bool is_void_jump() const {
    const bool is_flag = line.data1 >= 1 && line.data1 <= kFlagCount;
    return !is_flag && dialect.undefined_flag == Dialect::UndefinedFlag::line_void;
  }
  /// Returns the line that has the flag, or line 0 if there is no such line, as in the manual.
  int flag_line() const { return program.line_with_flag(line.data1).value_or(0); }
};

using Action = Then (*)(Step&);

struct ActionRow {
  std::uint8_t key;  // the opcode
  Action handler;

  consteval ActionRow(std::string_view mnemonic, Action does) : key(opcode_of(mnemonic)), handler(does) {}
};

constexpr Then jump_if(bool condition) { return condition ? Then::flag : Then::next_line; }

}  // namespace understudy::interpreter::simple2
