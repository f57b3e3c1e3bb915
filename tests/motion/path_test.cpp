// Lines, corners and the ends of every path. See path_arc_test.cpp for arcs and path_refusal_test.cpp for
// refusals.
#include "motion/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "motion/elementary.h"

namespace understudy::motion {
namespace path_test {

const Point kOrigin = Point::Zero();

void expect_near(const Point& is, const Point& should, double tolerance) {
  for (int axis = 0; axis < kPathAxes; ++axis)
    EXPECT_NEAR(is[axis], should[axis], tolerance) << "axis " << axis;
}

TEST(PathLine, HasThePrintedLengths) {
  struct Case {
    Point end;
    double length, longest;
  };
  for (const Case& row : std::vector<Case>{{{100, 50, 0, 0}, 111.8034, 100},
                                           {{30, 40, 120, 0}, 130, 120},
                                           {{0, 0, -7, 0}, 7, 7},
                                           {{1, -1, 1, -1}, 2, 1}}) {
    EXPECT_NEAR(line(kOrigin, row.end).length_u, row.length, 5e-5);
    EXPECT_EQ(line(kOrigin, row.end, Measure::longest_axis).length_u, row.longest);
  }
  EXPECT_EQ(line(kOrigin, {30, 40, 120, 0}).length_u, 130);
}

TEST(PathLine, GoesStraightAndEvenly) {
  const Path path = line({10, 20, 30, 40}, {13, 24, 30, 28});
  EXPECT_EQ(path.length_u, 13);
  expect_near(path.at(6.5), {11.5, 22, 30, 34}, 1e-14);
  expect_near(path.direction_at(1), Point(3, 4, 0, -12) / 13, 1e-15);
  const Path chip = line({10, 20, 30, 40}, {13, 24, 30, 28}, Measure::longest_axis);
  EXPECT_EQ(chip.at(3), Point(10.75, 21, 30, 37));
  EXPECT_EQ(chip.direction_at(3), path.direction_at(3));
}

TEST(PathLine, ByItsLongestAxisIsOnAWholePulseAtEachWholePulse) {
  // 49 * (1 / 49.0) is not 1: a fraction of the distance, multiplied out, would come a pulse late.
  for (const double length : {3.0, 7.0, 49.0, 107.0, 16'777'213.0}) {
    const Path path = line({0, 5, 0, 0}, {1, 5 - length, 0, 0}, Measure::longest_axis);
    for (double n = 0; n <= std::min(length, 1000.0); ++n) ASSERT_EQ(path.at(n).y(), 5 - n) << length;
  }
}

TEST(PathLine, OfNoLengthIsOverAtOnceAndHasNoDirection) {
  const Path path = line({1, 2, 3, 4}, {1, 2, 3, 4});
  EXPECT_EQ(path.length_u, 0);
  EXPECT_EQ(path.at(0), path.begin);
  EXPECT_EQ(path.at(5), path.begin);
  EXPECT_EQ(path.direction_at(0), kOrigin);
  EXPECT_EQ(Path{}.at(1), kOrigin);
  EXPECT_EQ(Path{}.direction_at(1), kOrigin);
}

TEST(PathLine, TooShortForItsSquareStillHasItsLength) {
  const Path path = line(kOrigin, {3e-200, -4e-200, 0, 0});
  EXPECT_DOUBLE_EQ(path.length_u, 5e-200);
  expect_near(path.direction_at(0), {0.6, -0.8, 0, 0}, 1e-15);
}

TEST(PathLine, NeverPassesItsEndHoweverUnevenItsCoordinates) {
  // begin + (end - begin) is not end here: their difference loses the third.
  const Path path = line({1e12, 0, 0, 0}, {1.0 / 3, 0, 0, 0});
  double before = 1e12;
  for (double rest = 1; rest > 1e-13; rest /= 2) {
    const double x = path.at(path.length_u * (1 - rest)).x();
    ASSERT_LE(x, before);
    ASSERT_GE(x, 1.0 / 3);
    before = x;
  }
  EXPECT_EQ(path.at(path.length_u).x(), 1.0 / 3);
  // The last length before the end, where a fraction of it rounds to the whole.
  for (int i = 1; i < 50; ++i) {
    const Path two = line({0x1p39 + 1, 0x1.b8p39, 0, 0}, {i / 51.0, 0, 0, 0});
    EXPECT_GE(two.at(std::nextafter(two.length_u, 0)).x(), two.end.x());
  }
}

TEST(Path, IsClampedToItsEndsAndNanIsItsBeginning) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Path& path :
       {line({1, 2, 3, 4}, {5, 6, 7, 8}), arc_by_centre({1, 0, 0, 0}, kOrigin, {0, 1, 9, 0}, Turn::clockwise),
        spiral({1, 0, 0, 0}, kOrigin, 9, 2)}) {
    EXPECT_EQ(path.at(-kInfinity), path.begin);
    EXPECT_EQ(path.at(-1), path.begin);
    EXPECT_EQ(path.at(0), path.begin);
    EXPECT_EQ(path.at(std::numeric_limits<double>::quiet_NaN()), path.begin);
    EXPECT_EQ(path.at(path.length_u), path.end);
    EXPECT_EQ(path.at(1e300), path.end);
    EXPECT_EQ(path.at(kInfinity), path.end);
    EXPECT_EQ(path.direction_at(-1), path.direction_at(0));
    EXPECT_EQ(path.direction_at(1e300), path.direction_at(path.length_u));
  }
}

