#include "motion/path_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/bad_motion.h"

namespace understudy::motion {
namespace path_limits_test {

const double kQuarter = std::acos(0.0);

/// The oracle: the path sampled densely.
Point sampled(const Path& path) {
  Point max = Point::Zero();
  for (int i = 0; i <= 20000; ++i) {
    max = max.cwiseMax(path.direction_at(path.length_u * i / 20000).cwiseAbs());
  }
  return max;
}

TEST(PathLimits, TheGreatestPartsOfADirectionAreThoseOfDenseSamples) {
  const Point origin = Point::Zero();
  const Point centre(10, 5, 0, 0);
  const Path paths[] = {
      line(origin, Point(3, -4, 12, 0)),
      line(origin, origin),
      arc_by_sweep(origin, centre, 0.3),
      arc_by_sweep(origin, centre, -2.0),
      arc_by_sweep(origin, centre, 4 * kQuarter),
      arc_by_sweep(origin, centre, 1e6),
      arc_by_sweep(origin, centre, 1.0, Point(0, 0, 7, -3)),
      arc_by_sweep(origin, centre, -9.0, Point(0, 0, 7, -3)),
      arc_in_space(origin, Point(1, 2, 3, 4), Point(4, 2, 1, 9)),
  };
  for (std::size_t i = 0; i < std::size(paths); ++i) {
    const Point ours = greatest_direction(paths[i]);
    const Point oracle = sampled(paths[i]);
    // Dense samples miss a peak by half a step's angle at most, of which the cosine is nearly 1.
    const double missed = i == 5 ? 1e-2 : 1e-6;
    for (Eigen::Index axis = 0; axis < kPathAxes; ++axis) {
      EXPECT_GE(ours[axis], oracle[axis] - 1e-12) << "path " << i << " axis " << axis;
      EXPECT_LE(ours[axis], oracle[axis] + missed) << "path " << i << " axis " << axis;
    }
  }
}

TEST(PathLimits, NoAxisExceedsItsLimitOnASpiral) {
  const Path coil = spiral(Point(10, 0, 0, 0), Point::Zero(), 20, 3);
  const Point ours = greatest_direction(coil);
  const Point oracle = sampled(coil);
  for (Eigen::Index axis = 0; axis < kPathAxes; ++axis) EXPECT_GE(ours[axis], oracle[axis] - 1e-12);
  EXPECT_EQ(ours[2], 0);
}

TEST(PathLimits, SpeedIsWhatTheSlowestAxisAllows) {
  const Path path = line(Point::Zero(), Point(30, 40, 0, 0));
  EXPECT_DOUBLE_EQ(speed_within(path, Point(60, 1000, 1, 1)), 100);
  EXPECT_DOUBLE_EQ(speed_within(path, Point(1000, 60, 1, 1)), 75);
  EXPECT_TRUE(std::isinf(speed_within(line(Point::Zero(), Point::Zero()), Point(1, 1, 1, 1))));
}

TEST(PathLimits, ALimitOfNothingIsRefusedForAnAxisThatMoves) {
  const Path path = line(Point::Zero(), Point(30, 40, 0, 0));
  EXPECT_THROW(speed_within(path, Point(0, 1, 1, 1)), BadMotion);
  EXPECT_THROW(speed_within(path, Point(1, std::nan(""), 1, 1)), BadMotion);
  EXPECT_NO_THROW(speed_within(path, Point(1, 1, 0, 0)));
}

}  // namespace path_limits_test
}  // namespace understudy::motion
