#include "emulator/plant/plant.h"

#include <algorithm>
#include <cstdlib>

namespace understudy::emulator {

void PlantAxis::step(Tick tick, std::int64_t pulses, DriveInputs inputs) {
  // What moves in this tick is decided by the drive as it was at its beginning.
  const std::int64_t steps = pulses_that_step(pulses);
  state_.lost_pulses += std::abs(pulses - steps);
  const std::int64_t slipped = state_.faults.slipped_pulses;
  state_.faults.slipped_pulses = 0;
  if (steps != 0 || slipped != 0) move(steps + slipped);
  step_drive(tick, inputs);
}

std::int64_t PlantAxis::pulses_that_step(std::int64_t pulses) {
  if (pulses == 0) return 0;
  if (state_.faults.stalled || in_alarm()) return 0;
  if (setup_.drive && !state_.ready) return 0;
  const std::int64_t one_in = state_.faults.loses_one_in;
  if (one_in == 0) return pulses;
  const std::int64_t made = state_.pulses_to_lose + std::abs(pulses);
  state_.pulses_to_lose = made % one_in;
  const std::int64_t left = std::abs(pulses) - made / one_in;
  return pulses < 0 ? -left : left;
}

void PlantAxis::step_drive(Tick tick, DriveInputs inputs) {
  if (!setup_.drive) return;
  state_.alarm_latched = state_.faults.alarm || (state_.alarm_latched && !inputs.alarm_clear);
  const bool enabled = inputs.servo == setup_.drive->enabled_by && !in_alarm();
  if (!enabled) {
    state_.enabled_at = kNever;
  } else if (state_.enabled_at == kNever) {
    state_.enabled_at = tick;
  }
  state_.ready = enabled && tick - state_.enabled_at >= setup_.drive->ready_after;
}

Tick PlantAxis::next_active_tick(Tick done) const {
  if (state_.faults.slipped_pulses != 0) return done + 1;
  if (setup_.drive && state_.enabled_at != kNever && !state_.ready) {
    return std::max(done + 1, state_.enabled_at + setup_.drive->ready_after);
  }
  return kNever;
}

void PlantAxis::move(std::int64_t steps) {
  const std::int64_t wanted = state_.position_pulses + steps;
  state_.position_pulses =
      setup_.travel ? std::clamp(wanted, setup_.travel->first, setup_.travel->last) : wanted;
  state_.lost_pulses += std::abs(wanted - state_.position_pulses);
  move_switches();
}

void PlantAxis::move_switches() {
  const std::int64_t at = state_.position_pulses;
  if (setup_.home) {
    const std::int64_t wider = state_.at_home ? setup_.home_hysteresis_pulses : 0;
    state_.at_home = at >= setup_.home->first - wider && at <= setup_.home->last + wider;
  }
  if (setup_.lower_limit) {
    const std::int64_t wider = state_.at_lower_limit ? setup_.limit_hysteresis_pulses : 0;
    state_.at_lower_limit = at <= *setup_.lower_limit + wider;
  }
  if (setup_.upper_limit) {
    const std::int64_t wider = state_.at_upper_limit ? setup_.limit_hysteresis_pulses : 0;
    state_.at_upper_limit = at >= *setup_.upper_limit - wider;
  }
}

std::int64_t PlantAxis::encoder_counts() const {
  const std::int64_t scaled = state_.position_pulses * setup_.encoder_counts_per_revolution;
  const std::int64_t divisor = setup_.pulses_per_revolution;
  const std::int64_t quotient = scaled / divisor;
  const std::int64_t counts = scaled % divisor < 0 ? quotient - 1 : quotient;
  return setup_.encoder_reversed ? -counts : counts;
}

}  // namespace understudy::emulator
