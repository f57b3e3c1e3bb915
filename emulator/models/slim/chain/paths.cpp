#include "emulator/models/slim/chain/paths.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/jogs.h"
#include "emulator/models/slim/motor/marks.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/moves.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/move.h"
#include "motion/path.h"
#include "motion/path_run.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::slim {

const ModuleSettings& path_settings(const ChainState& chain, const Job& job) {
  return chain.modules[chain.options.speeds_are_of_t0() ? 0 : at(job.module_of[0])].settings;
}

bool goes_by_line_speed(const ChainOptions& options, const Job& job) {
  return options.lines_have_own_speed() && job.kind == Job::Kind::line && job.modules() == 2;
}

double path_speed(const ChainOptions& options, const Job& job, const ModuleSettings& settings) {
  return goes_by_line_speed(options, job) ? settings.line_speed_units_s : settings.path_speed_units_s;
}

bool within_reach(const ChainState& chain, const Job& job, const motion::Path& path) {
  const bool turns = job.kind != Job::Kind::line;
  const double end_radius_u = path.begin_radius_u + path.radius_slope_u_rad * std::abs(path.sweep_rad);
  const double radius_u = turns ? std::max(path.begin_radius_u, end_radius_u) : 0;
  for (std::size_t i = 0; i < job.module_of.size(); ++i) {
    if (job.module_of[i] < 0) continue;
    const Module& mine = chain.modules[at(job.module_of[i])];
    const auto axis = static_cast<Eigen::Index>(i);
    const double farthest = turns ? std::abs(path.centre[axis]) + radius_u : 0;
    if (!mine.reaches(path.end[axis]) || (i < 2 && !mine.reaches(farthest))) return false;
  }
  return true;
}

bool is_refused_as_empty(const ChainOptions& options, const motion::Path& path) {
  return path.length_u == 0 && options.chose(option("path_without_length", "error_2"));
}

// ---- Beginning

bool free_to_move(const ChainState& chain, int module) {
  return !chain.held(module) && chain.modules[at(module)].activity == Activity::idle &&
         !chain.axes[at(module)].moving();
}

namespace {

bool at_all_places(const ChainState& chain, const Job& job, std::size_t place) {
  for (const std::int8_t module : job.module_of) {
    if (module < 0) continue;
    const auto& fifo = chain.modules[at(module)].fifo;
    if (fifo.size() <= place || fifo[place].number != job.number) return false;
  }
  return true;
}

motion::Point begin_of(const ChainState& chain, const Job& job) {
  motion::Point begin = motion::Point::Zero();
  for (std::size_t i = 0; i < job.module_of.size(); ++i) {
    if (job.module_of[i] < 0) continue;
    begin[static_cast<Eigen::Index>(i)] = chain.modules[at(job.module_of[i])].place_units;
  }
  return begin;
}

void note_ends(ChainState& chain, const Job& job, std::size_t place, const motion::Point& end) {
  for (const std::int8_t module : job.module_of) {
    if (module < 0) continue;
    Job& mine = chain.modules[at(module)].fifo[place];
    for (std::size_t i = 0; i < mine.ends.size(); ++i) mine.ends[i] = end[static_cast<Eigen::Index>(i)];
  }
}

/// Returns the path of a job that begins at a place, or nothing if the path is impossible, too long, or
/// (depending on a choice) empty.
std::optional<motion::Path> path_from(const ChainState& chain, const Job& job, const motion::Point& begin) {
  try {
    const motion::Path path = path_of(job, begin);
    if (within_reach(chain, job, path) && !is_refused_as_empty(chain.options, path)) return path;
  } catch (const motion::BadMotion&) {
    return std::nullopt;
  }
  return std::nullopt;
}

/// Completes a path without length immediately.
void finish_empty(ChainState& chain, const Job& job, const motion::Point& end) {
  for (std::size_t i = 0; i < job.module_of.size(); ++i) {
    if (job.module_of[i] < 0) continue;
    Module& mine = chain.modules[at(job.module_of[i])];
    mine.place_units = end[static_cast<Eigen::Index>(i)];
    mine.fifo.pop();
  }
}

/// Returns a group that is ready to begin the job's path.
Group group_for(const ChainState& chain, const Job& job, const motion::Path& path) {
  Group group;
  const ModuleSettings& speeds = path_settings(chain, job);
  const bool has_slope = job.path_acceleration_units_s2 != 0;
  const auto ramp = motion::RampLaw::by_slope(has_slope ? job.path_acceleration_units_s2
                                                        : speeds.path_acceleration_units_s2);
  for (std::size_t i = 0; i < job.module_of.size(); ++i) {
    group.motion.axis_of[i] = job.module_of[i];
    if (job.module_of[i] >= 0) group.motion.scale[i] = chain.modules[at(job.module_of[i])].settings.scale;
  }
  using Late = motion::PathRun::LateJoint;
  group.motion.run.set_late_joint(chain.options.chose(option("late_successor", "speeds_up_again"))
                                      ? Late::speed_up_again
                                      : Late::from_rest);
  const double top_speed_u_s = path_speed(chain.options, job, speeds);
  group.motion.run.set_speed({.top_speed_u_s = top_speed_u_s, .up = ramp, .down = ramp}, chain.now);
  group.motion.run.append(path, {}, chain.now);
  return group;
}

}  // namespace

