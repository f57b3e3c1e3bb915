// Paths compared with independent methods: drawing lines and circles pulse by pulse, and numeric
// differentiation and integration of at(). A failure prints the path as code.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <set>
#include <vector>

#include "tests/motion/path_random.h"

namespace understudy::motion {
namespace path_oracle_test {

constexpr int kArcsOfAMaker = 14'000;
constexpr int kLines = 16'000;

// ---- pulse by pulse --------------------------------------------------------------------------------------

using Pulses = std::array<std::int64_t, kPathAxes>;

/// Bresenham's line from zero, one step of the long axis at a time.
class PulseLine {
 public:
  explicit PulseLine(const Pulses& target) : target_(target) {
    for (const std::int64_t way : target) long_ = std::max(long_, std::abs(way));
  }

  std::int64_t steps() const { return long_; }
  const Pulses& place() const { return place_; }
  /// Exactly half a pulse: either of two pulses is equally near.
  bool tie(int axis) const { return long_ > 0 && error_[axis] == long_; }

  void step() {
    for (int axis = 0; axis < kPathAxes; ++axis) {
      if (tie(axis)) error_[axis] -= 2 * long_, place_[axis] += target_[axis] < 0 ? -1 : 1;
      error_[axis] += 2 * std::abs(target_[axis]);
      if (error_[axis] > long_) {
        error_[axis] -= 2 * long_;
        place_[axis] += target_[axis] < 0 ? -1 : 1;
      }
    }
  }

