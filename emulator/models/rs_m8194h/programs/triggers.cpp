#include "emulator/models/rs_m8194h/programs/triggers.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "emulator/models/rs_m8194h/drives/transitions.h"
#include "emulator/models/rs_m8194h/programs/frnet.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "interpreter/rs_m8194h/triggers.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

bool is_on(const FrnetWords& words, int channel) {
  return (words[static_cast<std::size_t>(channel / kFrnetChannels)] >> (channel % kFrnetChannels) & 1) != 0;
}

/// Returns true if a change of level fires the trigger. If `at_start`, levels that are already present also
/// count.
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

void Triggers::enable(bool on) {
  if (on) return check_at_start();
  state_.queued_triggers.clear();
  for (std::size_t a = 0; a < kAxes; ++a) known_.drives.take_off(a, DiscardEvent::triggers_off);
}

void Triggers::replaced(int channel) {
  known_.drives.state().trigger_holds[static_cast<std::size_t>(channel)] = 0;
}

void Triggers::check(const FrnetWords& before) { check(before, false); }

void Triggers::check_at_start() { check(known_.frnet.inputs(), true); }

void Triggers::check(const FrnetWords& before, bool at_start) {
  if (!known_.memory.are_triggers_enabled() || known_.status.is_deaf()) return;
  const bool levels_fire = at_start && chose(option("trigger_level_at_start", "fires_once"));
  for (int channel = 0; channel < lang::kTriggerCount; ++channel) {
    const lang::Trigger trigger = known_.programs.triggers()[static_cast<std::size_t>(channel)];
    const bool was = is_on(before, channel);
    const bool is = is_on(known_.frnet.inputs(), channel);
    if (fires(trigger.condition, was, is, levels_fire)) {
      fire(channel, trigger);
    } else if (was != is) {
      on_level_end(channel, trigger);
    }
  }
}

/// Ends the pause of a level, if the choice requires this, and releases the axes that the level held unless
/// another level still holds them.
void Triggers::on_level_end(int channel, const lang::Trigger& trigger) {
  ProgramState& programs = known_.programs.state();
  const bool ends_its_pause = programs.paused && programs.paused_by == channel &&
                              is_level(trigger.condition) && chose(option("pause_ends", "its_level_too"));
  if (ends_its_pause) programs.paused = false;
  auto& holds = known_.drives.state().trigger_holds;
  const AxisMask let_go = std::exchange(holds[static_cast<std::size_t>(channel)], AxisMask{0});
  if (let_go == 0) return;
  AxisMask still = 0;
  for (const AxisMask other : holds) still |= other;
  known_.stops.release(static_cast<AxisMask>(let_go & ~still));
}

void Triggers::fire(int channel, const lang::Trigger& trigger) {
  switch (trigger.event) {
    case lang::TriggerEvent::none: break;
    case lang::TriggerEvent::call_mp: call_mp(channel); break;
    case lang::TriggerEvent::hold: hold(channel, trigger); break;
    case lang::TriggerEvent::abort_command: abort_command(); break;
    case lang::TriggerEvent::abort_macro: known_.programs.terminate(); break;
    case lang::TriggerEvent::pause: pause(channel); break;
    case lang::TriggerEvent::clear_stop:
      known_.stops.clear_stop(kAllAxes);
      known_.stops.clear_path_stop();
      known_.programs.state().paused = false;
      break;
  }
}

void Triggers::call_mp(int channel) {
  const auto number = static_cast<std::uint8_t>(channel);
  std::vector<std::uint8_t>& queue = state_.queued_triggers;
  const bool has_no_room = !queue.empty() && chose(option("trigger_queue", "one_in_all"));
  const bool never_waits = chose(option("trigger_queue", "none"));
  if (has_no_room || (never_waits && (!queue.empty() || !may_start()))) return;
  if (std::find(queue.begin(), queue.end(), number) == queue.end()) queue.push_back(number);
}

void Triggers::hold(int channel, const lang::Trigger& trigger) {
  known_.stops.hold(trigger.argument);
  if (chose(option("trigger_hold", "also_slows_the_axis"))) known_.stops.slow_down(trigger.argument);
  if (!is_level(trigger.condition)) return;
  known_.drives.state().trigger_holds[static_cast<std::size_t>(channel)] = trigger.argument;
}

void Triggers::abort_command() {
  known_.queue.drop_first();
  known_.programs.drop_wait();
  if (!chose(option("trigger_abort_command", "drops_what_waits"))) known_.stops.slow_down(kAllAxes);
}

void Triggers::pause(int channel) {
  const auto number = static_cast<std::uint8_t>(channel);
  ProgramState& programs = known_.programs.state();
  const bool ends =
      programs.paused && programs.paused_by == number && chose(option("pause_ends", "its_second_firing_too"));
  programs.paused = !ends;
  programs.paused_by = number;
  if (programs.paused && machine_options().pause_slows_axes) known_.stops.slow_down(kAllAxes);
  if (programs.paused && machine_options().pause_holds_axes) known_.stops.pause();
}

bool Triggers::calls_again(int channel) const {
  const lang::Trigger& trigger = known_.programs.triggers()[static_cast<std::size_t>(channel)];
  if (trigger.event != lang::TriggerEvent::call_mp || !is_level(trigger.condition)) return false;
  return is_on(known_.frnet.inputs(), channel) == (trigger.condition == lang::TriggerCondition::on);
}

bool Triggers::a_level_calls_again() const {
  if (!machine_options().levels_repeat || !known_.memory.are_triggers_enabled()) return false;
  for (int channel = 0; channel < lang::kTriggerCount; ++channel) {
    if (calls_again(channel)) return true;
  }
  return false;
}

void Triggers::repeat_levels() {
  if (!known_.memory.are_triggers_enabled() || known_.programs.mp_runs()) return;
  if (!state_.queued_triggers.empty()) return;
  for (int channel = 0; channel < lang::kTriggerCount; ++channel) {
    if (calls_again(channel)) state_.queued_triggers.push_back(static_cast<std::uint8_t>(channel));
  }
}

/// Returns true unless a download, the emergency state, a reset, an MP or a pause prevents a start.
bool Triggers::may_start() const {
  const Programs& programs = known_.programs;
  return !programs.is_downloading() && !known_.drives.state().emergency_state &&
         !known_.status.is_resetting() && !programs.mp_runs() && !programs.state().paused;
}

void Triggers::start_queued() {
  if (machine_options().levels_repeat) repeat_levels();
  if (state_.queued_triggers.empty() || !may_start()) return;
  const lang::Trigger& trigger = known_.programs.triggers()[state_.queued_triggers.front()];
  state_.queued_triggers.erase(state_.queued_triggers.begin());
  if (trigger.event == lang::TriggerEvent::call_mp) known_.programs.start_mp(trigger.argument);
}

}  // namespace understudy::emulator::models::rs_m8194h
