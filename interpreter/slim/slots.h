// Matches operands with the slots that follow a command's name.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/options.h"

namespace understudy::interpreter::slim {

struct Operands {
  Error error = Error::none;
  std::vector<Operand> operands = {};
};

/// Matches the items after a command's name with a row's slots. `target` is the target of an assignment; it
/// is null for a parameter.
Operands match_slots(const CommandRow& row, std::span<const std::string_view> items, const Operand* target,
                     const Options& options);

/// Returns the word for the condition of an event: "NZ".
std::string_view condition_word(Condition condition);

}  // namespace understudy::interpreter::slim
