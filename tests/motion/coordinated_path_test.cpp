// Axes carried along a path are never more than half a pulse off it, and end on its end.
#include <gtest/gtest.h>

#include "motion/bad_motion.h"
#include "tests/motion/coordinated_bench.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace coordinated_path_test {

constexpr double kPi = std::numbers::pi;
constexpr double kHalf = 0.5 + 1e-6;  // a rounding error of the ideal position is not a fault

/// The whole run of one shape, compared with the shape and the trapezoid at every tick.
void expect_on_shape(Bench bench, const Shape& shape, double top, double slope) {
  bench.group.run.set_speed(by_slope(top, slope), 0);
  bench.add(shape.path());
  const Travels from = bench.travels();
  ASSERT_EQ(bench.begin(shape.begin), Cause::none);
  const double whole_s = trapezoid_s(shape.length_u(), top, slope);
  while (bench.group.engaged && bench.tick < 100'000) {
    bench.step();
    const double t_s = static_cast<double>(bench.tick - 1) / kTicksPerSecond;
    const double along = trapezoid_at(t_s, shape.length_u(), top, slope);
    const Point ideal = shape.length_u() > 0 ? shape.ideal(along / shape.length_u()) : shape.end;
    for (std::size_t i = 0; i < Bench::kAxes; ++i) {
      const std::int8_t axis = bench.group.axis_of[i];
      if (axis == Coordinated::kNone) continue;
      const auto number = static_cast<std::size_t>(axis);
      const double per_unit = bench.group.scale[i].pulses_per_unit();
      // Both the travel from the beginning and the ideal one, in the coordinate's pulses.
      const double zero =
          static_cast<double>(from[number]) - std::round(shape.begin[static_cast<int>(i)] * per_unit);
      const double off = static_cast<double>(bench.axes[number].travel_pulses) - zero -
                         ideal[static_cast<int>(i)] * per_unit;
      ASSERT_LE(std::abs(off), kHalf) << shape.code() << " coordinate " << i << " tick " << bench.tick;
    }
  }
  EXPECT_NEAR(static_cast<double>(bench.tick - 1), whole_s * kTicksPerSecond, 1) << shape.code();
  EXPECT_EQ(bench.group.cause, Cause::arrived);
  for (std::size_t i = 0; i < Bench::kAxes; ++i) {
    const std::int8_t axis = bench.group.axis_of[i];
    if (axis == Coordinated::kNone) continue;
    const auto number = static_cast<std::size_t>(axis);
    const auto whole = [&](const Point& p) {
      return *bench.group.scale[i].to_pulses(std::llround(p[static_cast<int>(i)]));
    };
    EXPECT_EQ(bench.axes[number].travel_pulses - from[number], whole(shape.end) - whole(shape.begin));
    EXPECT_EQ(bench.sent[number], bench.axes[number].travel_pulses - from[number]);
    EXPECT_FALSE(bench.axes[number].moving());
    EXPECT_EQ(bench.axes[number].cause, Cause::arrived);
  }
}

