// Runs many ticks of an axis in one step: computes its plan and velocity mode in closed form, and records the
// encoder's last 100 ticks exactly as single ticks would.
#include <algorithm>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/simple2_r3/axis_drive.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

__extension__ using Wide = __int128;

/// Returns the change of speed per 0.5 ms step of velocity mode.
std::int64_t change_of_speed(const AxisState& axis, const DriveSettings& settings) {
  const std::int64_t left = final_urpm(axis, settings) - axis.speed_urpm;
  const std::int64_t step = settings.velocity_step_urpm;
  return left == 0 ? 0 : left < 0 ? -step : step;
}

/// Returns for how many ticks the speed changes by that amount per step without changing its sign. The step
/// that reaches the target is not included.
Tick even_ticks(const AxisState& axis, const DriveSettings& settings, Tick limit) {
  const std::int64_t change = change_of_speed(axis, settings);
  if (change == 0) return limit;
  const std::int64_t left = final_urpm(axis, settings) - axis.speed_urpm;
  Tick steps = (left - (change < 0 ? -1 : 1)) / change;
  if (axis.speed_urpm != 0 && (axis.speed_urpm < 0) != (change < 0)) {
    steps = std::min(steps, -axis.speed_urpm / change);
  }
  return std::min(limit, steps / 2);
}

/// Returns the phase after this many such ticks, including whole pulses.
Wide phase_after(const AxisState& axis, const DriveSettings& settings, Tick ticks) {
  const Wide steps = Wide{2} * ticks;
  const Wide changes = steps * (settings.pulses_by_speed_before ? steps - 1 : steps + 1) / 2;
  const Wide speeds = steps * axis.speed_urpm + changes * change_of_speed(axis, settings);
  return axis.velocity_phase + speeds * settings.pulses_per_revolution;
}

/// Returns the pulses of this many ticks, in the commanded direction. All phases have the same sign, or reach
/// it without a pulse, so the whole pulses are the same as with single steps.
std::int64_t pulses_ahead(const AxisState& axis, const SkipContext& skip_context, Tick tick) {
  if (tick == skip_context.done) return 0;
  if (runs_velocity(axis)) {
    const Wide phase = phase_after(axis, skip_context.settings, tick - skip_context.done);
    return static_cast<std::int64_t>(phase / kVelocityPhase);
  }
  return axis.motor.travel_ahead(tick) - axis.motor.travel_pulses;
}

/// Converts the machine's room to a range of travel.
motion::Axis::TravelRange range_of(const AxisState& axis, const SkipContext& skip_context) {
  const PulseRoom room = skip_context.ahead->room(skip_context.axis);
  const std::int64_t at = axis.motor.travel_pulses;
  if (skip_context.reversed) return {.low = at - room.max, .high = at - room.min};
  return {.low = at + room.min, .high = at + room.max};
}

Tick quiet_in_velocity(const AxisState& axis, const SkipContext& skip_context, Tick limit) {
  const motion::Axis& motor = axis.motor;
  if (!motor.carries_quietly(axis.signals)) return skip_context.done;
  limit = skip_context.done + even_ticks(axis, skip_context.settings, limit - skip_context.done);
  if (limit == skip_context.done) return limit;
  const motion::Axis::TravelRange range = range_of(axis, skip_context);
  const std::int64_t low = std::max(range.low, motor.watch_low) - motor.travel_pulses;
  const std::int64_t high = std::min(range.high, motor.watch_high) - motor.travel_pulses;
  const auto is_inside = [&](Tick tick) {
    const Wide pulses =
        phase_after(axis, skip_context.settings, tick - skip_context.done) / Wide{kVelocityPhase};
    return pulses >= low && pulses <= high;
  };
  if (is_inside(limit)) return limit;
  Tick inside = skip_context.done;
  Tick outside = limit;
  while (outside - inside > 1) {
    const Tick middle = inside + (outside - inside) / 2;
    (is_inside(middle) ? inside : outside) = middle;
  }
  return inside;
}

/// Returns the encoder count at the end of `tick`.
std::int64_t counts_ahead(const AxisState& axis, const SkipContext& skip_context, Tick tick) {
  const std::int64_t commanded = pulses_ahead(axis, skip_context, tick);
  if (commanded == 0 || !skip_context.ahead->has_encoder(skip_context.axis)) return axis.encoder_counts;
  const std::int64_t pulses = skip_context.reversed ? -commanded : commanded;
  return counts_at(axis, skip_context.ahead->encoder_counts(skip_context.axis, pulses),
                   skip_context.encoder_reversed);
}

/// Records what remember_encoder() would have recorded in these ticks.
void remember_skip(AxisState& axis, const SkipContext& skip_context, Tick tick) {
  const Tick next = skip_context.done + 1;
  const std::int64_t first = counts_ahead(axis, skip_context, next);
  const std::int64_t last = counts_ahead(axis, skip_context, tick);
  if (axis.encoder_history[ring_place(skip_context.done)] != first) axis.encoder_changed = next;
  for (Tick each = std::max(next, tick - AxisState::kSpeedWindow); each <= tick; ++each) {
    axis.encoder_history[ring_place(each)] = last == first ? last : counts_ahead(axis, skip_context, each);
  }
  if (last == first) return;
  // Counts change in only one direction, so a binary search finds the first tick with the last count.
  Tick before = next;
  Tick since = tick;
  while (since - before > 1) {
    const Tick middle = before + (since - before) / 2;
    (counts_ahead(axis, skip_context, middle) == last ? since : before) = middle;
  }
  axis.encoder_changed = since;
}

}  // namespace

Tick quiet_until(const AxisState& axis, const SkipContext& skip_context, Tick limit) {
  const motion::Axis& motor = axis.motor;
  if (axis.mode == Mode::sync || motor.events_between != 0) return skip_context.done;
  if (!motor.moving() && axis.command != Command::none) return skip_context.done;
  if (runs_velocity(axis)) return quiet_in_velocity(axis, skip_context, limit);
  return motor.quiet_until(skip_context.done + 1, limit, axis.signals, range_of(axis, skip_context));
}

std::int64_t fast_forward(AxisState& axis, const SkipContext& skip_context, Tick tick) {
  const std::int64_t commanded = pulses_ahead(axis, skip_context, tick);
  const std::int64_t of_the_last = commanded - pulses_ahead(axis, skip_context, tick - 1);
  remember_skip(axis, skip_context, tick);
  if (commanded != 0 && skip_context.ahead->has_encoder(skip_context.axis)) {
    const std::int64_t pulses = skip_context.reversed ? -commanded : commanded;
    count_encoder(axis, skip_context.ahead->encoder_counts(skip_context.axis, pulses),
                  skip_context.encoder_reversed);
  }
  if (runs_velocity(axis)) {
    const Wide phase = phase_after(axis, skip_context.settings, tick - skip_context.done);
    axis.velocity_phase = static_cast<std::int64_t>(phase % kVelocityPhase);
    axis.speed_urpm += 2 * (tick - skip_context.done) * change_of_speed(axis, skip_context.settings);
    axis.motor.carry_across(commanded);
  } else {
    axis.motor.fast_forward_to(tick);
  }
  axis.pulses_this_tick = skip_context.reversed ? -of_the_last : of_the_last;
  return commanded;
}

}  // namespace understudy::emulator::models::simple2_r3