 private:
  Pulses target_;
  Pulses place_{};
  Pulses error_{};  // twice the distance behind the line, in parts of a pulse of the long axis
  std::int64_t long_ = 0;
};

testing::AssertionResult draws_like_bresenham(const Pulses& from, const Pulses& way) {
  Point begin;
  Point end;
  for (int axis = 0; axis < kPathAxes; ++axis) {
    begin[axis] = static_cast<double>(from[axis]);
    end[axis] = static_cast<double>(from[axis] + way[axis]);
  }
  const Path path = line(begin, end, Measure::longest_axis);
  PulseLine pulses(way);
  for (std::int64_t n = 0; n <= pulses.steps(); ++n) {
    const Point place = path.at(static_cast<double>(n)) - begin;
    for (int axis = 0; axis < kPathAxes; ++axis) {
      const bool half = pulses.tie(axis);
      const double is = place[axis];
      const auto should = static_cast<double>(pulses.place()[axis]);
      if (half ? std::abs(std::abs(is - should) - 0.5) > 1e-9 : std::round(is) != should) {
        return testing::AssertionFailure()
               << "line(" << code_of(begin) << ", " << code_of(end) << ", Measure::longest_axis).at(" << n
               << ")[" << axis << "] is " << is << " beyond begin, Bresenham's " << should;
      }
    }
    pulses.step();
  }
  return testing::AssertionSuccess();
}

TEST(PathOracle, ShortLinesOfTwoAxesInAllOctantsAreBresenhams) {
  for (std::int64_t x = -15; x <= 15; ++x) {
    for (std::int64_t y = -15; y <= 15; ++y) ASSERT_TRUE(draws_like_bresenham({7, -3, 0, 0}, {x, y, 0, 0}));
  }
}

TEST(PathOracle, LinesOfUpToFourAxesAreBresenhamsWhateverTheirSigns) {
  RandomPaths random(path_seed());
  for (int axes = 2; axes <= kPathAxes; ++axes) {
    for (int i = 0; i < 40; ++i) {
      Pulses from{};
      Pulses way{};
      for (int axis = 0; axis < axes; ++axis) {
        from[axis] = random.between(-1'000'000, 1'000'000);
        way[axis] = random.between(0, 400);
      }
      for (int signs = 0; signs < 1 << axes; ++signs) {
        Pulses signed_way = way;
        for (int axis = 0; axis < axes; ++axis) {
          if ((signs >> axis & 1) != 0) signed_way[axis] = -way[axis];
        }
        ASSERT_TRUE(draws_like_bresenham(from, signed_way)) << "seed " << path_seed();
      }
    }
  }
}

TEST(PathOracle, ALongLineIsBresenhamsToTheLastPulse) {
  EXPECT_TRUE(draws_like_bresenham({0, 0, 0, 0}, {300'007, -299'999, 1, 123'457}));
}

/// The midpoint circle about zero: an octant by whole numbers alone, the others by symmetry.
std::set<std::pair<std::int64_t, std::int64_t>> midpoint_circle(std::int64_t radius) {
  std::set<std::pair<std::int64_t, std::int64_t>> pulses;
  std::int64_t short_axis = radius;
  for (std::int64_t long_axis = 0; long_axis <= short_axis; ++long_axis) {
    // Returns whether the circle, at this position of the long axis, is nearer to the next pulse inside. (2
    // x)^2 keeps it whole.
    const std::int64_t middle = 2 * short_axis - 1;
    if (4 * long_axis * long_axis + middle * middle > 4 * radius * radius) --short_axis;
    for (const std::int64_t a : {long_axis, -long_axis}) {
      for (const std::int64_t b : {short_axis, -short_axis}) {
        pulses.insert({a, b});
        pulses.insert({b, a});
      }
    }
  }
  return pulses;
}

/// Samples a circle at the points where the axis that moves most is at a whole pulse, in all octants.
void expect_midpoint_circle(std::int64_t radius, std::int64_t centre_x, std::int64_t centre_y, Turn turn) {
  const auto r = static_cast<double>(radius);
  const Point centre(static_cast<double>(centre_x), static_cast<double>(centre_y), 0, 0);
  const Point begin = centre + Point(r, 0, 0, 0);
  const Path path = arc_by_centre(begin, centre, begin, turn, {.measure = Measure::longest_axis});
  const auto pulses = midpoint_circle(radius);
  const double sector = r * std::sqrt(2.0);
  ASSERT_NEAR(path.length_u, 4 * sector, 1e-14 * r);
  const auto half = static_cast<std::int64_t>(sector / 2);
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (std::int64_t n = -half; n <= half; ++n) {
      const double along = quarter * sector + static_cast<double>(n);
      const Point place = path.at(along < 0 ? along + path.length_u : along) - centre;
      const std::int64_t x = std::llround(place.x());
      const std::int64_t y = std::llround(place.y());
      // Next to an octant's boundary the other axis may be the short one of the drawing.
      const double x_off =
          std::abs(std::sqrt(std::max(0.0, r * r - static_cast<double>(y * y))) - std::abs(place.x()));
      const double y_off =
          std::abs(std::sqrt(std::max(0.0, r * r - static_cast<double>(x * x))) - std::abs(place.y()));
      ASSERT_LT(std::min(x_off, y_off), 1e-9 * (1 + r)) << radius << " at " << along;
      ASSERT_TRUE(pulses.contains({x, y})) << radius << " at " << along << ": " << x << ", " << y;
    }
  }
}

TEST(PathOracle, CirclesPassThroughEveryPulseOfTheMidpointCircle) {
  for (std::int64_t radius = 1; radius <= 150; ++radius) {
    expect_midpoint_circle(radius, 0, 0, Turn::counter_clockwise);
    expect_midpoint_circle(radius, -17, 1000, Turn::clockwise);
  }
  for (const std::int64_t radius : {1000, 7071, 20'000}) {
    expect_midpoint_circle(radius, 123'456, -7, Turn::counter_clockwise);
  }
}

// ---- numeric differentiation -----------------------------------------------------------------------------

/// The effect of rounding on a point of the path.
double rounding_u(const Path& path) {
  const double largest = std::max({path.begin.cwiseAbs().maxCoeff(), path.end.cwiseAbs().maxCoeff(),
                                   path.kind == Path::Kind::arc ? path.centre.cwiseAbs().maxCoeff() : 0.0});
  const bool rise_by_angle = path.kind == Path::Kind::arc && path.measure == Measure::longest_axis;
  const double rise_u_rad = rise_by_angle ? path.rise.norm() / std::abs(path.sweep_rad) : 0;
  return 2e-15 * (largest + path.begin_radius_u + path.length_u + rise_u_rad);
}

/// Returns how much of `way` counts by the path's measure.
double measured(const Path& path, const Point& way) {
  if (path.measure == Measure::vector) return way.norm();
  if (path.kind == Path::Kind::line) return way.cwiseAbs().maxCoeff();
  return std::max(std::abs(way.dot(path.abscissa)), std::abs(way.dot(path.ordinate)));
}

/// A length in which a path turns by half a thousandth of a radian at most: a chord is shorter by 1e-7 of
/// itself, and if the longest axis changes by 1e-3.
double short_way_u(const Path& path) {
  if (path.kind == Path::Kind::line) return path.length_u / 2;
  const double end_radius = path.begin_radius_u + path.radius_slope_u_rad * std::abs(path.sweep_rad);
  const double min_radius = std::min(path.begin_radius_u, std::max(0.0, end_radius));
  return std::min(path.length_u / 2, 2.5e-4 * std::max(min_radius, std::abs(path.radius_slope_u_rad)));
}

testing::AssertionResult runs_at_speed_one(const Path& path, double along) {
  if (path.length_u == 0) return testing::AssertionSuccess();
  const double step = short_way_u(path);
  const double from = std::min(along, path.length_u - step);
  const double rate = measured(path, path.at(from + step) - path.at(from)) / step;
  const double slack = (path.measure == Measure::vector ? 1e-6 : 1e-3) + 4 * rounding_u(path) / step;
  if (std::abs(rate - 1) > slack) {
    return testing::AssertionFailure() << "at " << code_of(from) << " of " << code_of(path.length_u)
                                       << " the rate is " << code_of(rate) << ", slack " << slack;
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult is_continuous_to_both_ends(const Path& path) {
  if (path.at(0) != path.begin) return testing::AssertionFailure() << "does not begin at begin";
  if (path.at(path.length_u) != path.end) return testing::AssertionFailure() << "does not end at end";
  if (path.at(-1) != path.begin) return testing::AssertionFailure() << "not clamped to begin";
  if (path.at(path.length_u * 2 + 1) != path.end) return testing::AssertionFailure() << "not clamped to end";
  // By the longest axis a rise can be many times as long, and so as fast.
  const double speed = path.length_u == 0 ? 0 : 3 + path.rise.norm() / path.length_u * 2;
  const double nearly = path.length_u * (1 - 1e-15);
  const double gap = (path.at(nearly) - path.end).norm();
  if (gap > speed * (path.length_u - nearly) + 2 * rounding_u(path)) {
    return testing::AssertionFailure() << "jumps by " << gap << " to its end";
  }
  const double first_gap = (path.at(path.length_u * 1e-15) - path.begin).norm();
  if (first_gap > speed * path.length_u * 1e-15 + 2 * rounding_u(path)) {
    return testing::AssertionFailure() << "jumps by " << first_gap << " from its beginning";
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult points_where_it_goes(const Path& path, double along) {
  const Point direction = path.direction_at(along);
  if (std::abs(direction.norm() - 1) > 1e-14)
    return testing::AssertionFailure() << "direction is not of length 1";
  const double step = short_way_u(path);
  const double from = std::clamp(along - step / 2, 0.0, path.length_u - step);
  const Point way = path.at(from + step) - path.at(from);
  if (way.norm() < 1e4 * rounding_u(path)) return testing::AssertionSuccess();
  const double error = (way / way.norm() - direction).norm();
  if (error > 2e-3)
    return testing::AssertionFailure() << "at " << code_of(along) << " direction is off by " << error;
  return testing::AssertionSuccess();
}

/// The angle about the centre only grows (in the arc's direction), and the radius changes evenly with it.
testing::AssertionResult turns_evenly(const Path& path) {
  constexpr int kPlaces = 16;
  const double noise = rounding_u(path);
  const double sweep = std::abs(path.sweep_rad);
  double last = -1e-9;
  for (int i = 0; i <= kPlaces; ++i) {
    const double along = path.length_u * i / kPlaces;
    const Point out = path.at(along) - path.centre;
    const double x = out.dot(path.abscissa);
    const double y = out.dot(path.ordinate);
    const double radius = std::sqrt(x * x + y * y);
    // One point does not determine the whole turns: take those nearest to a plain arc's.
    double angle = std::copysign(1.0, path.sweep_rad) * (std::atan2(y, x) - path.begin_angle_rad);
    const double slack = 1e-9 + 4 * noise / radius;
    double share = 0;
    if (path.radius_slope_u_rad == 0 && path.measure == Measure::vector) {
      share = static_cast<double>(i) / kPlaces;
      const double off = std::remainder(angle - share * sweep, 2 * kPi);
      if (std::abs(off) > slack) return testing::AssertionFailure() << "angle off by " << off << " at " << i;
    } else {
      if (sweep > 5) return testing::AssertionSuccess();  // ambiguous
      angle = std::remainder(angle - 2.5, 2 * kPi) + 2.5;
      if (angle < last - slack) return testing::AssertionFailure() << "turns back at " << code_of(along);
      last = angle;
      share = std::clamp(angle / sweep, 0.0, 1.0);
    }
    const double should = path.begin_radius_u + path.radius_slope_u_rad * sweep * share;
    const double growth = std::abs(path.radius_slope_u_rad);
    if (std::abs(radius - should) > 4 * noise + growth * slack) {
      return testing::AssertionFailure()
             << "radius is " << code_of(radius) << ", not " << code_of(should) << " at " << code_of(along);
    }
    const Point off_plane = out - x * path.abscissa - y * path.ordinate;
    if ((off_plane - share * path.rise).norm() > 4 * noise + path.rise.norm() / sweep * slack) {
      return testing::AssertionFailure() << "rises unevenly at " << code_of(along);
    }
  }
  return testing::AssertionSuccess();
}

/// Simpson's rule in long double over the speed per radian, from the arguments of the call.
double length_by_quadrature(const ArcCase& arc, const Path& path) {
  const long double sweep = std::abs(path.sweep_rad);
  const long double from = path.begin_radius_u;
  const long double growth = path.radius_slope_u_rad;
  const long double rise = arc.rise.norm() / sweep;
  constexpr int kIntervals = 200;
  long double sum = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const long double radius = from + growth * sweep * i / kIntervals;
    const int weight = i == 0 || i == kIntervals ? 1 : (i % 2 == 1 ? 4 : 2);
    sum += weight * std::sqrt(radius * radius + growth * growth + rise * rise);
  }
  return static_cast<double>(sum * sweep / (3 * kIntervals));
}

testing::AssertionResult has_its_length(const ArcCase& arc, const Path& path) {
  const double should = length_by_quadrature(arc, path);
  if (path.measure == Measure::vector && std::abs(path.length_u - should) > 1e-6 * should) {
    return testing::AssertionFailure()
           << "length is " << code_of(path.length_u) << ", not " << code_of(should);
  }
  // A longest axis moves between 2/pi * sqrt(2) of the distance on average, and never less than 0.7 or more
  // than 1.
  const double plane = std::abs(path.sweep_rad) * path.begin_radius_u;
  if (path.measure == Measure::longest_axis &&
      (path.length_u > plane * (1 + 1e-14) || path.length_u < plane * 0.707)) {
    return testing::AssertionFailure() << "length is " << code_of(path.length_u) << " of " << code_of(plane);
  }
  return testing::AssertionSuccess();
}

void expect_true_arcs(ArcCase::Maker maker) {
  const std::uint64_t seed = path_seed() + static_cast<std::uint64_t>(maker);
  std::cout << "seed " << seed << "\n";
  RandomPaths random(seed);
  for (int i = 0; i < kArcsOfAMaker; ++i) {
    const ArcCase arc = random.next(maker);
    const Path path = arc.path();
    const auto shown = [&] { return "seed " + std::to_string(seed) + ": " + arc.code(); };
    ASSERT_TRUE(std::isfinite(path.length_u) && path.length_u > 0) << shown();
    ASSERT_TRUE(is_continuous_to_both_ends(path)) << shown();
    for (const double along :
         {0.0, path.length_u, random.within(0, path.length_u), random.within(0, path.length_u)}) {
      ASSERT_TRUE(runs_at_speed_one(path, along)) << shown();
      ASSERT_TRUE(points_where_it_goes(path, along)) << shown();
    }
    ASSERT_TRUE(turns_evenly(path)) << shown();
    if (maker != ArcCase::Maker::in_space) {
      ASSERT_TRUE(has_its_length(arc, path)) << shown();
    }
    if (maker == ArcCase::Maker::by_three_points) {
      ASSERT_EQ(path.sweep_rad < 0, arc.sweep_rad < 0) << shown();
    }
    if (maker == ArcCase::Maker::by_sweep || maker == ArcCase::Maker::spiral) {
      ASSERT_EQ(path.sweep_rad, arc.sweep_rad) << shown();
    } else {
      ASSERT_NEAR(std::abs(path.sweep_rad), std::abs(arc.sweep_rad), 1e-6 * (1 + std::abs(arc.sweep_rad)))
          << shown();
    }
  }
}

TEST(PathOracle, RandomArcsBySweepAreTrue) { expect_true_arcs(ArcCase::Maker::by_sweep); }
TEST(PathOracle, RandomArcsByCentreAreTrue) { expect_true_arcs(ArcCase::Maker::by_centre); }
TEST(PathOracle, RandomArcsByRadiusAreTrue) { expect_true_arcs(ArcCase::Maker::by_radius); }
TEST(PathOracle, RandomArcsByThreePointsAreTrue) { expect_true_arcs(ArcCase::Maker::by_three_points); }
TEST(PathOracle, RandomArcsInSpaceAreTrue) { expect_true_arcs(ArcCase::Maker::in_space); }
TEST(PathOracle, RandomSpiralsAreTrue) { expect_true_arcs(ArcCase::Maker::spiral); }

TEST(PathOracle, RandomLinesAreTrue) {
  RandomPaths random(path_seed() + 100);
  for (int i = 0; i < kLines; ++i) {
    Point begin;
    Point end;
    for (int axis = 0; axis < kPathAxes; ++axis) {
      begin[axis] = random.between(0, 2) == 0 ? 0 : random.within(-1, 1) * random.of_any_size(1e-3, 1e12);
      end[axis] =
          random.between(0, 2) == 0 ? begin[axis] : random.within(-1, 1) * random.of_any_size(1e-3, 1e12);
    }
    const Measure measure = random.between(0, 1) == 0 ? Measure::vector : Measure::longest_axis;
    const Path path = line(begin, end, measure);
    const auto shown = [&] {
      return "seed " + std::to_string(path_seed() + 100) + ": line(" + code_of(begin) + ", " + code_of(end) +
             (measure == Measure::vector ? ")" : ", Measure::longest_axis)");
    };
    ASSERT_EQ(path.length_u == 0, begin == end) << shown();
    if (begin == end) continue;
    ASSERT_TRUE(is_continuous_to_both_ends(path)) << shown();
    Point before = begin;
    for (int n = 1; n <= 8; ++n) {
      const double along = path.length_u * n / 8;
      ASSERT_TRUE(runs_at_speed_one(path, along)) << shown();
      ASSERT_TRUE(points_where_it_goes(path, along)) << shown();
      const Point here = path.at(along);
      for (int axis = 0; axis < kPathAxes; ++axis) {
        ASSERT_GE((here[axis] - before[axis]) * (end[axis] - begin[axis]), 0) << shown();
        ASSERT_LE(std::abs(here[axis] - begin[axis]), std::abs(end[axis] - begin[axis])) << shown();
      }
      before = here;
    }
  }
}

}  // namespace path_oracle_test
}  // namespace understudy::motion
