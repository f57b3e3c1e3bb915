#include "emulator/models/rs_m8194h/module.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "base/prefetch.h"
#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/programs/memory.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "motion/axis.h"

namespace understudy::emulator::models::rs_m8194h {

Module::Module(const Ground& ground, State& state)
    : Part(ground),
      state_(state),
      memory(ground, state_),
      status(ground, state_),
      frnet(ground, state_),
      chip(ground, state_),
      interrupts(ground, state_, chip),
      scans(ground, chip, interrupts),
      streams(ground, state_, chip, interrupts),
      drives(ground, state_, chip, scans, streams),
      external(ground, chip, drives),
      path_starts(ground, chip, interrupts, streams, drives),
      stops(ground, chip, streams, drives, path_starts),
      edges(ground, chip, interrupts, streams, drives),
      motion_step(ground, chip, interrupts, scans, streams, drives, external, edges),
      programs(ground, state_, memory, status, interrupts, *this),
      queue(ground, state_, chip, status, programs, *this),
      triggers(ground, state_,
               {.memory = memory,
                .status = status,
                .frnet = frnet,
                .drives = drives,
                .stops = stops,
                .programs = programs,
                .queue = queue}) {
  state_.blocks = TextBlocks(block_kinds());
  state_.eeprom = memory.factory_memory();
  blank();
}

// --- time ------------------------------------------------------------------------------------------------

void Module::sample_inputs(Tick tick, bool inputs_changed) {
  if (inputs_changed) frnet.check_inputs();
  if (inputs_changed || chip.holds_back()) {
    chip.pass_pins(tick);
    for (std::size_t a = 0; a < kAxes; ++a) {
      chip.update_environment(a);
      external.watch(a, tick);
    }
  }
  if (!frnet.scans_at(tick)) return;
  const FrnetWords before = frnet.inputs();
  frnet.scan();
  if (frnet.inputs() != before) triggers.check(before);
}

void Module::update_outputs(Tick tick) {
  if (machine_options().pause_holds_axes && !state_.paused) stops.resume();
  stops.start_held();
  // Macros come first; the rest of the tick is for the FIFO.
  programs.run_tick(tick);
  triggers.start_queued();
  queue.run();
  state_.touched = false;
  state_.eeprom.step(tick, state_.image);
}

/// Returns true if nothing is happening, except for FRnet, pulses at OUT_X and OUT_Y, and values that are
/// waiting to be stored.
bool Module::rests() const {
  if (status.changes() || state_.touched || !queue.is_empty() || state_.fifo.stop_wait != 0) return false;
  if (state_.steps_left != language_options().steps_a_tick || !state_.marks.empty()) return false;
  return !programs.is_alive() && triggers.rests() && motion_step.rests();
}

Tick Module::next_active_tick(Tick done) const {
  if (!rests()) return done + 1;
  Tick next = std::max(done + 1, state_.eeprom.next_active_tick());
  next = std::min(next, frnet.next_active_tick(done));
  for (const AxisUnit& unit : state_.units) {
    if (unit.out.pulse_until > done) next = std::min(next, unit.out.pulse_until);
  }
  return next;
}

Tick Module::next_event_tick(Tick done, Tick max, const ClearTravel& ahead) const {
  const bool is_simple =
      !state_.touched && state_.marks.empty() && state_.steps_left == language_options().steps_a_tick;
  if (!is_simple || status.is_resetting() || programs.is_alive() || !triggers.rests()) return done + 1;
  Tick last = std::min(max, state_.eeprom.next_active_tick() - 1);
  last = std::min(last, frnet.next_active_tick(done) - 1);
  last = motion_step.quiet_until(done, last, ahead);
  // A command in the FIFO is waiting for an axis to stop.
  if (!queue.is_empty() && chip.driving() == 0) return done + 1;
  return last + 1;
}

void Module::prefetch() const {
  for (std::size_t a = 0; a < kAxes; ++a) {
    understudy::prefetch(&state_.motors[a], 2 * kCacheLine);  // what ticks during a move need
    prefetch_line(&state_.environment[a]);
    prefetch_line(&state_.units[a].sent_pulses);
  }
  const auto* const first_part = reinterpret_cast<const char*>(&memory);
  understudy::prefetch(first_part, reinterpret_cast<const char*>(&programs) + kCacheLine - first_part);
  prefetch_line(&queue);
  prefetch_line(&triggers);
  prefetch_line(&state_.sync);
  prefetch_line(&state_.paths.together.engaged);
  prefetch_line(&state_.fifo);
  prefetch_line(&state_.execution);
  prefetch_line(&state_.paused);
  prefetch_line(&state_.unscanned);
  prefetch_line(&state_.eeprom);
}

// --- memory ----------------------------------------------------------------------------------------------

void Module::load_program(std::string_view text) {
  const std::vector<int> channels = programs.load(text);
  for (const int channel : channels) triggers.replaced(channel);
  if (!channels.empty()) triggers.check_at_start();
}

void Module::take_over(const State& restored) {
  // Compiled macros stay valid if the texts are the same.
  const bool is_same = programs.is_compiled() && state_.blocks == restored.blocks;
  state_ = restored;
  if (!is_same) programs.forget_compiled();
  // A run that cannot have reached this state does not continue.
  programs.check_restored();
}

}  // namespace understudy::emulator::models::rs_m8194h
