#include "emulator/models/rs_m8194h/drives/edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/drives/transitions.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "motion/axis.h"
#include "motion/shared_tick.h"
#include "motion/synchronous.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

bool is_endless(motion::SyncAction::Drive drive) {
  using Action = motion::SyncAction::Drive;
  return drive == Action::endless_plus || drive == Action::endless_minus;
}

bool starts_something(motion::SyncAction::Drive drive) {
  using Action = motion::SyncAction::Drive;
  return drive == Action::fixed_plus || drive == Action::fixed_minus || is_endless(drive);
}

}  // namespace

void Edges::at_edge(motion::SharedTick& tick, std::size_t axis, motion::Events events) {
  const motion::Events handled = on_axis_end(axis, events);
  interrupts_.check_factors(axis, handled, tick.tick(), tick.pulses(axis));
  if ((handled & chip_.sync().triggers[axis].factors) != 0) act_together(tick, axis, handled);
}

/// Performs the firmware's part of synchronous actions. The motion kernel handles latches, presets and
/// drives.
void Edges::act_together(motion::SharedTick& tick, std::size_t trigger, motion::Events events) {
  using Action = motion::SyncAction::Drive;
  motion::SyncTable acting = chip_.sync();
  const AxisMask activated = acting.triggers[trigger].activates;
  std::array<bool, kAxes> begins{};
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(activated, a)) continue;
    motion::SyncAction& action = acting.actions[a];
    acting.speeds[a] = chip_.law_of(a);
    // Presets also take effect at this moment. Without an encoder, EP counts the pulses.
    action.latch_command = action.latch_encoder = true;
    const bool sets_speed = action.preset == motion::SyncAction::Preset::speed && action.preset_value > 0;
    const bool has_no_speed = !sets_speed && drives_.lacks_speed(a, Drive::What::fixed);
    const bool is_void = starts_something(action.drive) &&
                         (has_no_speed || drives_.may_start(a, Starter::external) != Start::starts);
    if (is_void || chip_.paths().together.takes(a)) action.drive = Action::none;
    begins[a] = starts_something(action.drive);
  }
  const motion::SyncOutcome outcome = motion::act(acting, trigger, events, tick);
  chip_.sync().distance_pulses = acting.distance_pulses;

  const bool shows_trigger = chose(option("sync_mask", "the_trigger_axis"));
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(activated, a)) continue;
    AxisUnit& unit = chip_.unit(a);
    if (begins[a]) {
      drives_.take_off(a, DiscardEvent::other_drive);
      unit.began_pulses = chip_.motor(a).travel_pulses;
    }
    const motion::SyncAction& action = chip_.sync().actions[a];
    const motion::SyncTable::Latch& latch = acting.latches[a];
    const std::int64_t encoder = unit.has_encoder ? latch.encoder_pulses : latch.travel_pulses;
    if (action.latch_command || action.latch_encoder) {
      unit.latched = static_cast<std::int32_t>(action.latch_encoder ? unit.encoder.at(encoder)
                                                                    : unit.logic.at(latch.travel_pulses));
    }
    const auto preset = static_cast<std::int32_t>(action.preset_value);
    const bool ring_folds = machine_options().axis.ring_folds;
    if (has(outcome.presets_command, a))
      set_count(unit.logic, unit.basic, preset, latch.travel_pulses, ring_folds);
    if (has(outcome.presets_encoder, a)) set_count(unit.encoder, unit.basic, preset, encoder, ring_folds);
    // If the drive is endless, a preset of the speed is void (7.3.1).
    if (action.preset == motion::SyncAction::Preset::speed && preset > 0 && !is_endless(action.drive)) {
      unit.speed.drive_pps = static_cast<std::uint32_t>(preset);
      if (!starts_something(action.drive)) drives_.change_speed(a, tick.now());
    }
    if (chip_.paths().together.takes(a)) act_on_path(tick, action.drive);
    if (has(outcome.outputs, a)) chip_.give_pulse(a, tick.tick());
    if (has(outcome.interrupts, a)) {
      interrupts_.on_synchronous(a, shows_trigger ? trigger : a, tick.tick());
    }
    chip_.rearm(a);
  }
}

/// Performs the drive action of an axis that a path carries.
void Edges::act_on_path(motion::SharedTick& tick, motion::SyncAction::Drive drive) {
  using Action = motion::SyncAction::Drive;
  if (drive == Action::slow_down) {
    tick.slow_path(motion::Cause::stopped, streams_.law_to_slow_down());
  } else if (drive == Action::stop_at_once) {
    streams_.stop(tick.now());
  } else {
    return;
  }
  streams_.break_off();
}

}  // namespace understudy::emulator::models::rs_m8194h
