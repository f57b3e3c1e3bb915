// The FIFO: commands in their order, as many as a tick has room for.
#include <algorithm>
#include <iterator>

#include "emulator/device/device.h"
#include "emulator/models/rs_m8194h/commands.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/not_implemented.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy::emulator::models::rs_m8194h {

int Module::fifo_blocks_of(const lang::Command& command) const {
  const lang::CommandRow& row = command.row();
  constexpr lang::Verb kHolds[] = {lang::Verb::drv_hold, lang::Verb::drv_start, lang::Verb::clear_stop,
                                   lang::Verb::clear_vstop};
  const bool is_hold = std::find(std::begin(kHolds), std::end(kHolds), command.verb()) != std::end(kHolds);
  if (is_hold && machine_.holds_are_at_once) return 0;
  if (command.verb() == lang::Verb::isr_call && machine_.isr_calls_are_at_once) return 0;
  const bool waits = row.use.real_time == lang::RealTime::queued ||
                     (machine_.stops_wait && row.use.real_time == lang::RealTime::stop);
  if (!waits) return 0;
  return machine_.one_block_each ? 1 : row.cost;
}

int Module::free_blocks() const {
  int free = kFifoBlocks;
  for (const lang::Command& command : state_.fifo.waiting) free -= fifo_blocks_of(command);
  if (state_.fifo.stop_wait != 0 && chose(option("fifo_block_freed", "when_its_wait_is_over"))) --free;
  return std::max(free, 0);
}

void Module::run_fifo(int& steps) {
  Fifo& fifo = state_.fifo;
  for (;;) {
    // While a macro lives, or a trigger has paused everything, nothing begins.
    if (state_.execution.is_alive() && !machine_.fifo_goes_on_beside_macros) return;
    if ((state_.paused && machine_.pause_holds_fifo) || is_resetting()) return;
    const bool is_helix = state_.paths.together.engaged && state_.paths.runs == Paths::Runs::helix;
    if (is_helix && machine_.helix_is_macro) return;
    if (machine_.fifo_waits_for_download && state_.rsm != lang::State::ready) return;
    if (fifo.stop_wait != 0) {
      if ((driving() & fifo.stop_wait) != 0) return;
      fifo.stop_wait = 0;
    }
    if (fifo.waiting.empty() || steps <= 0) return;
    // A copy: what it does may empty the FIFO.
    const lang::Command command = fifo.waiting.front();
    if (carry_out(command) == Took::waits) return;
    if (!fifo.waiting.empty()) fifo.waiting.erase(fifo.waiting.begin());
    --steps;
  }
}

Took Module::carry_out(const lang::Command& command) {
  for (const NotImplementedRow& row : kNotImplementedRows) {
    if (is_meant(row, command)) warn_not_implemented(row.what, row.why);
  }
  return action_of(command.verb())(*this, command);
}

}  // namespace understudy::emulator::models::rs_m8194h
