// The FIFOs: what starts, when.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain.h"
#include "emulator/models/slim/jobs.h"
#include "emulator/models/slim/module.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/homing_tables.h"
#include "motion/move.h"
#include "motion/path.h"
#include "motion/path_run.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::slim {

void Chain::serve(Tick begin_at) {
  bool again = true;
  while (again) {
    again = false;
    for (int module = 0; module < kModules; ++module) again = serve_head(module, begin_at) || again;
  }
  for (Group& group : groups_) {
    if (group.motion.engaged) extend(group);
  }
}

bool Chain::free_to_move(int module) const {
  return !held(module) && modules_[at(module)].activity == Activity::idle && !axes_[at(module)].moving();
}

bool Chain::serve_head(int module, Tick begin_at) {
  Module& mine = modules_[at(module)];
  if (mine.fifo.empty()) return false;
  const bool head_runs =
      mine.activity == Activity::move || mine.activity == Activity::home || mine.activity == Activity::group;
  if (head_runs) return false;
  const Job& head = mine.fifo[0];
  switch (head.kind) {
    case Job::Kind::output: carry_out_order(module, head.output, begin_at); break;
    case Job::Kind::servo:
      if (!head.servo_on) {
        cut(module, motion::Cause::servo_off);
        mine.analog_speed = false;
      }
      axes_[at(module)].switch_servo(head.servo_on);
      break;
    case Job::Kind::set_coordinate:
      if (mine.activity != Activity::idle || mine.holds_jog()) return false;
      put_coordinate(module, head.units[0]);
      break;
    case Job::Kind::move: return free_to_move(module) && start_move(module, begin_at);
    case Job::Kind::home: return free_to_move(module) && start_home(module, begin_at);
    case Job::Kind::line:
    case Job::Kind::arc:
    case Job::Kind::spiral: return start_group(module, begin_at);
  }
  mine.fifo.pop();
  return true;
}

bool Chain::start_move(int module, Tick begin_at) {
  Module& mine = modules_[at(module)];
  motion::Axis& axis = axes_[at(module)];
  Job& job = mine.fifo[0];
  if (!job.absolute) job.units[0] += mine.place_units;
  job.absolute = true;  // what is left of it, when it is interrupted, goes to the same place
  job.ends[0] = job.units[0];
  if (!axis.servo_on) {
    drop_head(module, Error::servo_off);
    return true;
  }
  if (!mine.reaches(job.units[0])) {
    drop_head(module, Error::range);
    return true;
  }
  const std::int64_t distance = mine.zero_pulses + mine.pulses_of(job.units[0]) - axis.travel_pulses;
  if (distance == 0) {
    mine.place_units = job.units[0];
    mine.fifo.pop();
    return true;
  }
  const motion::SpeedLaw law = mine.working_law(options_);
  if (law.top_speed_u_s == 0) return false;  // AVM, and no voltage: when there is some
  motion::Cause refused = motion::Cause::none;
  try {
    refused = axis.move(distance, law, begin_at - 1);
  } catch (const motion::BadMotion&) {
    drop_head(module, Error::range);  // farther than pulses can be counted
    return true;
  }
  if (refused != motion::Cause::none) {
    drop_head(module, Error::not_allowed);
    return true;
  }
  mine.activity = Activity::move;
  job.begun = true;
  mine.starved = false;
  return false;
}

bool Chain::start_home(int module, Tick begin_at) {
  Module& mine = modules_[at(module)];
  motion::Axis& axis = axes_[at(module)];
  if (!axis.servo_on) {
    drop_head(module, Error::servo_off);
    return true;
  }
  const motion::SpeedLaw law = mine.jog_law(options_);
  if (law.top_speed_u_s == 0 && mine.settings.jog_speed != 0) return false;  // as for a move
  mine.homed = false;
  // The inputs may have changed since the axis looked last.
  axis.signals = environment_[at(module)].at(axis.travel_pulses);
  const bool forwards =
      options_.chose(option("homing", "at_vj_forwards_to_horg_then_0")) != (mine.settings.jog_speed < 0);
  const motion::Cause refused =
      axis.home(motion::slim_homing({.direction = forwards ? +1 : -1, .jog = law}), begin_at - 1);
  if (refused != motion::Cause::none) {
    drop_head(module, Error::not_allowed);
    return true;
  }
  if (!axis.homing.active()) {
    home_found(module);
    return true;
  }
  mine.activity = Activity::home;
  mine.fifo[0].begun = true;
  return false;
}

void Chain::home_found(int module) {
  put_coordinate(module, 0);
  modules_[at(module)].homed = true;
  modules_[at(module)].fifo.pop();
}

void Chain::put_coordinate(int module, double units) {
  Module& mine = modules_[at(module)];
  mine.zero_pulses = axes_[at(module)].travel_pulses - mine.pulses_of(units);
  mine.place_units = units;
  place_triggers(module);
}

// ---- Groups

bool Chain::at_all_places(const Job& job, std::size_t place) const {
  for (const std::int8_t module : job.module_of) {
    if (module < 0) continue;
    const auto& fifo = modules_[at(module)].fifo;
    if (fifo.size() <= place || fifo[place].number != job.number) return false;
  }
  return true;
}