bool start_group(ChainState& chain, int module, Tick begin_at) {
  const Job job = chain.modules[at(module)].fifo[0];
  if (!at_all_places(chain, job, 0)) return false;
  for (const std::int8_t member : job.module_of) {
    if (member >= 0 && !free_to_move(chain, member)) return false;
  }
  for (const std::int8_t member : job.module_of) {
    if (member < 0 || chain.axes[at(member)].servo_on) continue;
    chain.modules[at(member)].late_error = Error::servo_off;
    drop_job(chain, job.number);
    return true;
  }
  Group* group = nullptr;
  for (Group& each : chain.groups) {
    if (!each.motion.engaged) group = &each;
  }
  if (group == nullptr) return false;
  const motion::Point begin = begin_of(chain, job);
  const std::optional<motion::Path> path = path_from(chain, job, begin);
  if (!path) {
    drop_head(chain, module, Error::range);
    return true;
  }
  note_ends(chain, job, 0, path->end);
  if (path->length_u == 0) {
    finish_empty(chain, job, path->end);
    return true;
  }
  *group = group_for(chain, job, *path);
  if (group->motion.begin(begin, chain.axes, begin_at - 1) != motion::Cause::none) {
    *group = {};
    drop_head(chain, module, Error::not_allowed);
    return true;
  }
  group->paths = 1;
  group->end = path->end;
  for (const std::int8_t member : job.module_of) {
    if (member >= 0) chain.modules[at(member)].activity = Activity::group;
  }
  return false;
}

void extend_group(ChainState& chain, Group& group) {
  if (group.paths == 0 || group.motion.slowing_for != motion::Cause::none) return;
  const auto& fifo = chain.modules[at(group.motion.axis_of[0])].fifo;  // every group contains X
  while (fifo.size() > group.paths && !group.motion.run.full()) {
    const Job next = fifo[group.paths];
    if (!next.coordinated() || !at_all_places(chain, next, group.paths)) return;
    Job before = fifo[group.paths - 1U];
    // The acceleration can change only at rest, and so can the parameter that determines the speed.
    if (before.path_acceleration_units_s2 != next.path_acceleration_units_s2) return;
    if (chain.options.chose(option("joint", "second_command_decides"))) before.continuous = next.continuous;
    const motion::Joint joint = joint_between(before, next);
    if (joint.rule == motion::Joint::Rule::stop) return;
    if (goes_by_line_speed(chain.options, before) != goes_by_line_speed(chain.options, next)) return;
    const std::optional<motion::Path> path = path_from(chain, next, group.end);
    if (!path) return;  // it will be refused when it reaches the head
    note_ends(chain, next, group.paths, path->end);
    group.motion.run.append(*path, joint, chain.now);
    group.end = path->end;
    ++group.paths;
  }
}

// ---- Ending

void drop_completed(ChainState& chain, Group& group) {
  const int done = std::min<int>(group.motion.run.completed(), group.paths);
  for (std::size_t i = 0; i < group.motion.axis_of.size(); ++i) {
    if (group.motion.axis_of[i] < 0) continue;
    Module& mine = chain.modules[at(group.motion.axis_of[i])];
    for (int path = 0; path < done; ++path) {
      mine.place_units = mine.fifo[0].ends[i];
      mine.fifo.pop();
    }
  }
  group.paths = static_cast<std::uint8_t>(group.paths - done);
}

void release_group(ChainState& chain, Group& group, Tick begin_at) {
  const auto members = group.motion.axis_of;
  for (const std::int8_t member : members) {
    if (member < 0) continue;
    Module& mine = chain.modules[at(member)];
    for (int i = 0; i < group.paths; ++i) mine.fifo.pop();
    if (group.motion.cause != motion::Cause::arrived) {
      mine.place_units = mine.coordinate(chain.axes[at(member)]);
    }
    take_off(mine, MarkEvent::stands);
  }
  group = {};
  for (const std::int8_t member : members) {
    if (member >= 0) begin_next_jog(chain.motor(member), begin_at);
  }
}

namespace {

void end_group(ChainState& chain, Group& group, motion::Cause why) {
  group.motion.stop(chain.axes, why);
  release_group(chain, group, chain.now + 1);
}

}  // namespace

void cut(ChainState& chain, int module, motion::Cause why) {
  if (Group* group = chain.group_of(module); group != nullptr) end_group(chain, *group, why);
  cut_motion(chain.motor(module), why);
}

void slow_for_discard(ChainState& chain, int module) {
  const Activity activity = chain.modules[at(module)].activity;
  if (Group* group = chain.group_of(module); group != nullptr) {
    if (group->motion.run.at_rest(chain.now)) {
      end_group(chain, *group, motion::Cause::stopped);
    } else {
      group->paths = 0;
      group->motion.slow_down(chain.now);
    }
  } else if (activity == Activity::move || activity == Activity::home) {
    slow_down_for_good(chain.motor(module));
  }
}

}  // namespace understudy::emulator::models::slim
