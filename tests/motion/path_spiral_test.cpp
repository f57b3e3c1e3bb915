// Spirals: Archimedes' own formula, both ways, into the centre and out of it.
#include <gtest/gtest.h>

#include <cmath>

#include "motion/elementary.h"
#include "motion/path.h"

namespace understudy::motion {
namespace path_spiral_test {

const Point kOrigin = Point::Zero();

void expect_near(const Point& is, const Point& should, double tolerance) {
  for (int axis = 0; axis < kPathAxes; ++axis) {
    EXPECT_NEAR(is[axis], should[axis], tolerance) << "axis " << axis;
  }
}

/// Archimedes' spiral r = k * angle from its centre: k / 2 (angle sqrt(1 + angle^2) + asinh(angle)).
double length_from_the_centre(double k, double angle) {
  const long double a = angle;
  return static_cast<double>(k / 2 * (a * std::sqrt(1 + a * a) + std::asinh(a)));
}

TEST(PathSpiral, FromItsCentreHasArchimedesLengthAtEveryPlace) {
  for (const double turns : {0.1, 1.0, 10.0, 1000.0}) {
    const double k = 10 / (2 * kPi);
    const Path path = spiral(kOrigin, kOrigin, turns * 2 * kPi, 10);
    EXPECT_NEAR(path.length_u / length_from_the_centre(k, turns * 2 * kPi), 1, 1e-14);
    EXPECT_NEAR(path.end.norm(), 10 * turns, 1e-12 * turns);
    for (double share = 1e-6; share < 1; share *= 1.3) {
      const double angle = path.at(path.length_u * share).norm() / k;
      ASSERT_NEAR(length_from_the_centre(k, angle), path.length_u * share, 2e-14 * path.length_u) << share;
    }
  }
}

TEST(PathSpiral, InwardsIsTheOutwardOneBackwards) {
  const Path out = spiral({3, 0, 0, 0}, kOrigin, 20, 7, {0, 0, 40, 0});
  const Path in = spiral(out.end, kOrigin, -20, -7, {0, 0, -40, 0});
  EXPECT_NEAR(in.length_u, out.length_u, 1e-12);
  expect_near(in.end, out.begin, 1e-13);
  for (double share = 0; share <= 1; share += 1.0 / 64) {
    expect_near(in.at(in.length_u * share), out.at(out.length_u * (1 - share)), 1e-12);
  }
}

TEST(PathSpiral, MayEndInItsCentre) {
  const Path path = spiral({100, 0, 0, 0}, kOrigin, 20 * kPi, -10);
  expect_near(path.end, kOrigin, 1e-12);
  expect_near(path.at(path.length_u * (1 - 1e-12)), kOrigin, 1e-4);
  expect_near(path.direction_at(path.length_u), {-1, 0, 0, 0}, 1e-12);
  // A sweep that is a little too long does not pass through it.
  expect_near(spiral({100, 0, 0, 0}, kOrigin, 20 * kPi * (1 + 5e-10), -10).end, kOrigin, 1e-12);
}

TEST(PathSpiral, OfLittleGrowthAndMuchRiseIsExactToo) {
  const Path path = spiral({100, 0, 0, 0}, kOrigin, 2 * kPi, 0.1, {0, 0, 500, 0});
  // Simpson's rule over the pace: the fraction of the distance equals the fraction of the rise.
  const auto length_to = [](long double share) {
    const auto pace = [](long double at) {
      const long double round = 2 * std::acos(-1.0L) * (100 + 0.1L * at);
      return std::sqrt(round * round + 0.01L + 250'000);
    };
    return static_cast<double>(share / 6 * (pace(0) + 4 * pace(share / 2) + pace(share)));
  };
  EXPECT_NEAR(path.length_u, length_to(1), 1e-11);
  for (double along = 1; along < path.length_u; along += 1) {
    ASSERT_NEAR(length_to(path.at(along).z() / 500), along, 2e-12);
  }
}

TEST(PathSpiral, FromItsCentreLeavesAlongTheFirstAxis) {
  const Path path = spiral({1, 2, 3, 4}, {1, 2, 0, 0}, -2 * kPi, 10);
  expect_near(path.direction_at(0), {1, 0, 0, 0}, 1e-15);
  expect_near(path.at(1e-6), {1 + 1e-6, 2, 3, 4}, 1e-11);
  expect_near(path.end, {11, 2, 3, 4}, 1e-13);
}

TEST(PathSpiral, OfNoGrowthIsACircle) {
  EXPECT_EQ(spiral({3, 4, 0, 0}, kOrigin, 5, 0, {0, 0, 6, 0}),
            arc_by_sweep({3, 4, 0, 0}, kOrigin, 5, {0, 0, 6, 0}));
}

TEST(PathSpiral, GoesForwardInEveryStep) {
  for (const double growth : {-4.7, -1e-3, 1e-9, 3.0, 1e5}) {
    const Path path = spiral({10, 0, 0, 0}, kOrigin, 4 * kPi, growth);
    Point before = path.begin;
    for (int i = 1; i <= 20'000; ++i) {
      const Point here = path.at(path.length_u * i / 20'000);
      ASSERT_GT((here - before).dot(path.direction_at(path.length_u * (i - 0.5) / 20'000)), 0)
          << growth << " " << i;
      before = here;
    }
  }
}

}  // namespace path_spiral_test
}  // namespace understudy::motion
