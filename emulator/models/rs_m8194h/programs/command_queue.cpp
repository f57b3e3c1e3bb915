#include "emulator/models/rs_m8194h/programs/command_queue.h"

#include <algorithm>
#include <iterator>

#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "emulator/models/rs_m8194h/programs/programs.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::emulator::models::rs_m8194h {

/// Returns how many FIFO blocks a command needs.
int CommandQueue::blocks_of(const lang::Command& command) const {
  const lang::CommandRow& row = command.row();
  constexpr lang::Verb kHolds[] = {lang::Verb::drv_hold, lang::Verb::drv_start, lang::Verb::clear_stop,
                                   lang::Verb::clear_vstop};
  const bool is_hold = std::find(std::begin(kHolds), std::end(kHolds), command.verb()) != std::end(kHolds);
  if (is_hold && machine_options().holds_are_at_once) return 0;
  if (command.verb() == lang::Verb::isr_call && machine_options().isr_calls_are_at_once) return 0;
  const bool waits = row.use.real_time == lang::RealTime::queued ||
                     (machine_options().stops_wait && row.use.real_time == lang::RealTime::stop);
  if (!waits) return 0;
  return machine_options().one_block_each ? 1 : row.cost;
}

int CommandQueue::free_blocks() const {
  int free = kFifoBlocks;
  for (const lang::Command& command : state_.fifo.waiting) free -= blocks_of(command);
  if (state_.fifo.stop_wait != 0 && chose(option("fifo_block_freed", "when_its_wait_is_over"))) --free;
  return std::max(free, 0);
}

lang::Fault CommandQueue::take(const lang::Command& command) {
  if (command.row().use.refused_while_mp_runs && programs_.are_calls_refused())
    return lang::Fault::macro_runs;
  if (blocks_of(command) == 0) {
    acts_on_.carry_out(command);
    state_.touched = true;
    return lang::Fault::none;
  }
  if (blocks_of(command) > free_blocks()) return lang::Fault::fifo_full;
  queue(command);
  return lang::Fault::none;
}

lang::Fault CommandQueue::why_no_room(const lang::Command& command) const {
  if (!programs_.is_downloading()) {
    return blocks_of(command) > free_blocks() ? lang::Fault::fifo_full : lang::Fault::none;
  }
  const bool fits = programs_.has_room_for(command.row().macro_lines());
  return fits ? lang::Fault::none : lang::Fault::macro_memory;
}

void CommandQueue::queue(const lang::Command& command) {
  const bool is_alone = state_.fifo.waiting.empty();
  state_.fifo.waiting.push_back(command);
  if (is_alone) run();
}

void CommandQueue::drop_first() {
  if (!is_empty() && state_.fifo.stop_wait == 0 && !programs_.is_alive()) {
    state_.fifo.waiting.erase(state_.fifo.waiting.begin());
  }
  state_.fifo.stop_wait = 0;
}

/// Returns true while nothing can begin, because a macro is alive or a trigger has paused everything.
bool CommandQueue::is_held() const {
  if (programs_.is_alive() && !machine_options().fifo_goes_on_beside_macros) return true;
  if ((programs_.state().paused && machine_options().pause_holds_fifo) || status_.is_resetting()) return true;
  const Paths& paths = chip_.paths();
  if (paths.together.engaged && paths.runs == Paths::Runs::helix && machine_options().helix_is_macro)
    return true;
  return machine_options().fifo_waits_for_download && programs_.is_downloading();
}

void CommandQueue::run() {
  Fifo& fifo = state_.fifo;
  int& steps = programs_.state().steps_left;
  while (!is_held()) {
    if (fifo.stop_wait != 0) {
      if ((chip_.driving() & fifo.stop_wait) != 0) return;
      fifo.stop_wait = 0;
    }
    if (fifo.waiting.empty() || steps <= 0) return;
    // This is a copy, because the command may empty the FIFO.
    const lang::Command command = fifo.waiting.front();
    if (acts_on_.carry_out(command) == lang::Took::waits) return;
    if (!fifo.waiting.empty()) fifo.waiting.erase(fifo.waiting.begin());
    --steps;
  }
}

}  // namespace understudy::emulator::models::rs_m8194h
