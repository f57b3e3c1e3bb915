#include "motion/path_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/bad_motion.h"
#include "motion/elementary.h"
#include "motion/path.h"

namespace understudy::motion {

namespace {

/// Returns true if an angle that repeats every half turn lies within the sweep.
bool passes(const Path& arc, double angle_rad) {
  const double first = std::min(arc.begin_angle_rad, arc.begin_angle_rad + arc.sweep_rad);
  const double last = std::max(arc.begin_angle_rad, arc.begin_angle_rad + arc.sweep_rad);
  const double next = angle_rad + kPi * std::ceil((first - angle_rad) / kPi);
  return next <= last;
}

Point of_circle(const Path& path) {
  // Along a circle, the component of axis i is |cos * ordinate_i - sin * abscissa_i|, times the fraction that
  // the rise leaves.
  const double turn = path.begin_radius_u * std::abs(path.sweep_rad);
  const double whole = std::sqrt(turn * turn + path.rise.squaredNorm());
  Point greatest = Point::Zero();
  if (whole == 0) return greatest;
  greatest = path.direction_at(0).cwiseAbs().cwiseMax(path.direction_at(path.length_u).cwiseAbs());
  for (Eigen::Index i = 0; i < kPathAxes; ++i) {
    const double a = path.abscissa[i];
    const double o = path.ordinate[i];
    if (!passes(path, angle_of(-a, o))) continue;
    // The rise affects the same axis only if the plane is oblique; then this is an upper bound.
    greatest[i] = std::min(1.0, (std::sqrt(a * a + o * o) * turn + std::abs(path.rise[i])) / whole);
  }
  return greatest;
}

}  // namespace

Point greatest_direction(const Path& path) {
  if (path.kind == Path::Kind::line) return path.direction_at(0).cwiseAbs();
  if (path.radius_slope_u_rad == 0) return of_circle(path);
  Point bound = Point::Zero();
  for (Eigen::Index i = 0; i < kPathAxes; ++i) {
    const bool moves = path.abscissa[i] != 0 || path.ordinate[i] != 0 || path.rise[i] != 0;
    bound[i] = moves ? 1 : 0;
  }
  return bound;
}

double speed_within(const Path& path, const Point& axis_limits_u_s) {
  const Point parts = greatest_direction(path);
  double speed = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < kPathAxes; ++i) {
    if (parts[i] == 0) continue;
    require_positive(axis_limits_u_s[i], "path", "speed limit of an axis that moves");
    speed = std::min(speed, axis_limits_u_s[i] / parts[i]);
  }
  return speed;
}

}  // namespace understudy::motion
