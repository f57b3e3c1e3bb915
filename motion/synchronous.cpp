#include "motion/synchronous.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "motion/axis.h"
#include "motion/move.h"
#include "motion/shared_tick.h"
#include "motion/tick.h"

namespace understudy::motion {

namespace {

bool has(unsigned mask, std::size_t number) { return ((mask >> number) & 1U) != 0; }

void latch(SyncTable& table, std::size_t number, const Axis& axis) {
  const SyncAction& action = table.actions[number];
  SyncTable::Latch& mine = table.latches[number];
  if (action.latch_command) mine.travel_pulses = axis.travel_pulses;
  if (action.latch_encoder) mine.encoder_pulses = axis.encoder_pulses;
  mine.taken = mine.taken || action.latch_command || action.latch_encoder;
}

bool is_endless(SyncAction::Drive drive) {
  return drive == SyncAction::Drive::endless_plus || drive == SyncAction::Drive::endless_minus;
}

void preset(SyncTable& table, std::size_t number, SyncOutcome& outcome) {
  const SyncAction& action = table.actions[number];
  const auto mine = static_cast<std::uint8_t>(1U << number);
  switch (action.preset) {
    case SyncAction::Preset::none: break;
    case SyncAction::Preset::command: outcome.presets_command |= mine; break;
    case SyncAction::Preset::encoder: outcome.presets_encoder |= mine; break;
    case SyncAction::Preset::distance: table.distance_pulses[number] = action.preset_value; break;
    case SyncAction::Preset::speed:
      // An endless run of the same action uses the previous speed (RS-M8194H 7.3.1).
      if (action.preset_value > 0 && !is_endless(action.drive)) {
        table.speeds[number].top_speed_u_s = static_cast<double>(action.preset_value);
      }
      break;
  }
}

void drive(const SyncTable& table, std::size_t number, Axis& axis, const SharedTick& tick) {
  const Tick now = tick.tick();
  const SyncAction& action = table.actions[number];
  const SpeedLaw& speed = table.speeds[number];
  const std::int64_t distance = table.distance_pulses[number];
  switch (action.drive) {
    case SyncAction::Drive::none: break;
    case SyncAction::Drive::fixed_plus:
      if (!axis.moving()) axis.move(distance, speed, now);
      break;
    case SyncAction::Drive::fixed_minus:
      if (!axis.moving()) axis.move(distance == INT64_MIN ? distance : -distance, speed, now);
      break;
    case SyncAction::Drive::endless_plus:
      if (!axis.moving()) axis.run(+1, speed, now);
      break;
    case SyncAction::Drive::endless_minus:
      if (!axis.moving()) axis.run(-1, speed, now);
      break;
    case SyncAction::Drive::slow_down: axis.slow_down(tick.now()); break;
    case SyncAction::Drive::stop_at_once: axis.stop(Cause::stopped, tick.now()); break;
  }
}

}  // namespace

SyncOutcome act(SyncTable& table, std::size_t trigger, Events events, SharedTick& tick) {
  SyncOutcome outcome;
  outcome.fired = static_cast<Events>(events & table.triggers[trigger].factors);
  if (outcome.fired == 0) return outcome;
  const std::size_t count = std::min(tick.axes().size(), SyncTable::kAxes);
  for (std::size_t number = 0; number < count; ++number) {
    if (!has(table.triggers[trigger].activates, number)) continue;
    Axis& axis = tick.axes()[number];
    tick.bring(number);
    latch(table, number, axis);
    const SyncAction& action = table.actions[number];
    if (action.output) outcome.outputs |= static_cast<std::uint8_t>(1U << number);
    if (action.interrupt) outcome.interrupts |= static_cast<std::uint8_t>(1U << number);
    preset(table, number, outcome);
    drive(table, number, axis, tick);
  }
  return outcome;
}

}  // namespace understudy::motion
