// Commands of several modules together.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/models/slim/chain.h"
#include "emulator/models/slim/jobs.h"
#include "emulator/models/slim/module.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/bad_motion.h"
#include "motion/path.h"

namespace understudy::emulator::models::slim {

Error Chain::assign(Letter letter, int module) {
  if (module != kUnassigned && (module < 0 || module >= kMappable)) return Error::range;
  const auto mine = static_cast<std::size_t>(letter);
  const auto number = module == kUnassigned ? kNoModule : static_cast<std::int8_t>(module);
  for (std::size_t i = 0; i < map_.size(); ++i) {
    if (i != mine && number != kNoModule && map_[i] == number) return Error::range;
  }
  map_[mine] = number;
  return Error::none;
}

int Chain::assigned(Letter letter) const {
  const int module = map_[static_cast<std::size_t>(letter)];
  return module < 0 ? kUnassigned : module;
}

Error Chain::line(std::span<const double> units, bool absolute) {
  if (units.size() < 2 || units.size() > map_.size()) return Error::range;
  Job job{.kind = Job::Kind::line, .absolute = absolute};
  for (std::size_t i = 0; i < units.size(); ++i) {
    job.module_of[i] = map_[i];
    job.units[i] = units[i];
    if (map_[i] < 0) return Error::axis;
  }
  return enqueue_coordinated(job);
}

Error Chain::arc(const ArcOrder& order) {
  Job job{.kind = Job::Kind::arc, .absolute = order.absolute, .sweep_deg = order.sweep_deg};
  job.units = {order.centre_x_units, order.centre_y_units, order.height_units.value_or(0), 0};
  if (order.radius_units) {
    job.by_radius = true;
    job.sweep_deg = *order.radius_units;
  }
  job.height_absolute = order.absolute || options_.chose(option("sar_height", "absolute"));
  const std::size_t letters = order.height_units ? 3 : 2;
  for (std::size_t i = 0; i < letters; ++i) {
    job.module_of[i] = map_[i];
    if (map_[i] < 0) return Error::axis;
  }
  return enqueue_coordinated(job);
}

Error Chain::spiral(double centre_x_units, double centre_y_units, double sweep_deg, double growth_units) {
  Job job{.kind = Job::Kind::spiral, .sweep_deg = sweep_deg, .growth_units_turn = growth_units};
  job.absolute = !options_.chose(option("spiral_centre", "relative"));
  job.by_radius = options_.chose(option("spiral_r", "radius_at_its_end"));
  if (options_.chose(option("spiral", "sweep_in_degrees_and_growth_in_all")) && growth_units != 0 &&
      !job.by_radius) {
    // On no way at all no radius can change.
    job.growth_units_turn = sweep_deg == 0 ? HUGE_VAL : growth_units * (360 / std::abs(sweep_deg));
    if (!std::isfinite(job.growth_units_turn)) return Error::range;
  }
  job.units = {centre_x_units, centre_y_units, 0, 0};
  for (std::size_t i = 0; i < 2; ++i) {
    job.module_of[i] = map_[i];
    if (map_[i] < 0) return Error::axis;
  }
  return enqueue_coordinated(job);
}

Error Chain::enqueue_coordinated(Job job) {
  motion::Point begin = motion::Point::Zero();
  bool begin_is_known = true;  // while a jog runs, it is a guess
  const ModuleSettings& first = modules_[at(job.module_of[0])].settings;
  for (std::size_t i = 0; i < job.module_of.size(); ++i) {
    const int module = job.module_of[i];
    if (module < 0) continue;
    if (const Error why = refusal_of_motion(module); why != Error::none) return why;
    const ModuleSettings& mine = modules_[at(module)].settings;
    const bool equal = path_speed(job, mine) == path_speed(job, first) &&
                       mine.path_acceleration_units_s2 == first.path_acceleration_units_s2;
    if (!equal && !speeds_are_of_t0()) return Error::unequal_speeds;
    const Activity activity = modules_[at(module)].activity;
    begin_is_known = begin_is_known && activity != Activity::jog && activity != Activity::thrust &&
                     activity != Activity::stopping;
    begin[static_cast<Eigen::Index>(i)] = end_expected(module);
  }
  job.continuous = continuous_;
  job.smooth_corner_deg = modules_[0].settings.smooth_corner_deg;
  if (acceleration_may_change()) {
    job.path_acceleration_units_s2 = path_settings(job).path_acceleration_units_s2;
  }
  try {
    const motion::Path path = path_of(job, begin);
    if (!within_reach(job, path)) return Error::range;
    if (begin_is_known && is_refused_as_empty(path)) return Error::range;
    for (std::size_t i = 0; i < job.ends.size(); ++i) job.ends[i] = path.end[static_cast<Eigen::Index>(i)];
  } catch (const motion::BadMotion&) {
    return Error::range;
  }
  return enqueue(job);
}

/// Whose speed and acceleration count.
const ModuleSettings& Chain::path_settings(const Job& job) const {
  return modules_[speeds_are_of_t0() ? 0 : at(job.module_of[0])].settings;
}

/// PR4 instead of PR3.
bool Chain::goes_by_line_speed(const Job& job) const {
  return lines_have_own_speed() && job.kind == Job::Kind::line && job.modules() == 2;
}

double Chain::path_speed(const Job& job, const ModuleSettings& settings) const {
  return goes_by_line_speed(job) ? settings.line_speed_units_s : settings.path_speed_units_s;
}

/// Of an arc, all that the circle may reach.
bool Chain::within_reach(const Job& job, const motion::Path& path) const {
  const bool turns = job.kind != Job::Kind::line;
  const double end_radius_u = path.begin_radius_u + path.radius_slope_u_rad * std::abs(path.sweep_rad);
  const double radius_u = turns ? std::max(path.begin_radius_u, end_radius_u) : 0;
  for (std::size_t i = 0; i < job.module_of.size(); ++i) {
    if (job.module_of[i] < 0) continue;
    const Module& mine = modules_[at(job.module_of[i])];
    const auto axis = static_cast<Eigen::Index>(i);
    const double farthest = turns ? std::abs(path.centre[axis]) + radius_u : 0;
    if (!mine.reaches(path.end[axis]) || (i < 2 && !mine.reaches(farthest))) return false;
  }
  return true;
}

Error Chain::set_continuous_path(int mode) {
  if (mode < 0 || mode > 2) return Error::range;
  continuous_ = static_cast<ContinuousPath>(mode);
  return Error::none;
}

}  // namespace understudy::emulator::models::slim
