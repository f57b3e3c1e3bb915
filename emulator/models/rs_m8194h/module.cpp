#include "emulator/models/rs_m8194h/module.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/prefetch.h"
#include "base/simulated_time.h"
#include "emulator/device/machine_edges.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/ground.h"
#include "emulator/models/rs_m8194h/memory.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "interpreter/rs_m8194h/run.h"
#include "motion/axis.h"

namespace understudy::emulator::models::rs_m8194h {

Module::Module(const Ground& ground) : Part(ground) {
  state_.blocks = TextBlocks(block_kinds());
  state_.eeprom = factory_memory();
  blank();
}

// --- the phases of a tick --------------------------------------------------------------------------------

void Module::sample_inputs(Tick tick, bool inputs_changed) {
  if (inputs_changed) state_.unscanned = frnet_inputs() != state_.inputs;
  if (inputs_changed || state_.holds_back) {
    pass_pins(tick);
    for (std::size_t a = 0; a < kAxes; ++a) {
      update_environment(a);
      watch_external(a, tick);
    }
  }
  if (scans_frnet_at(tick)) {
    const auto before = state_.inputs;
    scan_frnet();
    if (state_.inputs != before) check_triggers(before, false);
  }
}

void Module::step_motion(Tick tick) {
  const bool was_full = state_.paths.together.engaged && state_.paths.together.run.queued() > 1;
  step_axes(tick);
  on_path_speed(tick);
  on_path_end(was_full);
  for (std::size_t a = 0; a < kAxes; ++a) {
    // Its input stops what it has begun, and nothing else.
    if (!state_.motors[a].moving()) state_.units[a].external.running = 0;
    if (state_.units[a].paused_drive.what != Drive::What::none) check_paused_drive(a);
  }
  start_waiting_external();
  step_scans(tick);
}

void Module::update_outputs(Tick tick) {
  if (machine_.pause_holds_axes && !state_.paused) resume_motion();
  start_held();
  // Macros first; what they leave of the tick is the FIFO's.
  const bool ran_isr = isr_runs();
  state_.steps_left =
      lang::run_tick(state_.execution, tick, options_.steps_a_tick, state_.paused, options_.run, *this);
  if (ran_isr && !isr_runs()) pass_state(kIsrFinished);
  if (machine_.fifo_goes_on_beside_macros) state_.steps_left = options_.steps_a_tick;
  if (machine_.levels_repeat) repeat_levels();
  start_queued_trigger();
  run_fifo(state_.steps_left);
  state_.touched = false;
  state_.eeprom.step(tick, state_.image);
}

/// Whether nothing at all goes on, but for FRnet and what waits to be kept.
bool Module::rests() const {
  if (is_resetting() || (machine_.finished_states_show && state_.finished_at + 1 >= now())) return false;
  if (state_.touched || !state_.fifo.waiting.empty() || state_.fifo.stop_wait != 0) return false;
  if (state_.steps_left != options_.steps_a_tick || !state_.marks.empty()) return false;
  if (state_.execution.is_alive() || !state_.queued_triggers.empty()) return false;
  for (std::size_t a = 0; a < kAxes; ++a) {
    const motion::Axis& motor = state_.motors[a];
    const AxisUnit& unit = state_.units[a];
    if (motor.moving() || motor.must_recheck || motor.events != 0 || motor.events_between != 0) return false;
    if (unit.sent_pulses != 0 || state_.environment[a].version != motor.seen_version) return false;
    if (is_filtering(unit)) return false;
    if (unit.held_drive.what != Drive::What::none && !unit.held) return false;
    if (state_.scans[a].running) return false;
  }
  return state_.scanning == 0 && !state_.paths.together.engaged && state_.held_paths.empty();
}

Tick Module::next_active_tick(Tick done) const {
  if (!rests()) return done + 1;
  Tick next = std::max(done + 1, state_.eeprom.next_active_tick());
  if (state_.unscanned || state_.sent != state_.outputs) next = std::min(next, next_scan(done));
  for (const AxisUnit& unit : state_.units) {
    if (unit.out.pulse_until > done) next = std::min(next, unit.out.pulse_until);
  }
  return next;
}

void Module::prefetch() const {
  for (std::size_t a = 0; a < kAxes; ++a) {
    understudy::prefetch(&state_.motors[a], 2 * kCacheLine);  // all that the middle of a move needs
    prefetch_line(&state_.environment[a]);
    prefetch_line(&state_.units[a].sent_pulses);
  }
  prefetch_line(&state_.sync);
  prefetch_line(&state_.paths.together.engaged);
  prefetch_line(&state_.fifo);
  prefetch_line(&state_.execution);
  prefetch_line(&state_.paused);
  prefetch_line(&state_.unscanned);
  prefetch_line(&state_.eeprom);
}

// --- axes ------------------------------------------------------------------------------------------------

double Module::speed_pps(std::size_t axis) const {
  if (state_.paths.together.takes(axis)) return state_.paths.together.speed_pps(axis, now());
  const motion::Axis& motor = state_.motors[axis];
  return motor.moving() ? motor.sample(now()).speed_u_s * static_cast<double>(motor.drive.direction) : 0;
}

void Module::connect_encoder(std::size_t axis, std::int64_t counts) {
  AxisUnit& unit = state_.units[axis];
  unit.encoder_raw = counts * machine_.edges_per_encoder_count;  // EP counts from here
  if (unit.has_encoder) unit.encoder_zero = unit.encoder_raw;
  set_encoder(axis, counts);
}

void Module::set_encoder(std::size_t axis, std::int64_t counts) {
  const bool is_first = !state_.units[axis].has_encoder;
  tell_encoder(state_.units[axis], state_.motors[axis], counts * machine_.edges_per_encoder_count);
  if (is_first) rearm(axis);
}

void Module::set_edges(std::size_t axis, const MachineEdges& edges) {
  edges_[axis] = edges;
  update_environment(axis);
}

void Module::take_over(const State& restored) {
  // What was compiled stays so where the macros are the same.
  const bool is_same = compiled_revision_ == state_.blocks.revision() && state_.blocks == restored.blocks;
  state_ = restored;
  if (!is_same) compiled_revision_ = UINT64_MAX;
  // What it cannot have been doing it does not go on with.
  if (!lang::is_sound(state_.execution, *this)) lang::terminate(state_.execution);
}

}  // namespace understudy::emulator::models::rs_m8194h
