#include "emulator/models/slim/motor/jobs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "motion/bad_motion.h"
#include "motion/path.h"
#include "motion/path_run.h"

namespace understudy::emulator::models::slim {

int Job::letter_of(int module) const {
  const auto found = std::find(module_of.begin(), module_of.end(), static_cast<std::int8_t>(module));
  return found == module_of.end() ? -1 : static_cast<int>(found - module_of.begin());
}

int Job::modules() const {
  return static_cast<int>(
      std::count_if(module_of.begin(), module_of.end(), [](std::int8_t module) { return module >= 0; }));
}

namespace {

/// Returns the left-hand sweep over which the spiral grows from one radius to the other.
double sweep_to_radius(const Job& spiral, double begin_radius_units) {
  const double turns = (spiral.sweep_deg - begin_radius_units) / spiral.growth_units_turn;
  motion::require_not_negative(spiral.sweep_deg, "spiral", "its last radius");
  motion::require_not_negative(turns, "spiral", "its sweep");
  return turns * 2 * std::numbers::pi;
}

}  // namespace

motion::Path path_of(const Job& job, const motion::Point& begin) {
  const auto place = [&](std::size_t i) {
    return job.units[i] + (job.absolute ? 0.0 : begin[static_cast<Eigen::Index>(i)]);
  };
  motion::Point there = begin;
  if (job.kind == Job::Kind::line) {
    for (std::size_t i = 0; i < job.units.size(); ++i) {
      if (job.module_of[i] >= 0) there[static_cast<Eigen::Index>(i)] = place(i);
    }
    return motion::line(begin, there);
  }
  there[0] = place(0);
  there[1] = place(1);
  if (job.by_radius && job.kind == Job::Kind::arc) {
    return motion::arc_by_radius(begin, there, job.sweep_deg, motion::Turn::counter_clockwise);
  }
  const double sweep_rad = job.by_radius
                               ? sweep_to_radius(job, std::hypot(begin[0] - there[0], begin[1] - there[1]))
                               : job.sweep_deg * std::numbers::pi / 180;
  if (job.kind == Job::Kind::spiral) {
    return motion::spiral(begin, there, sweep_rad, job.growth_units_turn);
  }
  motion::Point rise = motion::Point::Zero();
  if (job.module_of[2] >= 0) rise[2] = job.units[2] - (job.height_absolute ? begin[2] : 0.0);
  // The centre is the present position: nothing turns, and only the rise remains.
  if (there[0] == begin[0] && there[1] == begin[1]) return motion::line(begin, begin + rise);
  return motion::arc_by_sweep(begin, there, sweep_rad, rise);
}

motion::Joint joint_between(const Job& job, const Job& next) {
  using Rule = motion::Joint::Rule;
  const bool off = job.continuous == ContinuousPath::off || next.continuous == ContinuousPath::off;
  if (off || job.module_of != next.module_of) return {.rule = Rule::stop};
  const bool by_angle =
      job.continuous == ContinuousPath::by_angle || next.continuous == ContinuousPath::by_angle;
  if (!by_angle) return {.rule = Rule::join};
  // "Only between two-axis lines, two-axis arcs, or three-axis lines and three-axis lines."
  const bool lines = job.kind == Job::Kind::line && next.kind == Job::Kind::line;
  const bool allowed = next.modules() == 2 || (next.modules() == 3 && lines);
  if (!allowed) return {.rule = Rule::stop};
  return {.rule = Rule::join_below, .corner_deg = next.smooth_corner_deg};
}

}  // namespace understudy::emulator::models::slim
