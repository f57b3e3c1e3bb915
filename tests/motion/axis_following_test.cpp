// An axis that follows a wheel, or that is carried along a path with others: its pulses come from elsewhere,
// and it still handles everything that it meets.
#include <gtest/gtest.h>

#include <array>

#include "tests/motion/axis_course.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace axis_following_test {

TEST(AxisFollowing, GoesWhereTheWheelGoes) {
  AxisCourse course;
  EXPECT_EQ(course.axis.follow({.numerator = -3, .denominator = 2}), Cause::none);
  EXPECT_TRUE(course.axis.moving());
  for (int tick = 0; tick < 10; ++tick) {
    course.axis.feed(4);
    EXPECT_EQ(course.step(), -6);
  }
  course.axis.feed(1);
  EXPECT_EQ(course.step(), -2);  // the floor of -61.5
  course.axis.feed(1);
  EXPECT_EQ(course.step(), -1);
  EXPECT_EQ(course.travel(), -63);
  EXPECT_EQ(course.steps(100), 0);
  EXPECT_TRUE(course.axis.moving());
  EXPECT_TRUE(course.saw(Event::started));
}

TEST(AxisFollowing, ByNothingItStands) {
  AxisCourse course;
  course.axis.follow({.numerator = 0});
  course.axis.feed(1'000'000);
  EXPECT_EQ(course.steps(10), 0);
  EXPECT_TRUE(course.axis.moving());
}

TEST(AxisFollowing, LosesNothingOverAMillionCounts) {
  RandomMoves random(seed());
  AxisCourse course;
  course.axis.follow({.numerator = 355, .denominator = 113, .period_ticks = 5});
  std::int64_t fed = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::int64_t counts = random.between(-100, 110);
    course.axis.feed(counts);
    fed += counts;
    course.step();
  }
  course.steps(10);
  const std::int64_t scaled = fed * 355;
  EXPECT_EQ(course.travel(), scaled >= 0 ? scaled / 113 : -((-scaled + 112) / 113));
  EXPECT_EQ(course.output_pulses, course.travel());
}

TEST(AxisFollowing, AStopEndsItAndWhatWasGathered) {
  for (const bool at_once : {false, true}) {
    AxisCourse course;
    course.axis.follow({.period_ticks = 5});
    course.axis.feed(100);
    EXPECT_EQ(course.steps(2), 40);
    if (at_once) {
      course.axis.stop();
    } else {
      course.axis.slow_down(course.now);
    }
    EXPECT_FALSE(course.axis.moving());
    course.axis.feed(100);
    EXPECT_EQ(course.steps(10), 0);
    EXPECT_EQ(course.endings, 1);
    EXPECT_EQ(course.axis.cause, Cause::stopped);
  }
}

TEST(AxisFollowing, StopsAtALimitOnItsEdge) {
  for (const int direction : {+1, -1}) {
    AxisCourse course;
    course.environment.add(Signal::limit_plus, 50, INT64_MAX);
    course.environment.add(Signal::limit_minus, INT64_MIN, -50);
    course.axis.follow({});
    course.axis.feed(direction * 30);
    course.step();
    course.axis.feed(direction * 30);
    EXPECT_EQ(course.step(), direction * 20);
    EXPECT_EQ(course.travel(), direction * 50);
    EXPECT_FALSE(course.axis.moving());
    EXPECT_EQ(course.axis.cause, direction > 0 ? Cause::limit_plus : Cause::limit_minus);

    // It can follow again: not towards the limit, but freely away from it.
    EXPECT_EQ(course.axis.follow({}), Cause::none);
    course.axis.feed(direction * 10);
    EXPECT_EQ(course.steps(3), 0);
    EXPECT_TRUE(course.axis.moving());
    course.axis.feed(-direction * 10);
    EXPECT_EQ(course.steps(3), -direction * 10);
    course.axis.feed(direction * 10);
    EXPECT_EQ(course.steps(3), direction * 10);
    EXPECT_FALSE(course.axis.moving());
  }
}