motion::Point Chain::begin_of(const Job& job) const {
  motion::Point begin = motion::Point::Zero();
  for (std::size_t i = 0; i < job.module_of.size(); ++i) {
    if (job.module_of[i] < 0) continue;
    begin[static_cast<Eigen::Index>(i)] = modules_[at(job.module_of[i])].place_units;
  }
  return begin;
}

void Chain::note_ends(const Job& job, std::size_t place, const motion::Point& end) {
  for (const std::int8_t module : job.module_of) {
    if (module < 0) continue;
    Job& mine = modules_[at(module)].fifo[place];
    for (std::size_t i = 0; i < mine.ends.size(); ++i) mine.ends[i] = end[static_cast<Eigen::Index>(i)];
  }
}

bool Chain::start_group(int module, Tick begin_at) {
  const Job job = modules_[at(module)].fifo[0];
  if (!at_all_places(job, 0)) return false;
  for (const std::int8_t member : job.module_of) {
    if (member < 0) continue;
    if (!free_to_move(member)) return false;
  }
  for (const std::int8_t member : job.module_of) {
    if (member < 0 || axes_[at(member)].servo_on) continue;
    modules_[at(member)].late_error = Error::servo_off;
    drop_job(job.number);
    return true;
  }
  Group* group = nullptr;
  for (Group& each : groups_) {
    if (!each.motion.engaged) group = &each;
  }
  if (group == nullptr) return false;
  const motion::Point begin = begin_of(job);
  motion::Path path;
  try {
    path = path_of(job, begin);
  } catch (const motion::BadMotion&) {
    drop_head(module, Error::range);
    return true;
  }
  if (!within_reach(job, path) || is_refused_as_empty(path)) {
    drop_head(module, Error::range);
    return true;
  }
  note_ends(job, 0, path.end);
  if (path.length_u == 0) {
    for (std::size_t i = 0; i < job.module_of.size(); ++i) {
      if (job.module_of[i] < 0) continue;
      Module& mine = modules_[at(job.module_of[i])];
      mine.place_units = path.end[static_cast<Eigen::Index>(i)];
      mine.fifo.pop();
    }
    return true;
  }
  *group = {};
  const ModuleSettings& speeds = path_settings(job);
  const bool has_slope = job.path_acceleration_units_s2 != 0;
  const auto ramp = motion::RampLaw::by_slope(has_slope ? job.path_acceleration_units_s2
                                                        : speeds.path_acceleration_units_s2);
  for (std::size_t i = 0; i < job.module_of.size(); ++i) {
    group->motion.axis_of[i] = job.module_of[i];
    if (job.module_of[i] >= 0) group->motion.scale[i] = modules_[at(job.module_of[i])].settings.scale;
  }
  using Late = motion::PathRun::LateJoint;
  group->motion.run.set_late_joint(
      options_.chose(option("late_successor", "speeds_up_again")) ? Late::speed_up_again : Late::from_rest);
  group->motion.run.set_speed({.top_speed_u_s = path_speed(job, speeds), .up = ramp, .down = ramp}, now_);
  group->motion.run.append(path, {}, now_);
  if (group->motion.begin(begin, axes_, begin_at - 1) != motion::Cause::none) {
    *group = {};
    drop_head(module, Error::not_allowed);
    return true;
  }
  group->paths = 1;
  group->end = path.end;
  for (const std::int8_t member : job.module_of) {
    if (member >= 0) modules_[at(member)].activity = Activity::group;
  }
  return false;
}

/// Gives the run what follows it without stopping, so that it need not slow down.
void Chain::extend(Group& group) {
  if (group.paths == 0 || group.motion.slowing_for != motion::Cause::none) return;
  const auto& fifo = modules_[at(group.motion.axis_of[0])].fifo;  // X is in every group
  while (fifo.size() > group.paths && !group.motion.run.full()) {
    const Job next = fifo[group.paths];
    if (!next.coordinated() || !at_all_places(next, group.paths)) return;
    Job before = fifo[group.paths - 1U];
    // The acceleration can only change at rest.
    if (before.path_acceleration_units_s2 != next.path_acceleration_units_s2) return;
    if (options_.chose(option("joint", "second_command_decides"))) before.continuous = next.continuous;
    const motion::Joint joint = joint_between(before, next);
    if (joint.rule == motion::Joint::Rule::stop) return;
    if (goes_by_line_speed(before) != goes_by_line_speed(next))
      return;  // and so can a speed that is another one's
    motion::Path path;
    try {
      path = path_of(next, group.end);
    } catch (const motion::BadMotion&) {
      return;  // refused when its turn comes
    }
    if (!within_reach(next, path) || is_refused_as_empty(path)) return;
    note_ends(next, group.paths, path.end);
    group.motion.run.append(path, joint, now_);
    group.end = path.end;
    ++group.paths;
  }
}

// ---- Dropping

void Chain::drop_job(std::uint64_t number) {
  for (Module& each : modules_) {
    each.fifo.erase_if([&](const Job& job) { return job.number == number; });
  }
}

void Chain::drop_head(int module, Error why) {
  modules_[at(module)].late_error = why;
  drop_job(modules_[at(module)].fifo[0].number);
}

}  // namespace understudy::emulator::models::slim
