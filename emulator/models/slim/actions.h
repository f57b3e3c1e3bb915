// The actions of SLIM's verbs. Each verb has one row, with its actions when typed and in a program. If a verb
// has no row or several rows, the table does not compile (base/complete_table.h). The rows are in
// commands.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/machine.h"
#include "interpreter/slim/verbs.h"

namespace understudy::emulator::models::slim {

/// A command that is being executed. Its indices are constants, and its module is linked.
struct Order {
  State& state;
  const Setup& setup;
  const lang::Machine& machine;
  Chain& chain;
  const lang::Command& command;
  int module = 0;                       // T0 without a prefix
  std::vector<std::string> lines{};     // the reply of a typed command
  lang::Outcome outcome = lang::kDone;  // for a program, if there is no error
};
using Action = Error (*)(Order& order);

/// Returns Error::not_allowed.
Error is_refused(Order& order);

/// The motion whose end a move awaits in its buffer.
enum class Moves : std::uint8_t { nothing, its_module, its_letter, x_and_y, x_y_and_z, a_letter_each };

struct VerbActions {
  Action stored = nullptr;  // in a program, and for values that a bench sets
  Action typed = nullptr;
  Moves moves = Moves::nothing;
};

/// Returns the actions of a verb. Queries have no actions: queries.cpp answers them.
const VerbActions& actions_of(lang::Verb verb);

Order order_of(State& state, const Setup& setup, const lang::Machine& machine, const lang::Command& command);
/// Executes a typed command, or a command of a program.
Error perform(Order& order, Action action);
/// Executes a program line. Where a host's command would be refused, the program waits: for room in a buffer,
/// and (depending on a choice) for the end of a pause.
lang::Outcome perform_stored(Order& order);

/// Returns true if the command is a move of a busy module. Commands that are refused for another reason do
/// not count.
bool would_wait(const State& state, const lang::Command& command);

}  // namespace understudy::emulator::models::slim