TEST(AxisFollowing, StopsOnePulseBeyondASoftLimitWhateverTheTicks) {
  for (const std::int64_t each : {1, 2, 3, 25, 33, 50, 51, 1'000}) {
    for (const int direction : {+1, -1}) {
      AxisCourse course;
      course.axis.set({.soft_limit_plus = 50, .soft_limit_minus = -50});
      course.axis.follow({});
      for (int tick = 0; tick < 60 && course.axis.moving(); ++tick) {
        course.axis.feed(direction * each);
        course.step();
      }
      EXPECT_EQ(course.travel(), direction * 51) << each;
      EXPECT_EQ(course.axis.cause, direction > 0 ? Cause::soft_limit_plus : Cause::soft_limit_minus) << each;
      course.axis.follow({});
      course.axis.feed(direction * each);
      EXPECT_EQ(course.step(), 0);
      course.axis.feed(-direction);
      EXPECT_EQ(course.step(), -direction);
    }
  }
}

TEST(AxisFollowing, AlarmServoOffAndComparatorEndIt) {
  AxisCourse course;
  course.axis.follow({});
  course.step();
  course.environment.set_steady(Signal::alarm, true);
  course.step();
  EXPECT_EQ(course.axis.cause, Cause::alarm);
  EXPECT_FALSE(course.axis.moving());
  course.environment.set_steady(Signal::alarm, false);
  EXPECT_EQ(course.axis.follow({}), Cause::alarm) << "as last seen";
  course.step();
  course.axis.follow({});
  course.step();
  course.axis.switch_servo(false);
  EXPECT_EQ(course.axis.cause, Cause::servo_off);
  course.axis.switch_servo(true);
  course.axis.set_comparator(
      0, {.relation = Comparator::Relation::at_least, .reaction = Reaction::stop_at_once, .value = 17});
  course.axis.follow({});
  course.axis.feed(100);
  course.step();
  EXPECT_EQ(course.travel(), 17);
  EXPECT_EQ(course.axis.cause, Cause::comparator);
}

TEST(AxisFollowing, AMoveEndsItAndBeginsWhereItIs) {
  AxisCourse course;
  course.axis.follow({});
  course.axis.feed(10);
  course.step();
  course.axis.move(-4, constant(1'000), course.now);
  course.until_rest();
  EXPECT_EQ(course.travel(), 6);
  EXPECT_EQ(course.output_pulses, 6);
}

TEST(AxisCarried, GoesByThePulsesItIsGiven) {
  AxisCourse course;
  EXPECT_EQ(course.axis.take_part(), Cause::none);
  std::int64_t travel = 0;
  for (const std::int64_t pulses : {0, 3, 0, -7, 4'000, 1, -1}) {
    EXPECT_EQ(course.carry(pulses), pulses);
    EXPECT_EQ(course.travel(), travel += pulses);
  }
  EXPECT_TRUE(course.axis.moving());
  course.axis.arrive({});
  EXPECT_FALSE(course.axis.moving());
  EXPECT_EQ(course.axis.cause, Cause::arrived);
  course.step();
  EXPECT_EQ(course.endings, 1);
  course.axis.move(5, constant(1'000), course.now);
  course.until_rest();
  EXPECT_EQ(course.travel(), travel + 5);
}

TEST(AxisCarried, EndsAtALimitOnItsEdge) {
  for (const int direction : {+1, -1}) {
    for (const std::int64_t each : {1, 7, 50, 999}) {
      AxisCourse course;
      course.environment.add(Signal::limit_plus, 50, INT64_MAX);
      course.environment.add(Signal::limit_minus, INT64_MIN, -50);
      course.axis.take_part();
      for (int tick = 0; tick < 60 && course.axis.moving(); ++tick) course.carry(direction * each);
      EXPECT_EQ(course.travel(), direction * 50) << each;
      EXPECT_EQ(course.output_pulses, direction * 50) << each;
      EXPECT_EQ(course.axis.cause, direction > 0 ? Cause::limit_plus : Cause::limit_minus);
      EXPECT_EQ(course.endings, 1);
      EXPECT_EQ(course.carry(direction * each), 0);
    }
  }
}

TEST(AxisCarried, EndsOnePulseBeyondASoftLimitWhateverTheTicks) {
  for (const std::int64_t each : {1, 2, 3, 25, 33, 50, 51, 1'000}) {
    AxisCourse course;
    course.axis.set({.soft_limit_plus = 50});
    course.axis.set_comparator(0, {.relation = Comparator::Relation::equal, .value = 50});
    course.axis.take_part();
    for (int tick = 0; tick < 60 && course.axis.moving(); ++tick) course.carry(each);
    EXPECT_EQ(course.travel(), 51) << each;
    EXPECT_EQ(course.axis.cause, Cause::soft_limit_plus) << each;
  }
}

TEST(AxisCarried, OnALimitItMayStandAndLeaveItButNotGoFurther) {
  AxisCourse course;
  course.environment.add(Signal::limit_plus, 0, INT64_MAX);
  course.axis.move(-1, constant(1'000), 0);
  course.until_rest();
  course.axis.move(1, constant(1'000), course.now);  // up to it: the last direction is towards it
  course.until_rest();
  ASSERT_EQ(course.axis.cause, Cause::limit_plus);
  EXPECT_EQ(course.axis.take_part(), Cause::none);
  EXPECT_EQ(course.carry(0), 0);
  EXPECT_EQ(course.carry(0), 0);
  EXPECT_TRUE(course.axis.moving());
  EXPECT_EQ(course.carry(-3), -3);
  EXPECT_EQ(course.carry(+3), 3);
  EXPECT_FALSE(course.axis.moving());
  EXPECT_EQ(course.axis.cause, Cause::limit_plus);

  course.axis.take_part();
  course.carry(0);
  EXPECT_EQ(course.carry(+3), 0);
  EXPECT_FALSE(course.axis.moving());
  EXPECT_EQ(course.axis.cause, Cause::limit_plus);
}

TEST(AxisCarried, AlarmStopServoAndComparatorEndItWithTheirCause) {
  AxisCourse course;
  course.axis.take_part();
  course.carry(5);
  course.environment.set_steady(Signal::emergency, true);
  EXPECT_EQ(course.carry(5), 0);
  EXPECT_EQ(course.axis.cause, Cause::emergency);
  course.environment.set_steady(Signal::emergency, false);
  course.step();
  course.axis.take_part();
  course.carry(5);
  course.axis.stop(Cause::alarm);
  EXPECT_EQ(course.carry(5), 0);
  EXPECT_EQ(course.axis.cause, Cause::alarm);
  course.axis.set_comparator(
      3, {.relation = Comparator::Relation::below, .reaction = Reaction::stop_at_once, .value = 2});
  course.axis.take_part();
  EXPECT_EQ(course.carry(-1'000), -9);
  EXPECT_EQ(course.travel(), 1);
  EXPECT_EQ(course.axis.cause, Cause::comparator);
}

TEST(AxisCarried, InvertedItsPulsesComeOutInTheOtherSense) {
  AxisCourse course;
  course.axis.inverted = true;
  course.axis.take_part();
  EXPECT_EQ(course.carry(5), -5);
  EXPECT_EQ(course.carry(-2), 2);
  EXPECT_EQ(course.travel(), 3);
}

}  // namespace axis_following_test
}  // namespace understudy::motion
