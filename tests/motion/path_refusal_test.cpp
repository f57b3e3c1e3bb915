// Arguments that cannot make a path: the reason by name, and one line that describes it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "motion/bad_motion.h"
#include "motion/elementary.h"
#include "motion/path.h"

namespace understudy::motion {
namespace path_refusal_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Turn kLeft = Turn::counter_clockwise;
const Point kOrigin = Point::Zero();
const Point kTen(10, 0, 0, 0);
const Point kUp(0, 10, 0, 0);

struct Case {
  std::function<Path()> make;
  Refusal refusal;
  std::string message;
};

void expect_refused(const std::vector<Case>& table) {
  for (const Case& row : table) {
    try {
      const Path path = row.make();
      ADD_FAILURE() << "taken, with length " << path.length_u << ": " << row.message;
    } catch (const BadMotion& bad) {
      EXPECT_EQ(bad.refusal(), row.refusal) << row.message;
      EXPECT_EQ(bad.what(), row.message);
    }
  }
}

Path by_sweep(double sweep_rad, const Point& rise = kOrigin, const ArcOptions& options = {}) {
  return arc_by_sweep(kTen, kOrigin, sweep_rad, rise, options);
}
ArcOptions in(std::int8_t first, std::int8_t second) { return {.plane = {first, second}}; }
ArcOptions off(OffCircle off_circle, double tolerance) {
  return {.plane = {}, .off_circle = off_circle, .radius_tolerance_u = tolerance};
}
ArcOptions longest(OffCircle off_circle) {
  return {.plane = {}, .measure = Measure::longest_axis, .off_circle = off_circle};
}

TEST(PathRefusal, OfCoordinatesThatAreNoneOrTooFar) {
  expect_refused({
      {[] {
         return line({0, kNan, 0, 0}, kTen);
       },
       Refusal::not_finite, "line: begin must be a finite number; it is nan"},
      {[] {
         return line(kOrigin, {0, 0, 0, -kInfinity});
       },
       Refusal::not_finite, "line: end must be a finite number; it is -inf"},
      {[] {
         return line({2e12, 0, 0, 0}, kOrigin);
       },
       Refusal::out_of_range, "line: begin must be within +-1e12; it is 2e+12"},
      {[] {
         return line(kOrigin, {0, 0, -1e300, 0});
       },
       Refusal::out_of_range, "line: end must be within +-1e12; it is -1e+300"},
      {[] {
         return arc_by_centre({0, 0, kNan, 0}, kTen, kUp, kLeft);
       },
       Refusal::not_finite, "arc_by_centre: begin must be a finite number; it is nan"},
      {[] {
         return arc_by_centre(kTen, {0, kNan, 0, 0}, kUp, kLeft);
       },
       Refusal::not_finite, "arc_by_centre: centre must be a finite number; it is nan"},
      {[] {
         return arc_by_centre(kTen, {0, 3e12, 0, 0}, kUp, kLeft);
       },
       Refusal::out_of_range, "arc_by_centre: centre must be within +-1e12; it is 3e+12"},
      {[] {
         return arc_by_centre(kTen, kOrigin, {0, 10, 0, kInfinity}, kLeft);
       },
       Refusal::not_finite, "arc_by_centre: end must be a finite number; it is inf"},
      {[] { return arc_by_radius(kTen, kUp, kNan, kLeft); }, Refusal::not_finite,
       "arc_by_radius: radius must be a finite number; it is nan"},
      {[] { return arc_by_radius(kTen, kUp, -1e13, kLeft); }, Refusal::out_of_range,
       "arc_by_radius: radius must be within +-1e12; it is -1e+13"},
      {[] {
         return arc_by_three_points(kTen, {kNan, 0, 0, 0}, kUp);
       },
       Refusal::not_finite, "arc_by_three_points: middle must be a finite number; it is nan"},
      {[] {
         return arc_in_space(kTen, kOrigin, {0, 0, 0, kNan});
       },
       Refusal::not_finite, "arc_in_space: end must be a finite number; it is nan"},
      {[] {
         return by_sweep(1, {0, 0, kNan, 0});
       },
       Refusal::not_finite, "arc_by_sweep: rise must be a finite number; it is nan"},
      {[] {
         return arc_by_sweep({0, 0, 1e12, 0}, kTen, 1, {0, 0, 1, 0});
       },
       Refusal::out_of_range, "arc_by_sweep: end must be within +-1e12; it is 1000000000001"},
      {[] { return spiral(kTen, kOrigin, 1, kNan); }, Refusal::not_finite,
       "spiral: growth must be a finite number; it is nan"},
      {[] { return spiral(kTen, kOrigin, 1, 1e300); }, Refusal::out_of_range,
       "spiral: growth must be within +-1e12; it is 1e+300"},
  });
}

TEST(PathRefusal, OfSweepsAndTurnsBeyondTheFarthestAngle) {
  expect_refused({
      {[] { return by_sweep(kNan); }, Refusal::not_finite,
       "arc_by_sweep: sweep must be a finite number; it is nan"},
      {[] { return by_sweep(-kInfinity); }, Refusal::not_finite,
       "arc_by_sweep: sweep must be a finite number; it is -inf"},
      {[] { return by_sweep(-1000001); }, Refusal::out_of_range,
       "arc_by_sweep: sweep must be within +-1e6 rad; it is -1000001"},
      {[] { return arc_by_centre(kTen, kOrigin, kUp, kLeft, {}, -1); }, Refusal::negative,
       "arc_by_centre: more turns must be 0 or above; it is -1"},
      {[] { return arc_by_centre(kTen, kOrigin, kUp, kLeft, {}, INT64_MAX); }, Refusal::out_of_range,
       "arc_by_centre: more turns must be within 1e6 rad; it is 9223372036854775807"},
  });
  EXPECT_THROW(arc_by_centre(kTen, kOrigin, kUp, kLeft, {}, 160'000), BadMotion);
  EXPECT_NO_THROW(arc_by_centre(kTen, kOrigin, kUp, kLeft, {}, 159'000));
  EXPECT_NO_THROW(by_sweep(1e6));
}

TEST(PathRefusal, OfPlanesThatAreNone) {
  expect_refused({
      {[] { return by_sweep(1, kOrigin, in(0, 4)); }, Refusal::out_of_range,
       "arc_by_sweep: axis of the plane must be 0..3; it is 4"},
      {[] { return by_sweep(1, kOrigin, in(-1, 2)); }, Refusal::out_of_range,
       "arc_by_sweep: axis of the plane must be 0..3; it is -1"},
      {[] { return by_sweep(1, kOrigin, in(2, 2)); }, Refusal::out_of_range,
       "arc_by_sweep: axes of the plane must be different; both are 2"},
      {[] {
         return by_sweep(1, {0, 3, 5, 0});
       },
       Refusal::out_of_range, "arc_by_sweep: rise must be 0 in the plane; it is 3"},
      {[] { return arc_by_radius(kTen, kUp, 10, kLeft, off(OffCircle::refuse, -1)); }, Refusal::negative,
       "arc_by_radius: radius tolerance must be 0 or above; it is -1"},
  });
}

TEST(PathRefusal, OfCentresAndRadiiThatFitNoArc) {
  expect_refused({
      {[] { return arc_by_centre(kTen, kTen, kUp, kLeft); }, Refusal::no_such_arc,
       "arc_by_centre: centre must differ from begin and end; it is on begin"},
      {[] { return arc_by_centre(kTen, kUp, kUp, kLeft, off(OffCircle::blend, 0)); }, Refusal::no_such_arc,
       "arc_by_centre: centre must differ from begin and end; it is on end"},
      {[] { return arc_by_sweep(kTen, kTen, 1); }, Refusal::no_such_arc,
       "arc_by_sweep: centre must differ from begin; it is on it"},
      {[] {
         return arc_by_centre(kTen, kOrigin, {0, 10.5, 0, 0}, kLeft);
       },
       Refusal::no_such_arc, "arc_by_centre: end must be on the circle of radius 10; it is at 10.5"},
      {[] {
         return arc_by_centre(kTen, kOrigin, {-20, 15, 0, 0}, kLeft, off(OffCircle::quadrant, 0));
       },
       Refusal::no_such_arc,
       "arc_by_centre: shorter coordinate of the end must be within the radius 10; it is 15"},
      {[] { return arc_by_radius(kTen, kUp, 0, kLeft); }, Refusal::no_such_arc,
       "arc_by_radius: radius must not be 0; it is 0"},
      {[] {
         return arc_by_radius(kTen, {10, 0, 5, 0}, 20, kLeft);
       },
       Refusal::no_such_arc, "arc_by_radius: end must differ from begin in the plane; it is on it"},
      {[] {
         return arc_by_radius(kTen, {-20, 0, 0, 0}, 5, kLeft);
       },
       Refusal::no_such_arc, "arc_by_radius: chord must be at most 10, twice the radius; it is 30"},
      {[] { return spiral(kTen, kOrigin, 4 * kPi, -10); }, Refusal::no_such_arc,
       "spiral: radius must be 0 or above; it is -10 at the end"},
      {[] { return spiral(kTen, kTen, 7, -10); }, Refusal::no_such_arc,
       "spiral: centre must differ from begin; it is on it"},
  });
  EXPECT_NO_THROW(arc_by_centre(kTen, kOrigin, {0, 10 + 9e-7, 0, 0}, kLeft));
  EXPECT_THROW(arc_by_centre(kTen, kOrigin, {0, 10 + 1.1e-6, 0, 0}, kLeft), BadMotion);
  EXPECT_NO_THROW(arc_by_radius(kTen, {-20, 0, 0, 0}, 15 - 4.9e-7, kLeft));
  EXPECT_THROW(arc_by_radius(kTen, {-20, 0, 0, 0}, 15 - 5.1e-7, kLeft), BadMotion);
}

TEST(PathRefusal, OfPointsOnOneLineOrTheSame) {
  const Point far(30, 0, 0, 0);
  const std::string same = "three points must be different; two are the same";
  expect_refused({
      {[=] { return arc_by_three_points(kTen, kTen, kUp); }, Refusal::no_such_arc,
       "arc_by_three_points: " + same},
      {[=] { return arc_by_three_points(kTen, kUp, kUp); }, Refusal::no_such_arc,
       "arc_by_three_points: " + same},
      {[=] { return arc_by_three_points(kTen, kUp, kTen); }, Refusal::no_such_arc,
       "arc_by_three_points: " + same},
      {[=] {
         return arc_by_three_points(kTen, {10, 0, 7, 0}, kUp);
       },
       Refusal::no_such_arc, "arc_by_three_points: " + same},
      {[=] { return arc_by_three_points(kOrigin, kTen, far); }, Refusal::no_such_arc,
       "arc_by_three_points: three points must not be on one line; they are within 0 of one"},
      {[=] {
         return arc_by_three_points(kOrigin, {10, 1e-12, 0, 0}, far);
       },
       Refusal::no_such_arc,
       "arc_by_three_points: three points must not be on one line; they are within 1e-12 of one"},
      {[=] { return arc_in_space(kTen, kTen, kUp); }, Refusal::no_such_arc, "arc_in_space: " + same},
      {[=] { return arc_in_space(kTen, kUp, kUp); }, Refusal::no_such_arc, "arc_in_space: " + same},
      {[=] { return arc_in_space(kTen, kUp, kTen); }, Refusal::no_such_arc, "arc_in_space: " + same},
      {[=] {
         return arc_in_space(kOrigin, {1, 1, 1, 1}, {-2, -2, -2, -2});
       },
       Refusal::no_such_arc, "arc_in_space: three points must not be on one line; they are within 0 of one"},
      {[=] {
         return arc_by_three_points(kOrigin, {5e5, 1e-3, 0, 0}, {1e6, 0, 0, 0});
       },
       Refusal::out_of_range, "arc_by_three_points: centre must be within +-1e12; it is -1.25e+14"},
  });
}

TEST(PathRefusal, OfSpiralsByTheLongestAxis) {
  expect_refused({
      {[] { return spiral(kTen, kOrigin, 1, 3, kOrigin, longest(OffCircle::refuse)); }, Refusal::out_of_range,
       "spiral: growth of the radius must be 0 if the longest axis is the measure; it is 0.477464829275686"},
      {[] { return spiral(kOrigin, kOrigin, 1, 1e-9, kOrigin, longest(OffCircle::refuse)); },
       Refusal::out_of_range,
       "spiral: growth of the radius must be 0 if the longest axis is the measure; it is "
       "1.5915494309189535e-10"},
      {[] {
         return arc_by_centre(kTen, kOrigin, {0, 12, 0, 0}, kLeft, longest(OffCircle::blend));
       },
       Refusal::out_of_range,
       "arc_by_centre: growth of the radius must be 0 if the longest axis is the measure; it is 2"},
  });
}

TEST(PathRefusal, NeverComesForCoordinatesOfACentreThatDoNotCount) {
  EXPECT_EQ(arc_by_sweep(kTen, {0, 0, kNan, 1e300}, 1), arc_by_sweep(kTen, kOrigin, 1));
}

}  // namespace path_refusal_test
}  // namespace understudy::motion
