// Runs many ticks of an axis in one step: computes its plan and the counting of velocity mode in closed form,
// and records the encoder's last 100 ticks as single ticks would have done.
#include <algorithm>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/simple2_r3/axis_drive.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

__extension__ using Wide = __int128;

/// Returns the change of speed in each 0.5 ms step of velocity mode.
std::int64_t change_of_speed(const AxisState& axis, const DriveSettings& settings) {
  const std::int64_t left = final_urpm(axis, settings) - axis.speed_urpm;
  const std::int64_t step = settings.velocity_step_urpm;
  return left == 0 ? 0 : left < 0 ? -step : step;
}

/// Returns for how many ticks the speed changes by that amount without a change of its sign. The step that
/// arrives is not included.
Tick even_ticks(const AxisState& axis, const DriveSettings& settings, Tick most) {
  const std::int64_t change = change_of_speed(axis, settings);
  if (change == 0) return most;
  const std::int64_t left = final_urpm(axis, settings) - axis.speed_urpm;
  Tick steps = (left - (change < 0 ? -1 : 1)) / change;
  if (axis.speed_urpm != 0 && (axis.speed_urpm < 0) != (change < 0)) {
    steps = std::min(steps, -axis.speed_urpm / change);
  }
  return std::min(most, steps / 2);
}

/// Returns the phase after this many such ticks, whole pulses included.
Wide phase_after(const AxisState& axis, const DriveSettings& settings, Tick ticks) {
  const Wide steps = Wide{2} * ticks;
  const Wide changes = steps * (settings.pulses_by_speed_before ? steps - 1 : steps + 1) / 2;
  const Wide speeds = steps * axis.speed_urpm + changes * change_of_speed(axis, settings);
  return axis.velocity_phase + speeds * settings.pulses_per_revolution;
}

/// Returns the pulses of this many ticks, in the commanded direction. Phases have one sign, or reach it
/// without a pulse, so whole pulses come out as in single steps.
std::int64_t pulses_ahead(const AxisState& axis, const Crossing& crossing, Tick tick) {
  if (tick == crossing.done) return 0;
  if (runs_velocity(axis)) {
    const Wide phase = phase_after(axis, crossing.settings, tick - crossing.done);
    return static_cast<std::int64_t>(phase / kVelocityPhase);
  }
  return axis.motor.travel_ahead(tick) - axis.motor.travel_pulses;
}

/// Returns the machine's room as a range of travel.
motion::Axis::TravelRange range_of(const AxisState& axis, const Crossing& crossing) {
  const PulseRoom room = crossing.ahead->room(crossing.axis);
  const std::int64_t at = axis.motor.travel_pulses;
  if (crossing.reversed) return {.low = at - room.most, .high = at - room.least};
  return {.low = at + room.least, .high = at + room.most};
}

Tick quiet_in_velocity(const AxisState& axis, const Crossing& crossing, Tick most) {
  const motion::Axis& motor = axis.motor;
  if (!motor.carries_quietly(axis.signals)) return crossing.done;
  most = crossing.done + even_ticks(axis, crossing.settings, most - crossing.done);
  if (most == crossing.done) return most;
  const motion::Axis::TravelRange range = range_of(axis, crossing);
  const std::int64_t low = std::max(range.low, motor.watch_low) - motor.travel_pulses;
  const std::int64_t high = std::min(range.high, motor.watch_high) - motor.travel_pulses;
  const auto is_inside = [&](Tick tick) {
    const Wide pulses = phase_after(axis, crossing.settings, tick - crossing.done) / Wide{kVelocityPhase};
    return pulses >= low && pulses <= high;
  };
  if (is_inside(most)) return most;
  Tick inside = crossing.done;
  Tick outside = most;
  while (outside - inside > 1) {
    const Tick middle = inside + (outside - inside) / 2;
    (is_inside(middle) ? inside : outside) = middle;
  }
  return inside;
}

/// Returns the encoder's count at the end of `tick`.
std::int64_t counts_ahead(const AxisState& axis, const Crossing& crossing, Tick tick) {
  const std::int64_t commanded = pulses_ahead(axis, crossing, tick);
  if (commanded == 0 || !crossing.ahead->has_encoder(crossing.axis)) return axis.encoder_counts;
  const std::int64_t pulses = crossing.reversed ? -commanded : commanded;
  return counts_at(axis, crossing.ahead->encoder_counts(crossing.axis, pulses), crossing.encoder_reversed);
}

/// Records what remember_encoder() would have recorded in each of the ticks.
void remember_skip(AxisState& axis, const Crossing& crossing, Tick tick) {
  const Tick next = crossing.done + 1;
  const std::int64_t first = counts_ahead(axis, crossing, next);
  const std::int64_t last = counts_ahead(axis, crossing, tick);
  if (axis.encoder_history[ring_place(crossing.done)] != first) axis.encoder_changed = next;
  for (Tick each = std::max(next, tick - AxisState::kSpeedWindow); each <= tick; ++each) {
    axis.encoder_history[ring_place(each)] = last == first ? last : counts_ahead(axis, crossing, each);
  }
  if (last == first) return;
  // Counts change in one direction, so a binary search finds the first tick with the last count.
  Tick before = next;
  Tick since = tick;
  while (since - before > 1) {
    const Tick middle = before + (since - before) / 2;
    (counts_ahead(axis, crossing, middle) == last ? since : before) = middle;
  }
  axis.encoder_changed = since;
}

}  // namespace

Tick quiet_until(const AxisState& axis, const Crossing& crossing, Tick most) {
  const motion::Axis& motor = axis.motor;
  if (axis.mode == Mode::sync || motor.events_between != 0) return crossing.done;
  if (!motor.moving() && axis.command != Command::none) return crossing.done;
  if (runs_velocity(axis)) return quiet_in_velocity(axis, crossing, most);
  return motor.quiet_until(crossing.done + 1, most, axis.signals, range_of(axis, crossing));
}

std::int64_t cross(AxisState& axis, const Crossing& crossing, Tick tick) {
  const std::int64_t commanded = pulses_ahead(axis, crossing, tick);
  const std::int64_t of_the_last = commanded - pulses_ahead(axis, crossing, tick - 1);
  remember_skip(axis, crossing, tick);
  if (commanded != 0 && crossing.ahead->has_encoder(crossing.axis)) {
    const std::int64_t pulses = crossing.reversed ? -commanded : commanded;
    count_encoder(axis, crossing.ahead->encoder_counts(crossing.axis, pulses), crossing.encoder_reversed);
  }
  if (runs_velocity(axis)) {
    const Wide phase = phase_after(axis, crossing.settings, tick - crossing.done);
    axis.velocity_phase = static_cast<std::int64_t>(phase % kVelocityPhase);
    axis.speed_urpm += 2 * (tick - crossing.done) * change_of_speed(axis, crossing.settings);
    axis.motor.carry_across(commanded);
  } else {
    axis.motor.fast_forward_to(tick);
  }
  axis.pulses_this_tick = crossing.reversed ? -of_the_last : of_the_last;
  return commanded;
}

}  // namespace understudy::emulator::models::simple2_r3
