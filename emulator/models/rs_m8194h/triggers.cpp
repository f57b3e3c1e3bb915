// Triggers: FRnet inputs that start macros and events without a host (10, 5.4).
#include "interpreter/rs_m8194h/triggers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/paths.h"
#include "emulator/models/rs_m8194h/registers.h"
#include "emulator/models/rs_m8194h/terminals.h"
#include "emulator/models/rs_m8194h/transitions.h"
#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/window.h"
#include "motion/axis.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

bool is_on(const std::array<std::uint16_t, kFrnetGroups>& words, int channel) {
  return (words[static_cast<std::size_t>(channel / kFrnetChannels)] >> (channel % kFrnetChannels) & 1) != 0;
}

/// `at_start`: levels that are there already count, though nothing has changed.
bool fires(lang::TriggerCondition condition, bool was, bool is, bool at_start) {
  switch (condition) {
    case lang::TriggerCondition::none: return false;
    case lang::TriggerCondition::on: return is && (at_start || !was);
    case lang::TriggerCondition::off: return !is && (at_start || was);
    case lang::TriggerCondition::off_to_on: return is && !was;
    case lang::TriggerCondition::on_to_off: return !is && was;
    case lang::TriggerCondition::change: return is != was;
  }
  return false;
}

bool is_level(lang::TriggerCondition condition) {
  return condition == lang::TriggerCondition::on || condition == lang::TriggerCondition::off;
}

}  // namespace

void Module::enable_triggers(bool on) {
  if (on) {
    check_triggers(state_.inputs, true);
  } else {
    state_.queued_triggers.clear();
    for (std::size_t a = 0; a < kAxes; ++a) take_off(a, WayOut::triggers_off);
  }
}

void Module::check_triggers(const std::array<std::uint16_t, kFrnetGroups>& before, bool at_start) {
  if (state_.image[kEventSlot] == 0 || is_deaf()) return;
  const bool levels_fire = at_start && chose(option("trigger_level_at_start", "fires_once"));
  for (int channel = 0; channel < lang::kTriggerCount; ++channel) {
    const lang::Trigger trigger = triggers()[static_cast<std::size_t>(channel)];
    const bool was = is_on(before, channel);
    const bool is = is_on(state_.inputs, channel);
    if (fires(trigger.condition, was, is, levels_fire)) {
      fire(channel, trigger);
      continue;
    }
    const bool ends_its_pause = state_.paused && state_.paused_by == channel && was != is &&
                                is_level(trigger.condition) && chose(option("pause_ends", "its_level_too"));
    if (ends_its_pause) state_.paused = false;
    // A level that held an axis lets it go when it ends, the last one if several did.
    AxisMask& held = state_.trigger_holds[static_cast<std::size_t>(channel)];
    if (held == 0 || was == is) continue;
    const AxisMask let_go = held;
    held = 0;
    AxisMask still = 0;
    for (const AxisMask other : state_.trigger_holds) still |= other;
    release(static_cast<AxisMask>(let_go & ~still));
  }
}

void Module::fire(int channel, const lang::Trigger& trigger) {
  switch (trigger.event) {
    case lang::TriggerEvent::none: break;
    case lang::TriggerEvent::call_mp: {
      const auto number = static_cast<std::uint8_t>(channel);
      auto& queue = state_.queued_triggers;
      const bool has_no_room = !queue.empty() && chose(option("trigger_queue", "one_in_all"));
      const bool never_waits = chose(option("trigger_queue", "none"));
      if (has_no_room || (never_waits && (!queue.empty() || !may_start_trigger()))) break;
      if (std::find(queue.begin(), queue.end(), number) == queue.end()) queue.push_back(number);
      break;
    }
    case lang::TriggerEvent::hold:
      hold(trigger.argument);
      if (chose(option("trigger_hold", "also_slows_the_axis"))) slow_down(trigger.argument);
      if (is_level(trigger.condition)) {
        state_.trigger_holds[static_cast<std::size_t>(channel)] = trigger.argument;
      }
      break;
    case lang::TriggerEvent::abort_command:
      if (!state_.fifo.waiting.empty() && state_.fifo.stop_wait == 0 && !state_.execution.is_alive()) {
        state_.fifo.waiting.erase(state_.fifo.waiting.begin());
      }
      state_.fifo.stop_wait = 0;
      lang::drop_wait(state_.execution, *this);
      if (chose(option("trigger_abort_command", "drops_what_waits"))) break;
      slow_down(kAllAxes);
      break;
    case lang::TriggerEvent::abort_macro: terminate(); break;
    case lang::TriggerEvent::pause: pause(channel); break;
    case lang::TriggerEvent::clear_stop:
      clear_stop(kAllAxes);
      clear_path_stop();
      state_.paused = false;
      break;
  }
}

