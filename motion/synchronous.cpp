#include "motion/synchronous.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>

#include "motion/axis.h"
#include "motion/move.h"
#include "motion/pulse_drive.h"
#include "motion/tick.h"

namespace understudy::motion {

namespace {

bool has(unsigned mask, std::size_t number) { return ((mask >> number) & 1U) != 0; }

bool is_before(const Instant& one, const Instant& other) {
  return one.tick < other.tick || (one.tick == other.tick && one.after_s < other.after_s);
}

/// When a trigger's event happened; of several the last.
Instant moment(Events fired, const Axis& axis, Tick now) {
  std::optional<Instant> last;
  for (std::size_t i = 0; i < axis.event_at.size(); ++i) {
    if (!has(fired, i) || !is_to_the_pulse(static_cast<Event>(i))) continue;
    const Instant& at = axis.event_at[i];
    if (!last || is_before(*last, at)) last = at;
  }
  return last.value_or(Instant{.tick = now});
}

void latch(SyncTable& table, std::size_t trigger, Events fired, std::span<const Axis> axes, Tick now) {
  const Instant at = moment(fired, axes[trigger], now);
  for (std::size_t number = 0; number < axes.size(); ++number) {
    if (!has(table.triggers[trigger].activates, number)) continue;
    const SyncAction& action = table.actions[number];
    SyncTable::Latch& mine = table.latches[number];
    if (action.latch_command) mine.travel_pulses = axes[number].travel_at(at);
    if (action.latch_encoder) mine.encoder_pulses = axes[number].encoder_pulses;
    mine.taken = mine.taken || action.latch_command || action.latch_encoder;
  }
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
      // An endless run of the same action uses the speed there was (RS-M8194H 7.3.1).
      if (action.preset_value > 0 && !is_endless(action.drive)) {
        table.speeds[number].top_speed_u_s = static_cast<double>(action.preset_value);
      }
      break;
  }
}

void drive(const SyncTable& table, std::size_t number, Axis& axis, Tick now) {
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
    case SyncAction::Drive::slow_down: axis.slow_down(now); break;
    case SyncAction::Drive::stop_at_once: axis.stop(); break;
  }
}

}  // namespace

SyncOutcome act(SyncTable& table, std::span<Axis> axes, Tick now, SyncOrder order) {
  SyncOutcome outcome;
  const std::size_t count = std::min(axes.size(), SyncTable::kAxes);
  // What fires is what happened in the tick: what the actions bring about is for the next.
  for (std::size_t trigger = 0; trigger < count; ++trigger) {
    outcome.fired[trigger] = static_cast<Events>(axes[trigger].events & table.triggers[trigger].factors);
  }
  std::array<std::size_t, SyncTable::kAxes> triggers{};
  std::iota(triggers.begin(), triggers.end(), std::size_t{0});
  if (order == SyncOrder::by_moment) {
    std::stable_sort(triggers.begin(), triggers.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](std::size_t one, std::size_t other) {
                       return is_before(moment(outcome.fired[one], axes[one], now),
                                        moment(outcome.fired[other], axes[other], now));
                     });
  }
  // Latches first: where an axis was in the tick can be told only until an action changes what it does.
  for (const std::size_t trigger : std::span(triggers).first(count)) {
    if (outcome.fired[trigger] != 0) latch(table, trigger, outcome.fired[trigger], axes.first(count), now);
  }
  for (const std::size_t trigger : std::span(triggers).first(count)) {
    if (outcome.fired[trigger] == 0) continue;
    for (std::size_t number = 0; number < count; ++number) {
      if (!has(table.triggers[trigger].activates, number)) continue;
      const SyncAction& action = table.actions[number];
      if (action.output) outcome.outputs |= static_cast<std::uint8_t>(1U << number);
      if (action.interrupt) outcome.interrupts |= static_cast<std::uint8_t>(1U << number);
      preset(table, number, outcome);
      drive(table, number, axes[number], now);
    }
  }
  return outcome;
}

}  // namespace understudy::motion
