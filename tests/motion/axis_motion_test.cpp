// Moves, endless runs and stops of an axis without obstacles.
#include <gtest/gtest.h>

#include <cmath>

#include "motion/bad_motion.h"
#include "tests/motion/axis_course.h"
#include "tests/motion/random_laws.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace axis_motion_test {

TEST(AxisMotion, AtRestNothingHappens) {
  AxisCourse course;
  EXPECT_EQ(course.steps(1000), 0);
  EXPECT_FALSE(course.axis.moving());
  EXPECT_EQ(course.seen, 0);
}

TEST(AxisMotion, AMoveSendsItsDistanceAndSaysWhenItBeganAndEnded) {
  for (const std::int64_t distance : {1, 2, 999, 10'000, -1, -7, -10'000}) {
    AxisCourse course;
    EXPECT_EQ(course.axis.move(distance, trapezoid(10'000, 100'000), course.now), Cause::none);
    EXPECT_TRUE(course.axis.moving());
    EXPECT_EQ(course.axis.remaining_pulses(), std::abs(distance));
    course.step();
    EXPECT_TRUE(course.saw(Event::started));
    course.until_rest();
    EXPECT_EQ(course.output_pulses, distance);
    EXPECT_EQ(course.travel(), distance);
    EXPECT_EQ(course.axis.cause, Cause::arrived);
    EXPECT_EQ(course.endings, 1);
    EXPECT_EQ(course.axis.remaining_pulses(), 0);
    EXPECT_EQ(course.steps(100), 0);
  }
}

