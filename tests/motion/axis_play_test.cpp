// The backlash of a drive that an axis has taken up; and what an encoder passes within a tick.
#include <gtest/gtest.h>

#include "motion/axis.h"
#include "motion/bad_motion.h"

namespace understudy::motion {
namespace axis_play_test {

SpeedLaw law() {
  return {.top_speed_u_s = 10000, .up = RampLaw::by_slope(1e6), .down = RampLaw::by_slope(1e6)};
}

struct Course {
  Axis axis;
  Environment environment;
  Tick now = 0;

  explicit Course(std::int64_t backlash = 100) {
    AxisSettings settings;
    settings.needs_servo = false;
    settings.backlash_pulses = backlash;
    settings.backlash_speed_pps = 1000;  // one pulse per tick
    axis.set(settings);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) axis.step(++now, environment);
  }
  void to_the_end() {
    for (int i = 0; i < 5000 && axis.moving(); ++i) steps(1);
    ASSERT_FALSE(axis.moving());
  }
};

TEST(AxisPlay, WhatAStopLeftOfTheBacklashIsTakenUpByTheNextMotion) {
  Course course;
  course.axis.move(10, law(), course.now);
  course.to_the_end();
  course.axis.move(-10, law(), course.now);
  course.steps(31);  // 30 of 100
  course.axis.stop();
  EXPECT_EQ(course.axis.backlash_sent, -30);
  EXPECT_EQ(course.axis.travel_pulses, 10);
  course.axis.move(-10, law(), course.now);
  course.to_the_end();
  EXPECT_EQ(course.axis.backlash_sent, -100);
  EXPECT_EQ(course.axis.travel_pulses, 0);
}

TEST(AxisPlay, TurningBackHalfWayTakesUpOnlyWhatWasLost) {
  Course course;
  course.axis.move(10, law(), course.now);
  course.to_the_end();
  course.axis.move(-10, law(), course.now);
  course.steps(41);  // 40 of 100
  course.axis.move(5, law(), course.now);
  course.to_the_end();
  EXPECT_EQ(course.axis.backlash_sent, 0);
  EXPECT_EQ(course.axis.travel_pulses, 15);
}

TEST(AxisPlay, AMotionReplacedBeforeItsFirstPulseCostsNothing) {
  Course course;
  course.axis.move(10, law(), course.now);
  course.to_the_end();
  course.axis.move(-50, law(), course.now);
  course.axis.move(50, law(), course.now);
  course.to_the_end();
  EXPECT_EQ(course.axis.backlash_sent, 0);
  EXPECT_EQ(course.axis.travel_pulses, 60);
}

TEST(AxisEncoder, AComparatorMeetsWhatTheCountPassesWithinATick) {
  for (const auto relation : {Comparator::Relation::equal, Comparator::Relation::at_least}) {
    Course course;
    course.axis.set_comparator(1, {.relation = relation, .count = Count::encoder, .value = 100});
    course.axis.set_encoder(90);
    course.steps(1);
    EXPECT_EQ(course.axis.events & bit(Event::comparator_1), 0);
    course.axis.set_encoder(110);
    course.steps(1);
    EXPECT_NE(course.axis.events & bit(Event::comparator_1), 0);
    course.steps(1);
    EXPECT_EQ(course.axis.events & bit(Event::comparator_1), 0) << "once";
  }
}

TEST(AxisEncoder, AFarJumpIsNoMotion) {
  Course course;
  course.axis.set_comparator(
      1, {.relation = Comparator::Relation::equal, .count = Count::encoder, .value = 100});
  course.axis.set_encoder(INT64_MAX / 2);
  course.steps(1);
  EXPECT_EQ(course.axis.events & bit(Event::comparator_1), 0);
}

TEST(AxisReach, TheFarthestMovesEndOnTheirPulse) {
  const SpeedLaw fast{.top_speed_u_s = 1e15, .up = RampLaw::by_slope(1e18), .down = RampLaw::by_slope(1e18)};
  for (const std::int64_t distance :
       {std::int64_t{2'000'000'000'000'000}, std::int64_t{9'000'000'000'000'000}}) {
    Course course(0);
    course.axis.move(distance, fast, course.now);
    for (int i = 0; i < 20000 && course.axis.moving(); ++i) course.steps(1);
    EXPECT_EQ(course.axis.travel_pulses, distance);
  }
}

TEST(AxisLaw, OneThatNoStopCanBePlannedByIsRefusedAtOnce) {
  Course course;
  const SpeedLaw no_brake{
      .top_speed_u_s = 1e6, .up = RampLaw::by_slope(1e6), .down = RampLaw::by_slope(1e-303)};
  EXPECT_THROW(course.axis.run(+1, no_brake, course.now), BadMotion);
  EXPECT_FALSE(course.axis.moving());
}

TEST(AxisFollowing, AHugeRatioOverADenseIndexDoesNotHang) {
  Course course(0);
  course.environment.index_period = 10;
  ++course.environment.version;
  course.axis.follow({.numerator = INT32_MAX});
  course.axis.feed(50);
  course.steps(1);
  EXPECT_EQ(course.axis.travel_pulses, std::int64_t{INT32_MAX} * 50);
}

}  // namespace axis_play_test
}  // namespace understudy::motion
