// Pausing, going on, discarding, stopping; and what AVM does to speeds.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain.h"
#include "emulator/models/slim/jobs.h"
#include "emulator/models/slim/module.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/rules/pauses.h"
#include "motion/axis.h"
#include "motion/move.h"

namespace understudy::emulator::models::slim {

namespace {

Error in_vain(const ChainOptions& options) {
  return options.chose(option("ineffective_pause", "error_3")) ? Error::not_allowed : Error::none;
}

/// The one that takes `module`; nothing if none does.
auto* taking(auto& groups, std::size_t module) {
  const auto found = std::find_if(groups.begin(), groups.end(),
                                  [&](const auto& group) { return group.motion.takes(module); });
  return found == groups.end() ? nullptr : &*found;
}

}  // namespace

Chain::Group* Chain::group_of(int module) { return taking(groups_, at(module)); }
const Chain::Group* Chain::group_of(int module) const { return taking(groups_, at(module)); }

Error Chain::steer(InPause what) {
  const Pauses now = slim::pauses_of(queues_paused_, paused_);
  const PauseResult result = pause_result(options_, now, what);
  queues_paused_ = has_pz(result.left);
  paused_ = has_tapz(result.left);
  switch (result.outcome) {
    case PauseOutcome::slows_down: hold(); break;
    case PauseOutcome::goes_on: release(); break;
    case PauseOutcome::gives_up: give_up(what == InPause::clear_buffer); break;
    case PauseOutcome::clears: clear_waiting(); break;
    case PauseOutcome::stops: stop_all(); break;
    case PauseOutcome::in_vain: return in_vain(options_);
    case PauseOutcome::resets:
    case PauseOutcome::is_taken:
    case PauseOutcome::waits:
    case PauseOutcome::is_refused: break;  // whoever asks deals with it
  }
  return Error::none;
}

bool Chain::in_pause_scope(const Group& group) const {
  return std::any_of(group.motion.axis_of.begin(), group.motion.axis_of.end(),
                     [&](std::int8_t member) { return member >= 0 && in_pause_scope(int{member}); });
}

void Chain::hold() {
  for (Group& group : groups_) {
    if (group.motion.engaged && held(group)) group.motion.run.pause(now_);
  }
  for (int module = 0; module < kModules; ++module) {
    if (!held(module)) continue;
    const Activity activity = modules_[at(module)].activity;
    hold_jog(module);
    if (activity != Activity::move && activity != Activity::home) continue;
    axes_[at(module)].slow_down(now_);
    after_motion(module, now_ + 1);
  }
  serve(now_ + 1);  // outputs that waited for a jog's end
}

void Chain::release() {
  for (Group& group : groups_) {
    const bool goes_on =
        group.motion.engaged && group.motion.slowing_for == motion::Cause::none && !held(group);
    if (goes_on) group.motion.run.resume(now_);
  }
  for (int module = 0; module < kModules; ++module) {
    Module& mine = modules_[at(module)];
    if (held(module)) continue;
    go_on_with_jog(module);
    if (mine.activity != Activity::move) continue;
    const motion::SpeedLaw law = mine.working_law(options_);
    if (law.top_speed_u_s > 0 && axes_[at(module)].resume(law, now_)) mine.starved = false;
  }
  serve(now_ + 1);
}

/// What PZ holds, or everything.
void Chain::give_up(bool in_scope_only) {
  const auto is_meant = [&](int module) { return !in_scope_only || in_pause_scope(module); };
  for (int module = 0; module < kModules; ++module) {
    if (!is_meant(module)) continue;
    stop_jog(module);
    slow_for_discard(module);
  }
  for (int module = 0; module < kModules; ++module) {
    if (is_meant(module)) forget_queue(module);
  }
  serve(now_ + 1);  // what waited in other FIFOs for a command that is gone
}

/// Everything queued is about to go; what moves has begun to slow down.
void Chain::slow_for_discard(int module) {
  Module& mine = modules_[at(module)];
  if (Group* group = group_of(module); group != nullptr) {
    if (group->motion.run.at_rest(now_)) {
      end_group(*group, motion::Cause::stopped);
    } else {
      group->paths = 0;
      group->motion.slow_down(now_);
    }
  } else if (mine.activity == Activity::move || mine.activity == Activity::home) {
    mine.activity = Activity::stopping;
    mine.starved = false;
    axes_[at(module)].slow_down(now_);
    after_motion(module, now_ + 1);
  }
}

void Chain::clear_waiting() {
  for (Group& group : groups_) {
    if (!group.motion.engaged || group.paths == 0 || !in_pause_scope(group)) continue;
    group.paths = static_cast<std::uint8_t>(group.motion.run.shorten(now_));
    if (group.paths == 0) continue;
    const Job& last = modules_[at(group.motion.axis_of[0])].fifo[group.paths - 1U];
    for (std::size_t i = 0; i < last.ends.size(); ++i) {
      group.end[static_cast<Eigen::Index>(i)] = last.ends[i];
    }
  }
  for (int module = 0; module < kModules; ++module) {
    if (!in_pause_scope(module)) continue;
    const Activity activity = modules_[at(module)].activity;
    const Group* group = group_of(module);
    const auto& fifo = modules_[at(module)].fifo;
    const bool is_half_done = options_.chose(pauses::kOnlyWhatWaits) && !fifo.empty() && fifo[0].begun;
    const bool head_runs = activity == Activity::move || activity == Activity::home || is_half_done;
    forget_queue(module, group != nullptr ? group->paths : head_runs ? 1 : 0);
  }
  serve(now_ + 1);
}

void Chain::stop_all() {
  for (int module = 0; module < kModules; ++module) cut(module, motion::Cause::stopped);
  for (int module = 0; module < kModules; ++module) {
    Module& mine = modules_[at(module)];
    mine.fifo.truncate(0);
    stop_outputs(module);
    if (!options_.chose(option("emergency_stop", "nothing_queued_not_paused_servo_off")) || !mine.linked)
      continue;
    mine.analog_speed = false;  // as HOFF does
    axes_[at(module)].switch_servo(false);
  }
}

void Chain::cut(int module, motion::Cause why) {
  if (Group* group = group_of(module); group != nullptr) end_group(*group, why);
  Module& mine = modules_[at(module)];
  axes_[at(module)].stop(why);
  if (mine.activity == Activity::move || mine.activity == Activity::home) mine.fifo.pop();
  if (mine.activity != Activity::idle) mine.place_units = coordinate(module);
  mine.activity = Activity::idle;
  mine.jog_direction = mine.next_jog_direction = mine.held_jog_direction = 0;
  mine.thrust = mine.next_thrust = mine.held_thrust = 0;
  mine.starved = false;
}

void Chain::forget_queue(int module, std::size_t kept) {
  const auto& fifo = modules_[at(module)].fifo;
  while (fifo.size() > kept) drop_job(fifo[kept].number);
}

void Chain::end_group(Group& group, motion::Cause why) {
  group.motion.stop(axes_, why);
  release_group(group, now_ + 1);
}

/// Lets the modules of a group that has ended go, with what is left of its commands.
void Chain::release_group(Group& group, Tick begin_at) {
  const auto members = group.motion.axis_of;
  for (const std::int8_t member : members) {
    if (member < 0) continue;
    Module& mine = modules_[at(member)];
    for (int i = 0; i < group.paths; ++i) mine.fifo.pop();
    if (group.motion.cause != motion::Cause::arrived) mine.place_units = coordinate(member);
    mine.activity = Activity::idle;
  }
  group = {};
  for (const std::int8_t member : members) {
    if (member >= 0) begin_next(member, begin_at);
  }
}

// ---- Speeds that change on the way

void Chain::refresh_speed(int module) {
  Module& mine = modules_[at(module)];
  motion::Axis& axis = axes_[at(module)];
  const bool is_move = mine.activity == Activity::move;
  if (is_move || mine.activity == Activity::jog) {
    const motion::SpeedLaw law = is_move ? mine.working_law(options_) : mine.jog_law(options_);
    const bool stands_still = !is_move && mine.settings.jog_speed == 0;
    const bool stops = axis.slowing && !mine.starved;  // for JG0, say
    const bool stops_anyhow = stops || held(module) || mine.next_jog_direction != 0 || mine.next_thrust != 0;
    if (stops_anyhow || (stands_still && axis.task == motion::Task::hanging)) return;
    if (law.top_speed_u_s == 0) {
      mine.starved = true;
      axis.slow_down(now_);
      after_motion(module, now_ + 1);
    } else if (!mine.starved) {
      axis.change_speed(law, now_);
    } else {
      mine.starved = false;
      const bool stands = !axis.resume(law, now_) && !axis.moving();
      if (stands && !is_move) begin_jog(module, mine.jog_direction, now_ + 1);
    }
  }
  serve(now_ + 1);
}

}  // namespace understudy::emulator::models::slim
