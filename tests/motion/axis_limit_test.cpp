// What stops an axis: limit switches, soft limits, alarm and emergency.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/motion/axis_course.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace axis_limit_test {

/// A track with a switch at either end.
AxisCourse track(std::int64_t low, std::int64_t high) {
  AxisCourse course;
  course.environment.add(Signal::limit_minus, INT64_MIN, low);
  course.environment.add(Signal::limit_plus, high, INT64_MAX);
  return course;
}

struct WayCase {
  int direction;
  Cause hard;
  Cause soft;
};
constexpr std::array<WayCase, 2> kWays{{
    {+1, Cause::limit_plus, Cause::soft_limit_plus},
    {-1, Cause::limit_minus, Cause::soft_limit_minus},
}};

TEST(AxisLimit, StoppedAtOnceItStandsExactlyOnTheEdge) {
  for (const auto& [way, hard, soft] : kWays) {
    for (const std::int64_t edge : {1, 7, 1'000, 12'345}) {
      for (const double pps : {1e3, 33'333.0, 4e6}) {
        AxisCourse course = track(-edge, edge);
        course.axis.run(way, trapezoid(pps, 1e6), 0);
        ASSERT_GE(course.until_rest(), 0);
        EXPECT_EQ(course.travel(), way * edge) << pps;
        EXPECT_EQ(course.output_pulses, way * edge) << pps;
        EXPECT_EQ(course.axis.cause, hard);
        EXPECT_EQ(course.endings, 1);
        EXPECT_EQ(course.steps(10), 0);
      }
    }
  }
}

TEST(AxisLimit, SlowedDownItStandsABrakingDistanceBeyond) {
  for (const auto& [way, hard, soft] : kWays) {
    for (const double top_pps : {2'000.0, 50'000.0, 1e6}) {
      for (const double slope_pps2 : {50'000.0, 123'456.0, 3e6}) {
        const double braking = top_pps * top_pps / (2 * slope_pps2);
        const auto edge = static_cast<std::int64_t>(2 * braking) + 1'234;  // at full speed by then
        AxisCourse course = track(-edge, edge);
        course.axis.set({.at_limit_plus = Reaction::slow_down, .at_limit_minus = Reaction::slow_down});
        course.axis.move(way * 100'000'000, trapezoid(top_pps, slope_pps2), 0);
        ASSERT_GE(course.until_rest(), 0);
        EXPECT_NEAR(static_cast<double>(way * course.travel()),
                    static_cast<double>(edge) + std::floor(braking), 1)
            << top_pps << " pps, " << slope_pps2;
        EXPECT_EQ(course.axis.cause, hard);
        EXPECT_EQ(course.endings, 1);
      }
    }
  }
}

TEST(AxisLimit, OnlyMotionTowardsItIsStopped) {
  for (const auto& [way, hard, soft] : kWays) {
    AxisCourse course = track(-1'000, 1'000);
    course.axis.move(way * 5'000, constant(10'000), 0);
    course.until_rest();
    EXPECT_EQ(course.axis.forbidden(way), hard);
    EXPECT_EQ(course.axis.forbidden(-way), Cause::none);
    EXPECT_EQ(course.axis.move(way * 10, constant(10'000), course.now), hard);
    EXPECT_EQ(course.axis.run(way, constant(10'000), course.now), hard);
    EXPECT_EQ(course.axis.move_at_zero_speed(way), hard);
    EXPECT_FALSE(course.axis.moving());
    EXPECT_EQ(course.axis.move(-way * 300, constant(10'000), course.now), Cause::none);
    course.until_rest();
    EXPECT_EQ(course.travel(), way * 700);
    EXPECT_EQ(course.axis.cause, Cause::arrived);
    EXPECT_EQ(course.axis.forbidden(way), Cause::none);
  }
}

TEST(AxisLimit, ThatIsOnFromTheBeginningStopsBeforeThePulse) {
  AxisCourse course = track(-1'000, 0);
  course.axis.move(100, constant(10'000), 0);  // not detected yet
  course.until_rest();
  EXPECT_EQ(course.travel(), 0);
  EXPECT_EQ(course.axis.cause, Cause::limit_plus);
  course.axis.move(-100, constant(10'000), course.now);
  course.until_rest();
  EXPECT_EQ(course.travel(), -100);
}

TEST(AxisLimit, ThatAppearsUnderAMotionStopsIt) {
  AxisCourse course;
  course.axis.run(+1, constant(10'000), 0);
  course.steps(101);
  course.environment.set_steady(Signal::limit_minus, true);
  EXPECT_EQ(course.steps(10), 100);
  course.environment.set_steady(Signal::limit_plus, true);
  EXPECT_EQ(course.step(), 0);
  EXPECT_EQ(course.axis.cause, Cause::limit_plus);
  EXPECT_EQ(course.travel(), 1'100);
}

TEST(AxisLimit, IgnoredItIsPassed) {
  AxisCourse course = track(-10, 10);
  course.axis.set({.at_limit_plus = Reaction::ignore, .at_limit_minus = Reaction::ignore});
  course.axis.move(500, constant(10'000), 0);
  course.until_rest();
  course.axis.move(-1'000, constant(10'000), course.now);
  course.until_rest();
  EXPECT_EQ(course.travel(), -500);
  EXPECT_EQ(course.axis.cause, Cause::arrived);
}

TEST(AxisLimit, AMoveThatEndsOnTheEdgeHasMetIt) {
  AxisCourse course = track(-10, 10);
  course.axis.move(10, constant(1'000), 0);
  course.until_rest();
  EXPECT_EQ(course.travel(), 10);
  EXPECT_EQ(course.axis.cause, Cause::limit_plus);
  course.axis.move(-19, constant(1'000), course.now);
  course.until_rest();
  EXPECT_EQ(course.axis.cause, Cause::arrived);
  EXPECT_EQ(course.travel(), -9);
}

TEST(AxisLimit, TheFirstOfSeveralEdgesInATickCounts) {
  AxisCourse course = track(-10, 1'300);
  course.axis.set({.at_soft_limit = Reaction::stop_at_once, .soft_limit_plus = 1'250});
  course.axis.run(+1, constant(4e6), 0);
  course.until_rest();
  EXPECT_EQ(course.travel(), 1'251);
  EXPECT_EQ(course.axis.cause, Cause::soft_limit_plus);
}

TEST(AxisLimit, ASoftLimitStopsOnePulseBeyondTheLastAllowed) {
  for (const auto& [way, hard, soft] : kWays) {
    for (const std::int64_t last : {5, 999, 1'000, 45'678}) {
      AxisCourse course;
      course.axis.set({.soft_limit_plus = last, .soft_limit_minus = -last});
      course.axis.run(way, trapezoid(44'444, 1e6), 0);
      ASSERT_GE(course.until_rest(), 0);
      EXPECT_EQ(course.travel(), way * (last + 1));
      EXPECT_EQ(course.axis.cause, soft);
      EXPECT_EQ(course.axis.move(way, constant(1'000), course.now), soft);
      EXPECT_EQ(course.axis.move(-way * 5, constant(1'000), course.now), Cause::none);
      course.until_rest();
      EXPECT_EQ(course.travel(), way * (last - 4));
      EXPECT_EQ(course.axis.cause, Cause::arrived);
    }
  }
}

TEST(AxisLimit, ASoftLimitSlowsDownFromThatPulseOn) {
  for (const auto& [way, hard, soft] : kWays) {
    AxisCourse course;
    course.axis.set(
        {.at_soft_limit = Reaction::slow_down, .soft_limit_plus = 20'000, .soft_limit_minus = -20'000});
    course.axis.run(way, trapezoid(50'000, 100'000), 0);
    course.until_rest();
    EXPECT_NEAR(static_cast<double>(way * course.travel()), 20'001 + 12'500, 1);
    EXPECT_EQ(course.axis.cause, soft);
    EXPECT_EQ(course.axis.move(way, constant(1'000), course.now), soft);
    EXPECT_EQ(course.axis.move(-way * 20'000, constant(100'000), course.now), Cause::none);
    course.until_rest();
    EXPECT_EQ(course.axis.cause, Cause::arrived);
  }
}

TEST(AxisLimit, AMoveToTheLastAllowedArrivesAndNoFurtherOneBegins) {
  AxisCourse course;
  course.axis.set({.soft_limit_plus = 100});
  course.axis.move(100, constant(1'000), 0);
  course.until_rest();
  EXPECT_EQ(course.axis.cause, Cause::arrived);
  EXPECT_EQ(course.axis.move(1, constant(1'000), course.now), Cause::soft_limit_plus);
  EXPECT_EQ(course.axis.move(-1, constant(1'000), course.now), Cause::none);
}

TEST(AxisLimit, ASoftLimitIgnoredOrOutOfReachIsNoMatter) {
  for (const AxisSettings& settings :
       {AxisSettings{.at_soft_limit = Reaction::ignore, .soft_limit_plus = 10, .soft_limit_minus = -10},
        AxisSettings{.soft_limit_plus = INT64_MAX, .soft_limit_minus = INT64_MIN}}) {
    AxisCourse course;
    course.axis.set(settings);
    course.axis.move(500, constant(10'000), 0);
    course.until_rest();
    course.axis.move(-1'000, constant(10'000), course.now);
    course.until_rest();
    EXPECT_EQ(course.travel(), -500);
  }
}

TEST(AxisLimit, ASoftLimitSetBehindTheAxisStopsTheMotion) {
  AxisCourse course;
  course.axis.run(+1, constant(10'000), 0);
  course.steps(101);
  course.axis.set({.soft_limit_plus = 500});
  EXPECT_EQ(course.steps(10), 0);
  EXPECT_EQ(course.axis.cause, Cause::soft_limit_plus);
}

struct TroubleCase {
  Signal signal;
  Cause cause;
};
constexpr std::array<TroubleCase, 2> kTroubles{{
    {Signal::alarm, Cause::alarm},
    {Signal::emergency, Cause::emergency},
}};

TEST(AxisLimit, AlarmAndEmergencyStopBothWaysAndRefuseWhileOn) {
  for (const TroubleCase& trouble : kTroubles) {
    for (const int direction : {+1, -1}) {
      AxisCourse course;
      course.axis.run(direction, constant(10'000), 0);
      course.steps(101);
      course.environment.set_steady(trouble.signal, true);
      EXPECT_EQ(course.steps(10), 0);
      EXPECT_EQ(course.axis.cause, trouble.cause);
      EXPECT_EQ(course.axis.move(direction, constant(1'000), course.now), trouble.cause);
      EXPECT_EQ(course.axis.move(-direction, constant(1'000), course.now), trouble.cause);
      course.environment.set_steady(trouble.signal, false);
      course.step();
      EXPECT_EQ(course.axis.move(direction, constant(1'000), course.now), Cause::none);
    }
  }
}

TEST(AxisLimit, AlarmAndEmergencySlowDownWhereThatIsAskedFor) {
  for (const TroubleCase& trouble : kTroubles) {
    AxisCourse course;
    course.axis.set({.at_alarm = Reaction::slow_down, .at_emergency = Reaction::slow_down});
    course.axis.run(+1, trapezoid(10'000, 100'000), 0);
    course.steps(1'001);
    const std::int64_t travel = course.travel();
    course.environment.set_steady(trouble.signal, true);
    course.until_rest();
    EXPECT_EQ(course.travel(), travel + 500);
    EXPECT_EQ(course.axis.cause, trouble.cause);
  }
}

TEST(AxisLimit, AlarmAndEmergencyMayBeIgnored) {
  AxisCourse course;
  course.axis.set({.at_alarm = Reaction::ignore, .at_emergency = Reaction::ignore});
  course.environment.set_steady(Signal::alarm, true);
  course.environment.set_steady(Signal::emergency, true);
  course.axis.move(100, constant(10'000), 0);
  course.until_rest();
  EXPECT_EQ(course.travel(), 100);
}

TEST(AxisLimit, AnEmergencyOfStopAtOnceEndsASlowingDown) {
  AxisCourse course;
  course.axis.run(+1, trapezoid(10'000, 10'000), 0);
  course.steps(1'001);
  course.axis.slow_down(course.now);
  course.steps(100);
  course.environment.set_steady(Signal::emergency, true);
  EXPECT_EQ(course.steps(10), 0);
  EXPECT_EQ(course.axis.cause, Cause::emergency);
}

TEST(AxisLimit, AHangingMoveIsEndedByWhatItWouldBeStoppedBy) {
  for (const Reaction reaction : {Reaction::stop_at_once, Reaction::slow_down}) {
    AxisCourse course;
    course.axis.set({.at_alarm = reaction});
    course.axis.move_at_zero_speed(+1);
    course.steps(10);
    course.environment.set_steady(Signal::alarm, true);
    course.step();
    EXPECT_FALSE(course.axis.moving());
    EXPECT_EQ(course.axis.cause, Cause::alarm);
  }
}

TEST(AxisLimit, AnAxisBetweenTwoSwitchesStopsOnEitherAtAnySpeed) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(300); ++i) {
    const std::int64_t low = -random.of_any_size(1, 100'000);
    const std::int64_t high = random.of_any_size(1, 100'000);
    AxisCourse course = track(low, high);
    course.environment.index_period = random.of_any_size(50, 5'000);
    int direction = random.between(0, 1) == 0 ? +1 : -1;
    std::string input = "seed " + std::to_string(seed()) + ": track(" + std::to_string(low) + ", " +
                        std::to_string(high) + ")";
    for (int runs = 0; runs < 4; ++runs, direction = -direction) {
      const auto pps = static_cast<double>(random.of_any_size(1'000, 4'000'000));
      const auto slope = static_cast<double>(random.of_any_size(10'000, 100'000'000));
      input += " run(" + std::to_string(direction) + ", trapezoid(" + std::to_string(pps) + ", " +
               std::to_string(slope) + "), now)";
      ASSERT_EQ(course.axis.run(direction, trapezoid(pps, slope), course.now), Cause::none) << input;
      ASSERT_GE(course.until_rest(), 0) << input;
      ASSERT_EQ(course.travel(), direction > 0 ? high : low) << input;
      ASSERT_EQ(course.axis.cause, direction > 0 ? Cause::limit_plus : Cause::limit_minus) << input;
    }
  }
}

TEST(AxisLimit, SlowingDownWithinATickStartsFromTheSpeedAtTheEdge) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(2'000); ++i) {
    const std::int64_t edge = random.of_any_size(1, 200'000);
    const auto top_pps = static_cast<double>(random.of_any_size(1'000, 4'000'000));
    const auto up = static_cast<double>(random.of_any_size(10'000, 100'000'000));
    const auto down = static_cast<double>(random.of_any_size(10'000, 100'000'000));
    const double speed_squared = std::min(top_pps * top_pps, 2 * up * static_cast<double>(edge));
    const double braking = speed_squared / (2 * down);
    if (braking > 1e6) continue;  // takes a long time
    const SpeedLaw law{
        .top_speed_u_s = top_pps, .up = RampLaw::by_slope(up), .down = RampLaw::by_slope(down)};
    const int direction = random.between(0, 1) == 0 ? +1 : -1;
    const std::string input = "seed " + std::to_string(seed()) + ": edge " +
                              std::to_string(direction * edge) + ", top " + std::to_string(top_pps) +
                              ", up " + std::to_string(up) + ", down " + std::to_string(down);
    AxisCourse course = track(-edge, edge);
    course.axis.set({.at_limit_plus = Reaction::slow_down, .at_limit_minus = Reaction::slow_down});
    course.axis.run(direction, law, 0);
    while (course.axis.moving()) ASSERT_GE(direction * course.step(), 0) << input << " tick " << course.now;
    const double beyond = static_cast<double>(direction * course.travel() - edge);
    ASSERT_NEAR(beyond, std::floor(braking), 1) << input;
    ASSERT_EQ(course.output_pulses, course.travel()) << input;
    ASSERT_EQ(course.endings, 1) << input;
  }
}

TEST(AxisLimit, TimeRoundingTakesNoPulseBackEvenAfterHours) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(4'000); ++i) {
    // Whole pulses up to the full speed, and whole ones in each tick: edges are exactly on ticks.
    constexpr std::array<double, 6> kSpeeds{1e5, 2e5, 4e5, 1e6, 2e6, 4e6};
    const double pps = kSpeeds[static_cast<std::size_t>(random.between(0, 5))];
    AxisCourse course;
    course.axis.set({.at_limit_plus = Reaction::slow_down});
    course.axis.run(+1, trapezoid(pps, 1e9), 0);
    course.steps(20);
    course.now = random.of_any_size(1'000'000, 1'000'000'000);
    course.step();
    const std::int64_t edge = course.travel() + static_cast<std::int64_t>(pps / kTicksPerSecond);
    course.environment.add(Signal::limit_plus, edge, INT64_MAX);
    while (course.axis.moving()) {
      ASSERT_GE(course.step(), 0) << "seed " << seed() << ": " << pps << " pps, tick " << course.now;
    }
    ASSERT_GE(course.travel(), edge) << "seed " << seed() << ": " << pps << " pps, tick " << course.now;
  }
}

}  // namespace axis_limit_test
}  // namespace understudy::motion