TEST(CoordinatedPath, EveryAxisIsWithinHalfAPulseAndEndsExactly) {
  const Shape kShapes[]{
      Shape::line_to(place_of(0, 0), place_of(1000, 0)),
      Shape::line_to(place_of(0, 0), place_of(-3, -7001)),
      Shape::line_to(place_of(100, -200), place_of(-4000, 3999)),
      Shape::line_to(place_of(-5, 6, -7, 8), place_of(1234, -2345, 3456, -4567)),
      Shape::line_to(place_of(7, 7, 7, 7), place_of(7, 7, 7, 7)),
      Shape::line_to(place_of(0, 0), place_of(1, 0)),
      Shape::arc(place_of(0, 0), place_of(0, 5000), kPi / 2),
      Shape::arc(place_of(-3000, 0), place_of(-1000, 0), -kPi),
      Shape::arc(place_of(100, 100), place_of(-900, 100), 1.5 * kPi, 700),
      Shape::arc(place_of(0, 0), place_of(3, 4), kPi),
  };
  for (const Shape& shape : kShapes) {
    expect_on_shape(Bench{}, shape, 20'000, 100'000);
    expect_on_shape(Bench{}, shape, 1e6, 1e7);
    expect_on_shape(Bench{}, shape, 999, 12'345);
  }
}

TEST(CoordinatedPath, CoordinatesAreScaledByMultiplierAndDivider) {
  const Shape line = Shape::line_to(place_of(0, 0, 0, 0), place_of(20'000, -25'000, 12'345, 3));
  const Shape arc = Shape::arc(place_of(1000, 1000), place_of(1000, 15'000), kPi / 2);
  for (const UnitScale scale :
       {UnitScale{8, 5}, UnitScale{1, 3}, UnitScale{4000, 36'000}, UnitScale{131'072, 131'071}}) {
    Bench bench;
    bench.group.scale = {scale, UnitScale{1, 1}, UnitScale{5, 8}, scale};
    expect_on_shape(bench, line, 50'000, 666'667);
    bench.group.scale = {scale, scale, scale, scale};
    expect_on_shape(bench, arc, 50'000, 666'667);
  }
}

TEST(CoordinatedPath, AxesGoByCoordinatesInWhateverOrder) {
  const Shape line = Shape::line_to(place_of(1, 2, 3, 4), place_of(-400, 800, 1200, -100));
  constexpr std::int8_t kNone = Coordinated::kNone;
  const std::array<std::int8_t, 4> kOrders[]{
      {0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}, {1, kNone, 0, kNone}, {kNone, kNone, kNone, 2}};
  for (const auto& order : kOrders) {
    Bench bench;
    bench.axes[0].travel_pulses = 77;  // the present positions of the axes do not matter
    bench.axes[2].travel_pulses = -1'000'000'007;
    bench.group.axis_of = order;
    expect_on_shape(bench, line, 10'000, 100'000);
  }
}

TEST(CoordinatedPath, AxesThatTakeNoPartGoTheirOwnWay) {
  Bench bench;
  bench.group.axis_of = {1, 3, Coordinated::kNone, Coordinated::kNone};
  bench.add(line(place_of(0, 0), place_of(1000, 500)));
  bench.axes[0].move(-300, by_slope(10'000, 100'000), 0);
  ASSERT_EQ(bench.begin(), Cause::none);
  EXPECT_FALSE(bench.group.takes(0));
  EXPECT_TRUE(bench.group.takes(1));
  EXPECT_FALSE(bench.group.takes(2));
  EXPECT_GT(bench.to_the_end(), 0);
  bench.steps(300);
  EXPECT_EQ(bench.travels(), (Travels{-300, 1000, 0, 500}));
}

TEST(CoordinatedPath, AfterTheEndTheAxesAreFreeAndTheirEventsTold) {
  Bench bench;
  bench.add(line(place_of(0, 0), place_of(100, 100)));
  bench.begin();
  bench.step();
  for (const Events events : bench.events) EXPECT_EQ(events, bit(Event::started));
  bench.to_the_end();
  bench.step();
  for (const Events events : bench.events) EXPECT_EQ(events, bit(Event::started) | bit(Event::ended));
  EXPECT_EQ(bench.axes[1].move(50, by_slope(10'000, 100'000), bench.tick), Cause::none);
  bench.steps(200);
  EXPECT_EQ(bench.travels(), (Travels{100, 150, 0, 0}));
}

TEST(CoordinatedPath, KeptByTheirOwnerTheyStandBetweenRuns) {
  // Engaged with nothing queued: at the given position, wherever the run's last one ended.
  Bench bench;
  ASSERT_EQ(bench.begin(place_of(5000, -7000)), Cause::none);
  for (int i = 0; i < 10; ++i) bench.step(true);
  EXPECT_EQ(bench.travels(), (Travels{0, 0, 0, 0}));
  EXPECT_TRUE(bench.group.engaged);
  bench.add(line(place_of(5000, -7000), place_of(5100, -7000)));
  for (int i = 0; i < 200; ++i) bench.step(true);
  EXPECT_EQ(bench.travels(), (Travels{100, 0, 0, 0}));
  bench.step();
  EXPECT_FALSE(bench.group.engaged);
  EXPECT_EQ(bench.group.cause, Cause::arrived);
  // And again from another position.
  ASSERT_EQ(bench.begin(place_of(1, 1)), Cause::none);
  bench.step(true);
  EXPECT_EQ(bench.travels(), (Travels{100, 0, 0, 0}));
}

TEST(CoordinatedPath, PausedItStaysEngagedUntilItIsResumed) {
  Bench bench;
  bench.add(line(place_of(0, 0), place_of(10'000, 5000)));
  bench.begin();
  bench.steps(100);
  bench.group.run.pause(bench.tick);
  bench.steps(500);
  EXPECT_TRUE(bench.group.engaged);
  const Travels stands = bench.travels();
  bench.steps(10);
  EXPECT_EQ(bench.travels(), stands);
  EXPECT_NEAR(static_cast<double>(stands[0]), 2.0 * static_cast<double>(stands[1]), 1.5);
  bench.group.run.resume(bench.tick);
  EXPECT_GT(bench.to_the_end(), 0);
  EXPECT_EQ(bench.travels(), (Travels{10'000, 5000, 0, 0}));
}

TEST(CoordinatedPath, ALawThatWasNeverGivenChangesNothing) {
  Bench bench;
  bench.group.run = PathRun{};
  bench.add(line(place_of(0, 0), place_of(100, 0)));
  const Coordinated before = bench.group;
  EXPECT_THROW(bench.begin(), BadMotion);
  EXPECT_EQ(bench.group, before);
  for (const Axis& axis : bench.axes) EXPECT_FALSE(axis.moving());
}

TEST(CoordinatedPath, BacklashComesOutAtEachReversalAndIsNotTravel) {
  Bench bench(by_slope(50'000, 500'000));
  for (std::size_t i = 0; i < 2; ++i) {
    AxisSettings settings;
    settings.backlash_pulses = 40;
    settings.backlash_speed_pps = 1000;
    bench.axes[i].set(settings);
  }
  // One full turn: X moves -, +; it starts at its maximum X. Y moves +, -, +.
  const Shape shape = Shape::arc(place_of(3000, 0), place_of(0, 0), 2 * kPi);
  bench.add(shape.path());
  bench.begin(shape.begin);
  Travels before = bench.travels();
  std::array<std::int64_t, 2> extra{};
  std::array<int, 2> reversals{};
  while (bench.group.engaged && bench.tick < 100'000) {
    bench.step();
    for (std::size_t i = 0; i < 2; ++i) {
      const std::int64_t travel = bench.axes[i].travel_pulses - before[i];
      const std::int64_t more = bench.pulses[i] - travel;
      if (more != 0) {
        ++reversals[i];
        EXPECT_EQ(more, travel < 0 ? -40 : 40) << "tick " << bench.tick;
        extra[i] += more;
      }
    }
    before = bench.travels();
  }
  EXPECT_EQ(reversals, (std::array<int, 2>{1, 2}));
  EXPECT_EQ(bench.axes[0].backlash_sent, 40);
  EXPECT_EQ(bench.axes[1].backlash_sent, 0);  // out and back
  EXPECT_EQ(bench.travels(), (Travels{0, 0, 0, 0}));
}

TEST(CoordinatedPath, TheSpeedOfAnAxisIsHowFastItsPlaceChanges) {
  // A line of 3:4, then a quarter circle of radius 1000 that continues in its direction (0.6, 0.8), in pulses
  // of 1/8 and 1/2 units. Speeds by hand: 5000 u/s along the path.
  constexpr double kSpeed = 5000;
  Bench bench;
  bench.group.run.set_speed(by_slope(kSpeed, 1e6), 0);
  bench.group.scale[0] = {8, 1};
  bench.group.scale[1] = {2, 1};
  bench.add(line(place_of(0, 0), place_of(600, 800)));
  const Point centre = place_of(600 - 800, 800 + 600);  // to the left of (0.6, 0.8)
  bench.add(arc_by_sweep(place_of(600, 800), centre, kPi / 2), {.rule = Joint::Rule::join});
  ASSERT_EQ(bench.begin(), Cause::none);
  EXPECT_EQ(bench.group.speed_pps(0, bench.tick), 0);
  bench.steps(101);  // 5 ms up: 12.5 u; then 95 ms: 475 u
  EXPECT_NEAR(bench.group.speed_pps(0, bench.tick), 8 * 0.6 * kSpeed, 1e-6);
  EXPECT_NEAR(bench.group.speed_pps(1, bench.tick), 2 * 0.8 * kSpeed, 1e-6);
  EXPECT_EQ(bench.group.speed_pps(2, bench.tick), 0);
  // 300 ms after the beginning: 12.5 + 1475 u, 487.5 u into the arc.
  bench.steps(200);
  const double angle_rad = std::atan2(-600, 800) + 487.5 / 1000;  // seen from the centre
  EXPECT_NEAR(bench.group.speed_pps(0, bench.tick), 8 * kSpeed * -std::sin(angle_rad), 1e-4);
  EXPECT_NEAR(bench.group.speed_pps(1, bench.tick), 2 * kSpeed * std::cos(angle_rad), 1e-4);
  bench.to_the_end();
  EXPECT_EQ(bench.group.speed_pps(0, bench.tick), 0);
}

TEST(CoordinatedPath, TheLongestAxisHasTheSpeedIfItMeasuresTheLength) {
  Bench bench;
  bench.group.run.set_speed(by_slope(5000, 1e6), 0);
  bench.add(line(place_of(0, 0), place_of(600, -800), Measure::longest_axis));
  ASSERT_EQ(bench.begin(), Cause::none);
  bench.steps(101);
  EXPECT_NEAR(bench.group.speed_pps(0, bench.tick), 3750, 1e-6);
  EXPECT_NEAR(bench.group.speed_pps(1, bench.tick), -5000, 1e-6);
}

}  // namespace coordinated_path_test
}  // namespace understudy::motion
