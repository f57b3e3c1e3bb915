// Backlash: at each reversal, extra pulses come first, and the motion starts when they have been sent.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/motion/axis_course.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace axis_backlash_test {

constexpr std::int64_t kExtra = 30;
constexpr AxisSettings kBacklash{.backlash_pulses = kExtra, .backlash_speed_pps = 4'000};

/// Has moved up by 100 already, so that the way down is a reversal.
AxisCourse moved_up(const AxisSettings& settings = kBacklash) {
  AxisCourse course;
  course.axis.set(settings);
  course.axis.move(100, constant(10'000), 0);
  course.until_rest();
  return course;
}

TEST(AxisBacklash, IsNotTakenUpBeforeADirectionIsKnown) {
  for (const int direction : {+1, -1}) {
    AxisCourse course;
    course.axis.set(kBacklash);
    course.axis.move(direction * 100, constant(10'000), 0);
    course.until_rest();
    course.axis.move(direction * 100, constant(10'000), course.now);
    course.until_rest();
    EXPECT_EQ(course.output_pulses, direction * 200);
    EXPECT_EQ(course.axis.backlash_sent, 0);
  }
}

TEST(AxisBacklash, OneThatComesLaterIsTakenUpInTheLastDirection) {
  for (const int direction : {+1, -1}) {
    AxisCourse course;
    course.axis.move(direction * 100, constant(10'000), 0);
    course.until_rest();
    course.axis.set(kBacklash);
    course.axis.move(direction * 100, constant(10'000), course.now);
    course.until_rest();
    EXPECT_EQ(course.axis.backlash_sent, 0);
    course.axis.move(-direction * 100, constant(10'000), course.now);
    course.until_rest();
    EXPECT_EQ(course.axis.backlash_sent, -direction * kExtra);
    AxisSettings none = kBacklash;
    none.backlash_pulses = 0;
    course.axis.set(none);
    course.axis.set(kBacklash);
    course.axis.move(-direction * 100, constant(10'000), course.now);
    course.until_rest();
    EXPECT_EQ(course.axis.backlash_sent, -direction * kExtra);
  }
}

TEST(AxisBacklash, SlipComesAtEveryStart) {
  AxisCourse course;
  AxisSettings slipping = kBacklash;
  slipping.slips = true;
  course.axis.set(slipping);
  std::int64_t travel = 0;
  std::int64_t extra = 0;
  for (const int direction : {+1, +1, -1, -1, +1}) {
    course.axis.move(direction * 100, constant(10'000), course.now);
    course.until_rest();
    travel += direction * 100;
    extra += direction * kExtra;
    EXPECT_EQ(course.travel(), travel);
    EXPECT_EQ(course.axis.backlash_sent, extra);
  }
}

TEST(AxisBacklash, IsOutputFirstAndIsNoTravel) {
  AxisCourse course = moved_up();
  course.output_pulses = 0;
  course.axis.move(-100, constant(10'000), course.now);
  EXPECT_EQ(course.axis.remaining_pulses(), 100);
  course.step();
  // 30 pulses at 4000 pps are 7.5 ms.
  for (std::int64_t tick = 1; tick <= 7; ++tick) {
    EXPECT_EQ(course.step(), -4);
    EXPECT_EQ(course.travel(), 100);
    EXPECT_EQ(course.axis.remaining_pulses(), 100);
  }
  // The motion itself starts at 7.5 ms, and so has made 5 pulses at 8 ms.
  EXPECT_EQ(course.step(), -2 - 5);
  EXPECT_EQ(course.travel(), 95);
  EXPECT_EQ(course.step(), -10);
  course.until_rest();
  EXPECT_EQ(course.travel(), 0);
  EXPECT_EQ(course.output_pulses, -130);
  EXPECT_EQ(course.axis.backlash_sent, -kExtra);
}

TEST(AxisBacklash, TheMotionBeginsToTheMomentWhenItIsOut) {
  for (const double extra_pps : {333.3, 1'234.5, 7'000.0, 29'000.0, 60'000.0, 4e6}) {
    AxisCourse course = moved_up({.backlash_pulses = kExtra, .backlash_speed_pps = extra_pps});
    const Tick begin = course.now + 1;
    course.axis.move(-50'000, trapezoid(100'000, 1e6), course.now);
    const double extra_s = static_cast<double>(kExtra) / extra_pps;
    for (Tick tick = 0; tick < 90 + static_cast<Tick>(extra_s * 1000); ++tick) {
      course.step();
      const double t_s = static_cast<double>(course.now - begin) / 1000 - extra_s;
      const double place = t_s <= 0 ? 0 : 0.5 * 1e6 * t_s * t_s;
      ASSERT_EQ(100 - course.travel(), std::floor(place + 1e-9)) << extra_pps << " tick " << tick;
      const double extra = std::min<double>(kExtra, extra_pps * (t_s + extra_s));
      ASSERT_EQ(-course.axis.backlash_sent, std::floor(extra + 1e-9)) << extra_pps << " tick " << tick;
    }
  }
}

TEST(AxisBacklash, IfItEndsOnATickTheMotionBeginsOnThatTick) {
  AxisCourse course = moved_up({.backlash_pulses = 20, .backlash_speed_pps = 4'000});  // 5 ms
  course.axis.move(-100, constant(10'000), course.now);
  course.steps(5);
  EXPECT_EQ(course.axis.backlash_sent, -16);
  EXPECT_EQ(course.step(), -4);
  EXPECT_EQ(course.travel(), 100);
  EXPECT_EQ(course.step(), -10);
}

TEST(AxisBacklash, EveryReversalTakesItUpAgain) {
  AxisCourse course;
  course.axis.set(kBacklash);
  constexpr std::array<std::int64_t, 7> kMoves{100, -50, -20, 10, -10, 1, 1};
  std::int64_t travel = 0;
  std::int64_t extra = 0;
  std::int64_t before = 0;
  for (const std::int64_t distance : kMoves) {
    course.axis.move(distance, constant(10'000), course.now);
    course.until_rest();
    travel += distance;
    if (before * distance < 0) extra += distance < 0 ? -kExtra : kExtra;
    before = distance;
    EXPECT_EQ(course.travel(), travel);
    EXPECT_EQ(course.axis.backlash_sent, extra);
    EXPECT_EQ(course.output_pulses, travel + extra);
  }
}

TEST(AxisBacklash, AStopWhileItIsTakenUpEndsTheMotionBeforeItBegan) {
  for (const bool at_once : {false, true}) {
    AxisCourse course = moved_up();
    course.axis.move(-100, constant(10'000), course.now);
    course.steps(4);
    const std::int64_t extra = course.axis.backlash_sent;
    EXPECT_EQ(extra, -12);
    if (at_once) {
      course.axis.stop();
    } else {
      course.axis.slow_down(course.now);
    }
    EXPECT_FALSE(course.axis.moving());
    EXPECT_EQ(course.steps(10), 0);
    EXPECT_EQ(course.travel(), 100);
    EXPECT_EQ(course.axis.backlash_sent, extra);
    EXPECT_EQ(course.output_pulses, course.travel() + extra);
  }
}

TEST(AxisBacklash, ALimitAheadStopsItToo) {
  for (const Reaction reaction : {Reaction::stop_at_once, Reaction::slow_down}) {
    AxisSettings settings = kBacklash;
    settings.at_limit_minus = reaction;
    AxisCourse course = moved_up(settings);
    course.axis.move(-100, constant(10'000), course.now);
    course.steps(4);
    course.environment.set_steady(Signal::limit_plus, true);
    course.step();
    EXPECT_TRUE(course.axis.moving());
    course.environment.set_steady(Signal::limit_minus, true);
    EXPECT_EQ(course.step(), 0);
    EXPECT_FALSE(course.axis.moving());
    EXPECT_EQ(course.axis.cause, Cause::limit_minus);
  }
}

TEST(AxisBacklash, AChangeWhileItIsTakenUpAppliesToTheNextMotion) {
  AxisCourse course = moved_up();
  course.axis.move(-100, constant(10'000), course.now);
  course.steps(4);
  course.axis.change_speed(constant(2'000), course.now);
  course.axis.change_distance(60, false, course.now);
  course.steps(5);
  EXPECT_EQ(course.travel(), 99);  // 1 pulse in half a tick
  EXPECT_EQ(course.steps(10), -20);
  course.until_rest();
  EXPECT_EQ(course.travel(), 40);
  EXPECT_EQ(course.output_pulses, 40 - kExtra);
}

TEST(AxisBacklash, AReturnAfterAnOvershootIsAReversal) {
  AxisCourse course;
  course.axis.set(kBacklash);
  course.axis.move(10'000, trapezoid(10'000, 100'000), 0);
  course.steps(501);
  course.axis.change_distance(4'000, false, course.now);
  ASSERT_GE(course.until_rest(), 0);
  EXPECT_EQ(course.travel(), 4'000);
  EXPECT_EQ(course.farthest, 5'000);
  EXPECT_EQ(course.axis.backlash_sent, -kExtra);
  EXPECT_EQ(course.output_pulses, 4'000 - kExtra);
}

TEST(AxisBacklash, AnEndlessRunHasItToo) {
  AxisCourse course = moved_up();
  course.axis.run(-1, constant(10'000), course.now);
  course.steps(109);
  EXPECT_EQ(course.travel(), 100 - 1'005);
  EXPECT_EQ(course.output_pulses, course.travel() - kExtra);
}

TEST(AxisBacklash, WhatFollowsAWheelHasItAtOnce) {
  AxisCourse course;
  course.axis.set(kBacklash);
  course.axis.follow({});
  course.axis.feed(5);
  EXPECT_EQ(course.step(), 5);
  course.axis.feed(-1);
  EXPECT_EQ(course.step(), -1 - kExtra);
  EXPECT_EQ(course.step(), 0);
  course.axis.feed(-1);
  EXPECT_EQ(course.step(), -1);
  course.axis.feed(+2);
  EXPECT_EQ(course.step(), 2 + kExtra);
  EXPECT_EQ(course.travel(), 5);
}

TEST(AxisBacklash, SoDoesWhatIsCarriedAlongAPath) {
  AxisCourse course;
  course.axis.set(kBacklash);
  course.axis.take_part();
  EXPECT_EQ(course.carry(5), 5);
  EXPECT_EQ(course.carry(-3), -3 - kExtra);
  EXPECT_EQ(course.carry(0), 0);
  EXPECT_EQ(course.carry(-3), -3);
  EXPECT_EQ(course.carry(1), 1 + kExtra);
  EXPECT_EQ(course.travel(), 0);
}

TEST(AxisBacklash, AllThatComesOutIsTravelAndBacklash) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(200); ++i) {
    AxisCourse course;
    course.axis.inverted = random.between(0, 1) == 0;
    course.axis.set({.backlash_pulses = random.between(0, 50),
                     .backlash_speed_pps = static_cast<double>(random.of_any_size(100, 100'000))});
    for (int moves = 0; moves < 8; ++moves) {
      const std::int64_t distance = random.of_any_size(1, 3'000) * (random.between(0, 1) == 0 ? 1 : -1);
      const std::int64_t before = course.travel();
      course.axis.move(distance, trapezoid(50'000, 1e6), course.now);
      if (random.between(0, 3) == 0) {
        course.steps(random.between(1, 60));
        course.axis.stop();
      } else {
        ASSERT_GE(course.until_rest(), 0);
        ASSERT_EQ(course.travel(), before + distance) << "seed " << seed() << " case " << i;
      }
      const std::int64_t output = course.travel() + course.axis.backlash_sent;
      ASSERT_EQ(course.output_pulses, course.axis.inverted ? -output : output) << "seed " << seed();
    }
  }
}

}  // namespace axis_backlash_test
}  // namespace understudy::motion
