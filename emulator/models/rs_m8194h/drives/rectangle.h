// RS-M8194H: the outline of RECTANGLE (7.4.1), and the points at which it can begin.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace understudy::emulator::models::rs_m8194h {

/// The outline of a rectangle, counter-clockwise from the beginning of its lower side. Points with even
/// numbers are the eight tangent points, Sp0 to Sp7; points with odd numbers are the middles of sides and
/// corners (our copy of the manual lacks the drawing of 7.4.1).
struct RectanglePlan {
  std::array<std::array<double, 2>, 16> points{};
  std::array<std::array<double, 2>, 4> centres{};  // of the corners after points 2, 6, 10 and 14
};
inline RectanglePlan rectangle_plan(double length, double width, double radius) {
  const double right = length - radius;
  const double top = width - radius;
  RectanglePlan plan{.centres = {{{right, radius}, {right, top}, {radius, top}, {radius, radius}}}};
  const std::array<std::array<double, 2>, 8> tangents{{{radius, 0},
                                                       {right, 0},
                                                       {length, radius},
                                                       {length, top},
                                                       {right, width},
                                                       {radius, width},
                                                       {0, top},
                                                       {0, radius}}};
  const double diagonal = radius * std::sqrt(0.5);
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    const std::array<double, 2>& here = tangents[i];
    const std::array<double, 2>& next = tangents[(i + 1) % tangents.size()];
    plan.points[2 * i] = here;
    if (i % 2 == 0) {
      plan.points[2 * i + 1] = {(here[0] + next[0]) / 2, (here[1] + next[1]) / 2};
    } else {
      const std::array<double, 2>& centre = plan.centres[i / 2];
      const double right_or_left = i / 2 < 2 ? diagonal : -diagonal;
      const double up_or_down = i / 2 == 1 || i / 2 == 2 ? diagonal : -diagonal;
      plan.points[2 * i + 1] = {centre[0] + right_or_left, centre[1] + up_or_down};
    }
  }
  return plan;
}

}  // namespace understudy::emulator::models::rs_m8194h
