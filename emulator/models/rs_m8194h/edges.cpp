// What happens when an axis comes to an edge, at that very moment, whatever moves it: its errors are noted,
// interrupts marked, synchronous actions done (7.3), whichever axis they act on.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/transitions.h"
#include "motion/axis.h"
#include "motion/shared_tick.h"
#include "motion/synchronous.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// The events that are factors of interrupts, in the order of nINT (7.3.12).
constexpr std::array<motion::Event, kIsrFactors> kFactorEvents{motion::Event::pulse,
                                                               motion::Event::comparator_3,
                                                               motion::Event::comparator_2,
                                                               motion::Event::comparator_1,
                                                               motion::Event::comparator_0,
                                                               motion::Event::constant_ended,
                                                               motion::Event::constant_started,
                                                               motion::Event::ended};

bool is_endless(motion::SyncAction::Drive drive) {
  using Action = motion::SyncAction::Drive;
  return drive == Action::endless_plus || drive == Action::endless_minus;
}

bool starts_something(motion::SyncAction::Drive drive) {
  using Action = motion::SyncAction::Drive;
  return drive == Action::fixed_plus || drive == Action::fixed_minus || is_endless(drive);
}

}  // namespace

void Module::at_edge(motion::SharedTick& tick, std::size_t axis, motion::Events events) {
  const motion::Events handled = on_axis_end(axis, events);
  check_factors(axis, handled, tick.tick(), tick.pulses(axis));
  if ((handled & state_.sync.triggers[axis].factors) != 0) act_together(tick, axis, handled);
}

void Module::check_factors(std::size_t axis, motion::Events events, Tick tick, std::int64_t pulses) {
  const AxisUnit& unit = state_.units[axis];
  const bool is_noted_always = chose(option("factors_noted", "enabled_ones"));
  for (std::size_t i = 0; i < kIsrFactors; ++i) {
    const bool is_asked = (unit.factors >> i & 1) != 0;
    if ((events & motion::bit(kFactorEvents[i])) == 0) continue;
    if (is_asked && (is_noted_always || state_.interrupts)) note_factor(axis, static_cast<Factor>(i));
    if (machine_.all_factors_are_noted) note_factor(axis, static_cast<Factor>(i));
    if (!is_asked || !state_.interrupts) continue;
    constexpr std::int64_t kMax = kMaxMarks;
    const bool is_counted = machine_.each_pulse_is_an_event && kFactorEvents[i] == motion::Event::pulse;
    const std::int64_t times = is_counted ? std::min(std::abs(pulses), kMax) : 1;
    for (std::int64_t k = 0; k < times; ++k) mark_isr(axis, static_cast<std::uint8_t>(i), tick);
  }
}

/// The kernel latches, presets and drives; what is the firmware's is done here.
void Module::act_together(motion::SharedTick& tick, std::size_t trigger, motion::Events events) {
  using Action = motion::SyncAction::Drive;
  motion::SyncTable acting = state_.sync;
  const AxisMask activated = acting.triggers[trigger].activates;
  std::array<bool, kAxes> begins{};
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(activated, a)) continue;
    motion::SyncAction& action = acting.actions[a];
    acting.speeds[a] = law_of(a);
    // Presets are of this moment, too; EP counts the pulses where there is no encoder.
    action.latch_command = action.latch_encoder = true;
    const bool sets_speed = action.preset == motion::SyncAction::Preset::speed && action.preset_value > 0;
    const bool has_no_speed = !sets_speed && lacks_speed(a, Drive::What::fixed);
    const bool is_void =
        starts_something(action.drive) && (has_no_speed || may_start(a, Starter::external) != Start::starts);
    if (is_void || state_.paths.together.takes(a)) action.drive = Action::none;
    begins[a] = starts_something(action.drive);
  }
  const motion::SyncOutcome outcome = motion::act(acting, trigger, events, tick);
  state_.sync.distance_pulses = acting.distance_pulses;

  const bool shows_trigger = chose(option("sync_mask", "the_trigger_axis"));
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(activated, a)) continue;
    AxisUnit& unit = state_.units[a];
    if (begins[a]) {
      take_off(a, WayOut::other_drive);
      unit.began_pulses = state_.motors[a].travel_pulses;
    }
    const motion::SyncAction& action = state_.sync.actions[a];
    const motion::SyncTable::Latch& latch = acting.latches[a];
    const std::int64_t encoder = unit.has_encoder ? latch.encoder_pulses : latch.travel_pulses;
    if (action.latch_command || action.latch_encoder) {
      unit.latched = static_cast<std::int32_t>(action.latch_encoder ? unit.encoder.at(encoder)
                                                                    : unit.logic.at(latch.travel_pulses));
    }
    const auto preset = static_cast<std::int32_t>(action.preset_value);
    const bool ring_folds = machine_.axis.ring_folds;
    if (has(outcome.presets_command, a))
      set_count(unit.logic, unit.basic, preset, latch.travel_pulses, ring_folds);
    if (has(outcome.presets_encoder, a)) set_count(unit.encoder, unit.basic, preset, encoder, ring_folds);
    // Of an endless drive it is void (7.3.1).
    if (action.preset == motion::SyncAction::Preset::speed && preset > 0 && !is_endless(action.drive)) {
      unit.speed.drive_pps = static_cast<std::uint32_t>(preset);
      if (!starts_something(action.drive)) change_speed(a, tick.now());
    }
    if (state_.paths.together.takes(a)) act_on_path(tick, action.drive);
    if (has(outcome.outputs, a)) give_pulse(a, tick.tick());
    if (has(outcome.interrupts, a)) {
      note_factor(shows_trigger ? trigger : a, Factor::synchronous);
      if (state_.interrupts) mark_isr(a, IsrMark::kSynchronous, tick.tick());
    }
    rearm(a);
  }
}

/// Of one of the axes that go along it.
void Module::act_on_path(motion::SharedTick& tick, motion::SyncAction::Drive drive) {
  using Action = motion::SyncAction::Drive;
  if (drive == Action::slow_down) {
    tick.slow_path(motion::Cause::stopped, law_to_slow_path());
  } else if (drive == Action::stop_at_once) {
    state_.paths.together.stop(state_.motors, motion::Cause::stopped, tick.now());
  } else {
    return;
  }
  break_off_stream();
}

}  // namespace understudy::emulator::models::rs_m8194h