TEST(Path, IsAValueThatIsCopiedAsBytes) {
  static_assert(std::is_trivially_destructible_v<Path>);
  static_assert(alignof(Path) == alignof(double));
  const Path path = arc_by_sweep(kOrigin, {0, 50, 0, 0}, 2);
  Path copy;
  std::memcpy(static_cast<void*>(&copy), &path, sizeof path);
  EXPECT_EQ(copy, path);
  EXPECT_EQ(copy.at(30), path.at(30));
}

TEST(PathCorner, IsTheDeflectionInDegrees) {
  const Path east = line(kOrigin, {10, 0, 0, 0});
  struct Case {
    Point end;
    double deflection;
  };
  for (const Case& row : std::vector<Case>{{{20, 0, 0, 0}, 0},
                                           {{20, 10, 0, 0}, 45},
                                           {{10, -5, 0, 0}, 90},
                                           {{10, 0, 3, 0}, 90},
                                           {{0, 10, 0, 0}, 135},
                                           {{0, 0, 0, 0}, 180},
                                           {{20, 1e-9, 0, 0}, 1e-10 * 180 / kPi},
                                           {{0, 1e-9, 0, 0}, 180 - 1e-10 * 180 / kPi}}) {
    EXPECT_NEAR(corner_deg(east, line({10, 0, 0, 0}, row.end)), row.deflection, 1e-13 * (1 + row.deflection));
  }
}

TEST(PathCorner, BetweenALineAndATangentArcIsNone) {
  const Path east = line({-10, 0, 0, 0}, kOrigin);
  const Path arc = arc_by_sweep(kOrigin, {0, 50, 0, 0}, kPi / 2);
  EXPECT_NEAR(corner_deg(east, arc), 0, 1e-13);
  EXPECT_NEAR(corner_deg(arc, line(arc.end, {50, 90, 0, 0})), 0, 1e-13);
  EXPECT_NEAR(corner_deg(east, arc_by_sweep(kOrigin, {0, 50, 0, 0}, -kPi / 2)), 180, 1e-5);
}

TEST(PathCorner, WithAPathOfNoLengthIsNone) {
  const Path east = line(kOrigin, {10, 0, 0, 0});
  const Path none = line({10, 0, 0, 0}, {10, 0, 0, 0});
  EXPECT_EQ(corner_deg(east, none), 0);
  EXPECT_EQ(corner_deg(none, east), 0);
}

}  // namespace path_test
}  // namespace understudy::motion
