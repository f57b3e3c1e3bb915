// Arcs and helices by every function: printed lengths, ends, ambiguous cases, difficult points.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/bad_motion.h"
#include "motion/elementary.h"
#include "motion/path.h"

namespace understudy::motion {
namespace path_arc_test {

const Point kOrigin = Point::Zero();
constexpr double kDegree = kPi / 180;
constexpr Turn kLeft = Turn::counter_clockwise;
constexpr Turn kRight = Turn::clockwise;

ArcOptions with(OffCircle off_circle) { return {.plane = {}, .off_circle = off_circle}; }
ArcOptions by_longest_axis(Plane plane = {}) { return {.plane = plane, .measure = Measure::longest_axis}; }

void expect_near(const Point& is, const Point& should, double tolerance) {
  for (int axis = 0; axis < kPathAxes; ++axis)
    EXPECT_NEAR(is[axis], should[axis], tolerance) << "axis " << axis;
}

TEST(PathArc, HasThePrintedLengthsAndEnds) {
  struct Case {
    Point centre;
    double sweep_deg;
    Point rise;
    double length;
    Point end;
  };
  for (const Case& row : std::vector<Case>{{{0, 50, 0, 0}, 90, kOrigin, 78.5398, {50, 50, 0, 0}},
                                           {{100, 100, 0, 0}, 360, kOrigin, 888.5766, kOrigin},
                                           {{50, 150, 0, 0}, -720, kOrigin, 1986.9177, kOrigin},
                                           {{10, 0, 0, 0}, 360, {0, 0, 5, 0}, 63.0305, {0, 0, 5, 0}}}) {
    const Path path = arc_by_sweep(kOrigin, row.centre, row.sweep_deg * kDegree, row.rise);
    EXPECT_NEAR(path.length_u, row.length, 5e-5) << row.sweep_deg;
    EXPECT_EQ(path.end, row.end) << row.sweep_deg;
  }
}

TEST(PathArc, OfWholeQuartersEndsOnTheVeryPoint) {
  // However a caller calculates the sweep: k * 90 degrees and k * (pi / 2) sometimes differ by a bit.
  const Point centre{0, 50, 0, 0};
  const Point ends[] = {kOrigin, {50, 50, 0, 0}, {0, 100, 0, 0}, {-50, 50, 0, 0}};
  for (int quarters = 1; quarters <= 40; ++quarters) {
    EXPECT_EQ(arc_by_sweep(kOrigin, centre, 90 * quarters * kDegree).end, ends[quarters % 4]) << quarters;
    EXPECT_EQ(arc_by_sweep(kOrigin, centre, -90 * quarters * kDegree).end, ends[(4 - quarters % 4) % 4])
        << -quarters;
  }
}

TEST(PathArc, GoesRoundInTheDirectionOfItsSweep) {
  const double r = 50 * std::sqrt(0.5);
  const Path left = arc_by_sweep(kOrigin, {0, 50, 0, 0}, 90 * kDegree);
  expect_near(left.at(left.length_u / 2), {r, 50 - r, 0, 0}, 1e-13);
  expect_near(left.direction_at(0), {1, 0, 0, 0}, 1e-15);
  expect_near(left.direction_at(left.length_u), {0, 1, 0, 0}, 1e-15);
  const Path right = arc_by_sweep(kOrigin, {0, 50, 0, 0}, -90 * kDegree);
  expect_near(right.at(right.length_u / 2), {-r, 50 - r, 0, 0}, 1e-13);
  EXPECT_EQ(right.end, Point(-50, 50, 0, 0));
}

TEST(PathArc, LiesInAnyPlaneOfTwoAxes) {
  for (std::int8_t first = 0; first < kPathAxes; ++first) {
    for (std::int8_t second = 0; second < kPathAxes; ++second) {
      if (first == second) continue;
      Point begin(1, 2, 3, 4);
      Point centre(9, 9, 9, 9);  // counts only in the plane
      centre[first] = begin[first];
      centre[second] = begin[second] + 10;
      Point end = begin;
      end[first] += 10;
      end[second] += 10;
      const Path path = arc_by_centre(begin, centre, end, kLeft, {.plane = {first, second}});
      EXPECT_NEAR(path.sweep_rad, kPi / 2, 1e-15);
      Point half = begin;
      half[first] += 10 * std::sqrt(0.5);
      half[second] += 10 * (1 - std::sqrt(0.5));
      expect_near(path.at(path.length_u / 2), half, 1e-13);
    }
  }
}

TEST(PathArc, ByCentreTakesTheSideOfItsTurnAndAddsWholeTurns) {
  const Point begin(10, 0, 0, 0);
  const Point end(0, 10, 0, 0);
  EXPECT_NEAR(arc_by_centre(begin, kOrigin, end, kLeft).sweep_rad, kPi / 2, 1e-15);
  EXPECT_NEAR(arc_by_centre(begin, kOrigin, end, kRight).sweep_rad, -3 * kPi / 2, 1e-15);
  EXPECT_NEAR(arc_by_centre(begin, kOrigin, end, kLeft, {}, 3).sweep_rad, 6.5 * kPi, 1e-14);
  EXPECT_NEAR(arc_by_centre(begin, kOrigin, end, kRight, {}, 1).sweep_rad, -3.5 * kPi, 1e-14);
  EXPECT_NEAR(arc_by_centre(begin, kOrigin, -begin, kLeft).sweep_rad, kPi, 0);
  EXPECT_NEAR(arc_by_centre(begin, kOrigin, -begin, kRight).sweep_rad, -kPi, 0);
  const Path turns = arc_by_centre(begin, kOrigin, begin, kRight, {}, 999);
  EXPECT_DOUBLE_EQ(turns.sweep_rad, -2000 * kPi);
  EXPECT_DOUBLE_EQ(turns.length_u, 20'000 * kPi);
  expect_near(turns.at(turns.length_u / 2), begin, 1e-10);
}

TEST(PathArc, ThatEndsWhereItBeganIsAFullCircleDespiteRounding) {
  const Point begin(100.1, 0.3, 0, 0);
  const Point centre(0.1, 0.3, 0, 0);
  EXPECT_EQ(arc_by_centre(begin, centre, begin, kLeft).sweep_rad, 2 * kPi);
  EXPECT_EQ(arc_by_centre(begin, centre, begin, kRight).sweep_rad, -2 * kPi);
  for (const double off : {1e-13, -1e-13, 1e-8, -1e-8, 9e-8, -9e-8}) {
    for (const Turn turn : {kLeft, kRight}) {
      const Point end = begin + Point(0, off, 0, 0);
      const Path path = arc_by_centre(begin, centre, end, turn);
      EXPECT_NEAR(std::abs(path.sweep_rad), 2 * kPi, 1e-9) << off;
      EXPECT_EQ(path.sweep_rad < 0, turn == kRight);
      EXPECT_EQ(path.end, end);
      expect_near(path.at(path.length_u * (1 - 1e-15)), end, 1e-11);
    }
  }
}

TEST(PathArc, ThatEndsBeyondRoundingIsAShortArcOrNearlyATurn) {
  const Point begin(100, 0, 0, 0);
  const double off = 2e-7;  // 2e-9 rad
  EXPECT_NEAR(arc_by_centre(begin, kOrigin, {100, off, 0, 0}, kLeft).sweep_rad, 2e-9, 1e-22);
  EXPECT_NEAR(arc_by_centre(begin, kOrigin, {100, off, 0, 0}, kRight).sweep_rad, 2e-9 - 2 * kPi, 1e-15);
  EXPECT_NEAR(arc_by_centre(begin, kOrigin, {100, -off, 0, 0}, kRight).sweep_rad, -2e-9, 1e-22);
}

TEST(PathArc, OffItsCircleIsRefusedBlendedOrEndsInTheQuadrant) {
  const Point centre(10'000, 0, 0, 0);
  const Point end(11'000, 9000, 0, 0);
  EXPECT_THROW(arc_by_centre(kOrigin, centre, end, kRight), BadMotion);

  const Path blend = arc_by_centre(kOrigin, centre, end, kRight, with(OffCircle::blend));
  EXPECT_EQ(blend.end, end);
  EXPECT_EQ(blend.begin_radius_u, 10'000);
  EXPECT_NEAR(blend.begin_radius_u + blend.radius_slope_u_rad * std::abs(blend.sweep_rad), 9055.385, 1e-3);
  expect_near(blend.at(blend.length_u * (1 - 1e-15)), end, 1e-9);

  const Path chip = arc_by_centre(kOrigin, centre, end, kRight, with(OffCircle::quadrant));
  EXPECT_EQ(chip.radius_slope_u_rad, 0);
  expect_near(chip.end, {11'000, std::sqrt(1e8 - 1e6), 0, 0}, 1e-11);
  expect_near(chip.at(chip.length_u * (1 - 1e-15)), chip.end, 1e-9);
}

TEST(PathArc, InTheQuadrantEndsAtTheShorterCoordinate) {
  struct Case {
    Point end, met;  // relative to the centre; the radius is 5
  };
  for (const Case& row : std::vector<Case>{{{3, 40, 0, 0}, {3, 4, 0, 0}},
                                           {{-3, 40, 0, 0}, {-3, 4, 0, 0}},
                                           {{-9, -4, 0, 0}, {-3, -4, 0, 0}},
                                           {{3.5, -3, 0, 0}, {4, -3, 0, 0}},
                                           {{3, 3, 0, 0}, {3, 4, 0, 0}},  // equal: the first axis's is used
                                           {{-7, 0, 0, 0}, {-5, 0, 0, 0}},
                                           {{0, -2, 8, 0}, {0, -5, 8, 0}},
                                           {{7, 0, 0, 0}, {5, 0, 0, 0}}}) {  // its start: a full circle
    const Path path = arc_by_centre({5, 0, 0, 0}, kOrigin, row.end, kLeft, with(OffCircle::quadrant));
    EXPECT_EQ(path.end, row.met) << row.end.transpose();
    EXPECT_GT(path.sweep_rad, 0.5);
  }
}

TEST(PathArc, FromTheChipsManualIsAHalfCircle) {
  const Path path = arc_by_centre(kOrigin, {-5000, -5000, 0, 0}, {-10'000, -10'000, 0, 0}, kRight);
  EXPECT_EQ(path.sweep_rad, -kPi);
  EXPECT_NEAR(path.begin_radius_u, 7071, 0.5);
  EXPECT_EQ(path.radius_slope_u_rad, 0);
  expect_near(path.at(path.length_u / 2), {0, -10'000, 0, 0}, 1e-11);
}

TEST(PathArc, ByRadiusIsShortIfPositiveAndLongIfNegative) {
  const Point end(10, 10, 0, 0);
  struct Case {
    double radius;
    Turn turn;
    double sweep_deg;
    Point centre;
  };
  for (const Case& row : std::vector<Case>{{10, kLeft, 90, {0, 10, 0, 0}},
                                           {10, kRight, -90, {10, 0, 0, 0}},
                                           {-10, kLeft, 270, {10, 0, 0, 0}},
                                           {-10, kRight, -270, {0, 10, 0, 0}}}) {
    const Path path = arc_by_radius(kOrigin, end, row.radius, row.turn);
    EXPECT_NEAR(path.sweep_rad, row.sweep_deg * kDegree, 1e-14);
    expect_near(path.centre, row.centre, 1e-14);
    EXPECT_EQ(path.end, end);
    expect_near(path.at(path.length_u * (1 - 1e-15)), end, 1e-13);
  }
}

TEST(PathArc, ByRadiusOfHalfATurnIsTheSameForBothSigns) {
  for (const double radius : {5.0, -5.0, 5 - 4e-7, -5 + 4e-7}) {  // the last two: within the tolerance
    const Path left = arc_by_radius(kOrigin, {10, 0, 0, 0}, radius, kLeft);
    EXPECT_EQ(left.sweep_rad, kPi);
    expect_near(left.at(left.length_u / 2), {5, -5, 0, 0}, 1e-14);
    const Path right = arc_by_radius(kOrigin, {10, 0, 0, 0}, radius, kRight);
    EXPECT_EQ(right.sweep_rad, -kPi);
    expect_near(right.at(right.length_u / 2), {5, 5, 0, 0}, 1e-14);
  }
}

TEST(PathArc, ByThreePointsPassesThroughThem) {
  const Point a(5, 0, 0, 0);
  const Point b(3, 4, 0, 0);
  const Point c(-5, 0, 0, 0);
  const Path path = arc_by_three_points(a, b, c);
  EXPECT_NEAR(path.sweep_rad, kPi, 1e-15);
  expect_near(path.centre, kOrigin, 1e-15);
  expect_near(path.at(5 * std::atan2(4, 3)), b, 1e-14);
  EXPECT_NEAR(arc_by_three_points(c, b, a).sweep_rad, -kPi, 1e-15);
  EXPECT_NEAR(arc_by_three_points(a, c, b).sweep_rad, std::atan2(4, 3) - 2 * kPi, 1e-14);
  EXPECT_NEAR(arc_by_three_points(b, a, c).sweep_rad, -(kPi + std::atan2(4, 3)), 1e-14);
}

TEST(PathArc, ByThreePointsMeetsItsEndHoweverFlatItIs) {
  for (const double height : {1e-3, 1e-6, 2e-9}) {
    const Path path = arc_by_three_points(kOrigin, {45, height, 0, 0}, {100, 0, 7, 0});
    expect_near(path.at(path.length_u * (1 - 1e-15)), path.end, 1e-12);
    EXPECT_NEAR(path.at(path.length_u * 0.45).y(), height, 1e-6 * height + 1e-14) << height;
  }
}

TEST(PathArc, InSpacePassesThroughItsPointsInAnObliquePlane) {
  const Point out = Point(1, 2, 2, 0) / 3;
  const Point up = Point(2, 1, -2, 0) / 3;
  const Point centre(7, 8, 9, 10);
  const auto on_circle = [&](double angle) -> Point {
    return centre + 30 * (std::cos(angle) * out + std::sin(angle) * up);
  };
  for (const double sweep : {0.5, 3.0, -2.0, 6.0}) {
    const Path path = arc_in_space(on_circle(0), on_circle(sweep / 3), on_circle(sweep));
    EXPECT_NEAR(path.length_u, 30 * std::abs(sweep), 1e-12);
    expect_near(path.centre, centre, 1e-12);
    for (double share = 0; share <= 1; share += 0.125) {
      expect_near(path.at(path.length_u * share), on_circle(sweep * share), 1e-12);
    }
  }
}

TEST(PathArc, BySweepOfNothingIsTheLineOfItsRise) {
  const Path path = arc_by_sweep({1, 2, 3, 4}, kOrigin, 0, {0, 0, 5, -12});
  EXPECT_EQ(path, line({1, 2, 3, 4}, {1, 2, 8, -8}));
  EXPECT_EQ(spiral({1, 2, 3, 4}, kOrigin, 0, 3).length_u, 0);
}

TEST(PathArc, OnALargeCircleAShortWayKeepsItsDigits) {
  // 1 u on a radius of 1e11 bends by 5e-12 u: calculated from the centre it would be lost in 1e-5.
  const Path path = arc_by_sweep({5, 5, 0, 0}, {5, 5 + 1e11, 0, 0}, 1e-11);
  EXPECT_NEAR(path.length_u, 1, 1e-15);
  for (const double along : {0.25, 0.5, 0.75, 1.0}) {
    expect_near(path.at(along), {5 + along, 5 + along * along / 2e11, 0, 0}, 2e-15);
  }
}

TEST(PathArc, OfNearlyEqualRadiiIsAsExactAsACircle) {
  const Path circle = arc_by_centre({100, 0, 0, 0}, kOrigin, {0, 100, 0, 0}, kLeft);
  for (const double off : {1e-14, 1e-12, -1e-12, 1e-9, -1e-7}) {
    const Path path = arc_by_centre({100, 0, 0, 0}, kOrigin, {0, 100 + off, 0, 0}, kLeft);
    EXPECT_NEAR(path.length_u, circle.length_u + off * kPi / 4, 5e-14) << off;
    for (double share = 0; share <= 1; share += 1.0 / 64) {
      const double radius = 100 + off * share;
      const double angle = share * kPi / 2;
      // The arc before this point, radius times angle at the mean radius.
      const double along = (100 + off * share / 2) * angle;
      expect_near(path.at(along), {radius * std::cos(angle), radius * std::sin(angle), 0, 0}, 1e-13);
    }
  }
}

// ---- the longest axis as measure -------------------------------------------------------------------------

TEST(PathArcByLongestAxis, AQuarterCircleIsTwiceItsHalfChord) {
  const double root = std::sqrt(2.0);
  struct Case {
    double begin_deg, sweep_deg, length;  // of a radius of 1000
  };
  for (const Case& row : std::vector<Case>{{0, 90, root},
                                           {-45, 90, root},
                                           {-45, 45, root / 2},
                                           {0, 30, 0.5},
                                           {0, -30, 0.5},
                                           {90, 30, 0.5},
                                           {180, -30, 0.5},
                                           {45, 45, root / 2},
                                           {45, -45, root / 2},
                                           {135, 360, 4 * root},
                                           {10, -720, 8 * root},
                                           {60, 360'000, 4000 * root}}) {
    const double angle = row.begin_deg * kDegree;
    const Point begin(1000 * std::cos(angle), 1000 * std::sin(angle), 0, 0);
    const Path path = arc_by_sweep(begin, kOrigin, row.sweep_deg * kDegree, kOrigin, by_longest_axis());
    EXPECT_NEAR(path.length_u, 1000 * row.length, 1e-12 * (1 + row.length * 1000))
        << row.begin_deg << " by " << row.sweep_deg;
  }
}

TEST(PathArcByLongestAxis, ThatAxisIsAtAWholePulseAtEachWholePulse) {
  const Path path = arc_by_sweep({5000, 0, 0, 0}, kOrigin, kPi / 2, kOrigin, by_longest_axis());
  for (int n = 0; n <= 3535; ++n) ASSERT_NEAR(path.at(n).y(), n, 1e-12);
  const Path other = arc_by_sweep({0, 5000, 0, 0}, kOrigin, -kPi / 2, kOrigin, by_longest_axis());
  for (int n = 0; n <= 3535; ++n) ASSERT_NEAR(other.at(n).x(), n, 1e-12);
}

TEST(PathArcByLongestAxis, ExactlyOnTheBoundariesOfOctantsItIsWhole) {
  const double edge = 1000 * std::sqrt(0.5);
  for (const Point& begin : {Point(edge, edge, 0, 0), Point(-edge, edge, 0, 0), Point(-edge, -edge, 0, 0),
                             Point(edge, -edge, 0, 0), Point(1000, 0, 0, 0), Point(0, -1000, 0, 0)}) {
    for (const Turn turn : {kLeft, kRight}) {
      const Path path = arc_by_centre(begin, kOrigin, begin, turn, by_longest_axis());
      EXPECT_NEAR(path.length_u, 4000 * std::sqrt(2.0), 1e-9);
      expect_near(path.at(path.length_u / 2), -begin, 1e-10);
      for (int octant = 1; octant < 8; ++octant) {
        EXPECT_NEAR(path.at(path.length_u * octant / 8).norm(), 1000, 1e-10);
      }
    }
  }
}

TEST(PathArcByLongestAxis, AHelixCountsItsPlaneAndRisesWithTheAngle) {
  const Path path = arc_by_sweep({1000, 0, 0, 0}, kOrigin, 4 * kPi, {0, 0, 4'000'000, 0}, by_longest_axis());
  EXPECT_NEAR(path.length_u, 8000 * std::sqrt(2.0), 1e-8);
  expect_near(path.at(500), {1000 * std::cos(30 * kDegree), 500, 4e6 / 24, 0}, 1e-8);
  expect_near(path.at(path.length_u / 2), {1000, 0, 2e6, 0}, 1e-8);
  expect_near(path.at(path.length_u / 8), {0, 1000, 5e5, 0}, 1e-8);
}

TEST(PathArcByLongestAxis, WhatTheToleranceForgivesRidesAlong) {
  const Path path = arc_by_centre({100, 0, 0, 0}, kOrigin, {0, 100 + 5e-7, 0, 0}, kLeft, by_longest_axis());
  EXPECT_NEAR(path.length_u, 100 * std::sqrt(2.0), 1e-12);
  expect_near(path.at(path.length_u * (1 - 1e-15)), path.end, 1e-12);
  EXPECT_NEAR(path.at(path.length_u / 2).norm(), 100 + 2.5e-7, 1e-12);
}

}  // namespace path_arc_test
}  // namespace understudy::motion
