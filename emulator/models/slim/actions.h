// What SLIM's verbs do: for each one row, with what it does typed and what it does in a program. A verb
// without a row, or with two, does not compile (base/complete_table.h). The rows are in commands.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/models/slim/chain.h"
#include "interpreter/slim/machine.h"

namespace understudy::emulator::models::slim {

namespace lang = interpreter::slim;

class Slim;

/// A command on its way. Its indices are resolved, and its module is linked.
struct Order {
  Slim& slim;
  Chain& chain;
  const lang::Command& command;
  int module = 0;                       // T0 without a prefix
  std::vector<std::string> lines{};     // what a typed one has to say
  lang::Outcome outcome = lang::kDone;  // for a program, if there is no error
};
using Action = Error (*)(Order& order);

/// Error::not_allowed.
Error is_refused(Order& order);

/// Whose end a move waits for, in its buffer.
enum class Moves : std::uint8_t { nothing, its_module, its_letter, x_and_y, x_y_and_z, a_letter_each };

struct VerbActions {
  Action stored = nullptr;  // in a program, and for what a bench assigns
  Action typed = nullptr;
  Moves moves = Moves::nothing;
};

/// Of all verbs but queries, which queries.cpp answers.
const VerbActions& actions_of(lang::Verb verb);

}  // namespace understudy::emulator::models::slim
