// Whether an operand may stand at a place behind a command's name.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/parse.h"

namespace understudy::interpreter::slim {

struct Operands {
  Error error = Error::none;
  std::vector<Operand> operands = {};
};

/// The items behind a command's name against a row's slots. `target` is what an assignment gives a value to,
/// null for a parameter.
Operands match_slots(const CommandRow& row, std::span<const std::string_view> items, const Operand* target,
                     const Dialect& dialect);

/// How an event's condition is written: "NZ".
std::string_view condition_word(Condition condition);

}  // namespace understudy::interpreter::slim