void Module::slow_down(AxisMask axes) {
  Paths& paths = state_.paths;
  if (paths.together.engaged && (paths.axes & axes) != 0) {
    slow_path(now());
    break_off_stream();
  }
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (has(axes, a) && !paths.together.takes(a)) state_.motors[a].slow_down(now());
  }
}

void Module::pause(int channel) {
  const auto number = static_cast<std::uint8_t>(channel);
  const bool ends =
      state_.paused && state_.paused_by == number && chose(option("pause_ends", "its_second_firing_too"));
  state_.paused = !ends;
  state_.paused_by = number;
  if (state_.paused && machine_.pause_slows_axes) slow_down(kAllAxes);
  if (state_.paused && machine_.pause_holds_axes) pause_motion();
}

/// What moves comes to rest, and goes on from there when the pause is over; homing goes on meanwhile.
void Module::pause_motion() {
  motion::Coordinated& together = state_.paths.together;
  if (together.engaged && together.slowing_for == motion::Cause::none) together.run.pause(now());
  for (std::size_t a = 0; a < kAxes; ++a) {
    motion::Axis& motor = state_.motors[a];
    AxisUnit& unit = state_.units[a];
    if (activity(a) != Activity::single || motor.slowing) continue;
    const bool is_endless = motor.task == motion::Task::endless;
    const double speed_pps = motor.law.top_speed_u_s * static_cast<double>(motor.drive.direction);
    unit.paused_drive = {.what = is_endless ? Drive::What::endless : Drive::What::fixed,
                         .value = is_endless ? static_cast<std::int32_t>(speed_pps) : 0};
    unit.paused_to_pulses = motor.travel_pulses + motor.pulses_to_come();
    motor.slow_down(now());
  }
}

void Module::resume_motion() {
  motion::Coordinated& together = state_.paths.together;
  const bool is_held = together.engaged && together.run.paused();
  if (is_held && together.slowing_for == motion::Cause::none) together.run.resume(now());
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = state_.units[a];
    if (unit.paused_drive.what == Drive::What::none) continue;
    const Start outcome = may_start(a, Starter::command);
    if (outcome == Start::waits) continue;
    Drive rest = std::exchange(unit.paused_drive, Drive{});
    if (rest.what == Drive::What::fixed) {
      rest.value = static_cast<std::int32_t>(unit.paused_to_pulses - state_.motors[a].travel_pulses);
    }
    // A hold is for drives that follow.
    if (outcome != Start::is_void) start(a, rest);
  }
}

/// A level that is still there calls its macro again.
void Module::repeat_levels() {
  if (state_.image[kEventSlot] == 0 || mp_runs() || !state_.queued_triggers.empty()) return;
  for (int channel = 0; channel < lang::kTriggerCount; ++channel) {
    const lang::Trigger& trigger = triggers()[static_cast<std::size_t>(channel)];
    if (trigger.event != lang::TriggerEvent::call_mp || !is_level(trigger.condition)) continue;
    const bool is_met = is_on(state_.inputs, channel) == (trigger.condition == lang::TriggerCondition::on);
    if (is_met) state_.queued_triggers.push_back(static_cast<std::uint8_t>(channel));
  }
}

/// Nothing starts in a download or in the emergency state.
bool Module::may_start_trigger() const {
  return state_.rsm == lang::State::ready && !state_.emergency_state && !is_resetting() && !mp_runs() &&
         !state_.paused;
}

void Module::start_queued_trigger() {
  auto& queue = state_.queued_triggers;
  if (queue.empty() || !may_start_trigger()) return;
  const lang::Trigger& trigger = triggers()[queue.front()];
  queue.erase(queue.begin());
  if (trigger.event == lang::TriggerEvent::call_mp) start_mp(trigger.argument);
}

}  // namespace understudy::emulator::models::rs_m8194h