TEST(AxisMotion, FollowsTheTrapezoidTickByTick) {
  AxisCourse course;
  course.axis.move(-10'000, trapezoid(10'000, 100'000), 0);  // 0.1 s up, 0.9 s along, 0.1 s down
  for (Tick k = 0; k <= 1100; ++k) {
    EXPECT_TRUE(course.axis.moving()) << k;
    course.step();
    const std::int64_t rest = 1100 - k;
    const std::int64_t place = k <= 100      ? k * k / 20  // 100000 / 2 * (k / 1000)^2
                               : rest <= 100 ? 10'000 - (rest * rest + 19) / 20
                                             : 500 + 10 * (k - 100);
    ASSERT_EQ(course.travel(), -place) << k;
  }
  EXPECT_FALSE(course.axis.moving());
}

TEST(AxisMotion, AMoveOfNoDistanceIsOverAtOnceAndEndsWhatRuns) {
  AxisCourse course;
  EXPECT_EQ(course.axis.move(0, constant(1000), 0), Cause::none);
  EXPECT_FALSE(course.axis.moving());
  course.axis.run(+1, constant(1000), 0);
  course.steps(11);
  EXPECT_EQ(course.travel(), 10);
  EXPECT_EQ(course.axis.move(0, constant(1000), course.now), Cause::none);
  EXPECT_FALSE(course.axis.moving());
  EXPECT_EQ(course.axis.cause, Cause::arrived);
  EXPECT_EQ(course.steps(10), 0);
  EXPECT_EQ(course.endings, 1);
}

TEST(AxisMotion, ANewMoveBeginsFromWhereTheAxisIs) {
  AxisCourse course;
  course.axis.move(1000, constant(1000), 0);
  course.steps(101);
  EXPECT_EQ(course.travel(), 100);
  course.axis.move(-30, constant(1000), course.now);
  EXPECT_EQ(course.axis.remaining_pulses(), 30);
  course.until_rest();
  EXPECT_EQ(course.travel(), 70);
  EXPECT_EQ(course.output_pulses, 70);
}

TEST(AxisMotion, AnEndlessRunGoesOnAtItsSpeed) {
  for (const int direction : {+1, -1}) {
    AxisCourse course;
    EXPECT_EQ(course.axis.run(direction, trapezoid(50'000, 100'000), 0), Cause::none);
    course.steps(501);
    EXPECT_EQ(course.travel(), direction * 12'500);
    EXPECT_EQ(course.steps(10'000), direction * 500'000);
    EXPECT_TRUE(course.axis.moving());
    EXPECT_EQ(course.axis.remaining_pulses(), 0);
  }
}

TEST(AxisMotion, AMoveAtSpeedZeroHangsUntilItIsStopped) {
  AxisCourse course;
  EXPECT_EQ(course.axis.move_at_zero_speed(-1), Cause::none);
  EXPECT_EQ(course.steps(5000), 0);
  EXPECT_TRUE(course.axis.moving());
  course.axis.slow_down(course.now);
  EXPECT_FALSE(course.axis.moving());
  EXPECT_EQ(course.axis.cause, Cause::stopped);
  course.axis.move_at_zero_speed(+1);
  course.step();
  course.axis.move(5, constant(1000), course.now);
  course.until_rest();
  EXPECT_EQ(course.travel(), 5);
}

TEST(AxisMotion, AfterAStopThereIsNoPulse) {
  for (const bool endless : {false, true}) {
    AxisCourse course;
    if (endless) {
      course.axis.run(+1, trapezoid(1e6, 1e6), 0);
    } else {
      course.axis.move(10'000'000, trapezoid(1e6, 1e6), 0);
    }
    course.steps(700);
    const std::int64_t travel = course.travel();
    course.axis.stop();
    EXPECT_FALSE(course.axis.moving());
    EXPECT_EQ(course.steps(1000), 0);
    EXPECT_EQ(course.travel(), travel);
    EXPECT_EQ(course.axis.cause, Cause::stopped);
    EXPECT_EQ(course.endings, 1);
    course.axis.stop();
    EXPECT_EQ(course.steps(10), 0);
    EXPECT_EQ(course.endings, 1);
  }
}

TEST(AxisMotion, SlowingDownTakesTheDistanceThatPhysicsSays) {
  for (const double top_pps : {1'000.0, 12'345.0, 400'000.0}) {
    for (const double slope_pps2 : {10'000.0, 98'765.0, 3e6}) {
      AxisCourse course;
      course.axis.run(-1, trapezoid(top_pps, slope_pps2), 0);
      const double up_s = top_pps / slope_pps2;
      course.steps(static_cast<Tick>(up_s * 1000) + 50);
      const double place = -course.axis.sample(course.now).position_u;
      course.axis.slow_down(course.now);
      EXPECT_TRUE(course.axis.moving());
      const Tick ticks = course.until_rest();
      EXPECT_EQ(course.travel(), std::ceil(place - top_pps * top_pps / (2 * slope_pps2) - 1e-6))
          << top_pps << " pps, " << slope_pps2;
      EXPECT_EQ(ticks, std::ceil(up_s * 1000 - 1e-6));
      EXPECT_EQ(course.axis.cause, Cause::stopped);
      EXPECT_EQ(course.endings, 1);
    }
  }
}

TEST(AxisMotion, SlowingDownEndsAtTheStartSpeed) {
  SpeedLaw law = trapezoid(10'000, 100'000);
  law.start_speed_u_s = 2'000;
  AxisCourse course;
  course.axis.run(+1, law, 0);
  course.steps(1001);  // 10000 pps for a long time
  const double place = course.axis.sample(course.now).position_u;
  course.axis.slow_down(course.now);
  EXPECT_EQ(course.until_rest(), 80);
  EXPECT_EQ(course.travel(), std::floor(place + 0.5 * (10'000 + 2'000) * 0.08 + 1e-9));
}

TEST(AxisMotion, SlowingDownAtTheStartSpeedOrBeforeItBeganIsAStop) {
  AxisCourse course;
  course.axis.run(+1, constant(5'000), 0);
  course.axis.slow_down(0);
  EXPECT_FALSE(course.axis.moving());
  course.axis.run(+1, constant(5'000), 0);
  course.steps(11);
  course.axis.slow_down(course.now);
  EXPECT_FALSE(course.axis.moving());
  EXPECT_EQ(course.steps(10), 0);
  EXPECT_EQ(course.travel(), 50);
}

TEST(AxisMotion, SlowingDownLateReachesTheTargetWithoutPassingIt) {
  for (Tick when = 1; when < 1100; when += 7) {
    AxisCourse course;
    course.axis.move(10'000, trapezoid(10'000, 100'000), 0);
    course.steps(when);
    course.axis.slow_down(course.now);
    course.until_rest();
    EXPECT_LE(course.travel(), 10'000) << when;
    if (when > 1001) {
      EXPECT_EQ(course.travel(), 10'000) << when;
    }
  }
}

TEST(AxisMotion, SlowingDownDuringTheRampDownStillReachesTheTarget) {
  RandomLaws laws(seed());
  for (int i = 0; i < random_cases(3'000); ++i) {
    const double top = laws.of_any_size(1e3, 1e6);
    const SpeedLaw law{.top_speed_u_s = top, .up = laws.slope(false), .down = laws.any_ramp(top, false)};
    const auto distance = static_cast<std::int64_t>(laws.of_any_size(1, 1e6));
    const Profile profile = plan(static_cast<double>(distance), law);
    // Returns the position at which its speed starts to decrease for good.
    double begins_s = profile.duration_s;
    for (std::int32_t k = profile.segment_count - 1; k >= 0; --k) {
      const Segment& segment = profile.segments[static_cast<std::size_t>(k)];
      if (segment.acceleration_u_s2 >= 0 && segment.jerk_u_s3 >= 0) break;
      begins_s = segment.begin_s;
    }
    const auto begins = static_cast<Tick>(begins_s * 1000) + 1;
    const auto ends = static_cast<Tick>(profile.duration_s * 1000);
    if (ends < begins || ends > 3'000) continue;
    AxisCourse course;
    course.axis.move(distance, law, 0);
    course.steps(1 + begins + static_cast<Tick>(laws.below(static_cast<std::uint64_t>(ends - begins + 1))));
    course.axis.slow_down(course.now);
    course.until_rest();
    ASSERT_EQ(course.travel(), distance)
        << "seed " << seed() << ": " << code(law) << " stopped in tick " << course.now;
  }
}

TEST(AxisMotion, AStopWhileSlowingDownIsAtOnce) {
  AxisCourse course;
  course.axis.run(+1, trapezoid(10'000, 10'000), 0);
  course.steps(500);
  course.axis.slow_down(course.now);
  course.steps(100);
  EXPECT_TRUE(course.axis.moving());
  course.axis.slow_down(course.now, Cause::alarm);  // it already does so
  course.axis.stop();
  EXPECT_EQ(course.steps(100), 0);
  EXPECT_EQ(course.axis.cause, Cause::stopped);
}

TEST(AxisMotion, WithTheServoOffCommandsAreRefusedAndMotionEnds) {
  AxisCourse course;
  course.axis.move(1000, constant(1000), 0);
  course.steps(101);
  course.axis.switch_servo(false);
  EXPECT_FALSE(course.axis.moving());
  EXPECT_EQ(course.axis.cause, Cause::servo_off);
  EXPECT_EQ(course.steps(100), 0);
  EXPECT_EQ(course.endings, 1);
  const Axis before = course.axis;
  EXPECT_EQ(course.axis.move(1000, constant(1000), course.now), Cause::servo_off);
  EXPECT_EQ(course.axis.run(+1, constant(1000), course.now), Cause::servo_off);
  EXPECT_EQ(course.axis.move_at_zero_speed(+1), Cause::servo_off);
  EXPECT_EQ(course.axis.follow({}), Cause::servo_off);
  EXPECT_EQ(course.axis.take_part(), Cause::servo_off);
  EXPECT_EQ(course.axis, before);
}

TEST(AxisMotion, AnAxisThatNeedsNoServoMovesWithoutIt) {
  AxisCourse course;
  course.axis.switch_servo(false);
  course.axis.set({.needs_servo = false});
  EXPECT_EQ(course.axis.move(10, constant(1000), 0), Cause::none);
  course.axis.switch_servo(false);
  course.until_rest();
  EXPECT_EQ(course.travel(), 10);
}

TEST(AxisMotion, WhatCannotBePlannedIsRefusedAndChangesNothing) {
  AxisCourse course;
  course.axis.move(1000, constant(1000), 0);
  course.steps(10);
  const Axis before = course.axis;
  SpeedLaw bad = constant(1000);
  bad.top_speed_u_s = NAN;
  EXPECT_THROW(course.axis.move(10, bad, course.now), BadMotion);
  EXPECT_THROW(course.axis.run(+1, bad, course.now), BadMotion);
  EXPECT_THROW(course.axis.change_speed(bad, course.now), BadMotion);
  EXPECT_THROW(course.axis.move(INT64_MIN, constant(1000), course.now), BadMotion);
  EXPECT_THROW(course.axis.move(INT64_MAX, constant(1000), course.now), BadMotion);
  EXPECT_THROW(course.axis.change_distance((INT64_C(1) << 53) + 1, false, course.now), BadMotion);
  EXPECT_THROW(course.axis.follow({.denominator = 0}), BadMotion);
  EXPECT_THROW(course.axis.set({.backlash_pulses = 5}), BadMotion);
  EXPECT_EQ(course.axis, before);
}

TEST(AxisMotion, PulsesOfAnInvertedAxisComeOutInTheOtherSense) {
  AxisCourse course;
  course.axis.inverted = true;
  course.axis.move(1000, trapezoid(10'000, 100'000), 0);
  course.until_rest();
  EXPECT_EQ(course.travel(), 1000);
  EXPECT_EQ(course.output_pulses, -1000);
}

TEST(AxisMotion, ASampleTellsPlaceSpeedAndAcceleration) {
  AxisCourse course;
  course.axis.move(-10'000, trapezoid(10'000, 100'000), 0);
  course.steps(51);
  const Sample now = course.axis.sample(course.now);
  EXPECT_NEAR(now.position_u, 125, 1e-9);
  EXPECT_NEAR(now.speed_u_s, 5'000, 1e-9);
  EXPECT_NEAR(now.acceleration_u_s2, 100'000, 1e-6);
}

}  // namespace axis_motion_test
}  // namespace understudy::motion
