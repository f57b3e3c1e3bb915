// A different speed or distance for a running motion.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "motion/bad_motion.h"
#include "tests/motion/axis_course.h"
#include "tests/motion/random_laws.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace axis_change_test {

TEST(AxisChange, ASpeedChangedInTheMidstIsReachedAlongTheRamp) {
  AxisCourse course;
  course.axis.run(+1, trapezoid(10'000, 100'000), 0);
  course.steps(1001);
  course.axis.change_speed(trapezoid(40'000, 100'000), course.now);
  course.steps(150);
  EXPECT_NEAR(course.axis.sample(course.now).speed_u_s, 25'000, 1e-6);
  course.steps(150);
  EXPECT_EQ(course.steps(100), 4'000);
  course.axis.change_speed(trapezoid(5'000, 100'000), course.now);
  course.steps(350);
  EXPECT_EQ(course.steps(100), 500);
}

TEST(AxisChange, AMoveTakesOverASpeedThatThereIs) {
  // From 1000 to 1000: 450 at speed, and 50 in 100 ms to stop. At once, without a tick in between.
  for (const int direction : {+1, -1}) {
    AxisCourse course;
    course.steps(10);
    ASSERT_EQ(course.axis.move_on(direction * 1000.0, direction * 500, trapezoid(1000, 10'000), course.now),
              Cause::none);
    EXPECT_EQ(course.steps(100), direction * 100);
    EXPECT_EQ(course.until_rest(), 350 + 100);
    EXPECT_EQ(course.travel(), direction * 500);
    EXPECT_EQ(course.axis.cause, Cause::arrived);
    // Faster than it should be: 150 in 100 ms down to 1000, 800 ms there, 50 down.
    AxisCourse faster;
    ASSERT_EQ(faster.axis.move_on(direction * 2000.0, direction * 1000, trapezoid(1000, 10'000), 0),
              Cause::none);
    EXPECT_EQ(faster.until_rest(), 100 + 800 + 100);
    EXPECT_EQ(faster.travel(), direction * 1000);
    // In the other direction, and too near: 50 further to a stop, and back.
    for (const int distance : {-100, 20}) {
      AxisCourse back;
      ASSERT_EQ(back.axis.move_on(direction * 1000.0, direction * distance, trapezoid(1000, 10'000), 0),
                Cause::none);
      EXPECT_EQ(back.steps(100), direction * 50);
      EXPECT_GT(back.until_rest(), 0);
      EXPECT_EQ(back.travel(), direction * distance);
      EXPECT_EQ(back.axis.cause, Cause::arrived);
      EXPECT_EQ(back.endings, 1);
    }
  }
}

TEST(AxisChange, AMoveTakesOverWhatItMayAlone) {
  AxisCourse course;
  course.axis.switch_servo(false);
  EXPECT_EQ(course.axis.move_on(1000, 500, trapezoid(1000, 10'000), 0), Cause::servo_off);
  EXPECT_FALSE(course.axis.moving());
  course.axis.switch_servo(true);
  course.axis.signals = bit(Signal::limit_minus);
  const Axis before = course.axis;
  EXPECT_EQ(course.axis.move_on(1000, -500, trapezoid(1000, 10'000), 0), Cause::limit_minus);
  EXPECT_EQ(course.axis.move_on(-1000, 500, trapezoid(1000, 10'000), 0), Cause::limit_minus);
  EXPECT_THROW(course.axis.move_on(1000, 500, trapezoid(0, 10'000), 0), BadMotion);
  EXPECT_EQ(course.axis, before);
  // Without a speed it is a move, and a distance of 0 ends at once.
  EXPECT_EQ(course.axis.move_on(0, 500, trapezoid(1000, 10'000), 0), Cause::none);
  EXPECT_EQ(course.until_rest(), 601);
  EXPECT_EQ(course.travel(), 500);
  EXPECT_EQ(course.axis.move_on(1000, 0, trapezoid(1000, 10'000), course.now), Cause::none);
  EXPECT_FALSE(course.axis.moving());
}

TEST(AxisChange, AMoveStillEndsOnItsTargetWhateverTheSpeedBecomes) {
  for (Tick when = 0; when <= 1100; when += 13) {
    for (const double speed : {500.0, 10'000.0, 77'777.0}) {
      AxisCourse course;
      course.axis.move(10'000, trapezoid(10'000, 100'000), 0);
      course.steps(when);
      course.axis.change_speed(trapezoid(speed, 100'000), course.now);
      ASSERT_GE(course.until_rest(), 0);
      EXPECT_EQ(course.travel(), 10'000) << when << " to " << speed;
      EXPECT_EQ(course.farthest, 10'000) << when << " to " << speed;
      EXPECT_EQ(course.axis.cause, Cause::arrived);
      EXPECT_EQ(course.endings, 1);
    }
  }
}

TEST(AxisChange, BeforeTheFirstTickAMoveBeginsAtTheNewSpeed) {
  for (const Tick when : {0, 1}) {  // commanded, or at its beginning
    AxisCourse changed;
    changed.axis.move(5'000, trapezoid(10'000, 100'000), 0);
    changed.steps(when);
    changed.axis.change_speed(trapezoid(3'000, 50'000), changed.now);
    AxisCourse plain;
    plain.axis.move(5'000, trapezoid(3'000, 50'000), 0);
    plain.steps(when);
    for (int tick = 0; tick < 3'000; ++tick) ASSERT_EQ(changed.step(), plain.step()) << tick;
    EXPECT_EQ(changed.travel(), 5'000);
  }
}

TEST(AxisChange, SeveralChangesInTheSameTickContinueFromThere) {
  AxisCourse course;
  course.axis.move(10'000, trapezoid(10'000, 100'000), 0);
  course.steps(501);
  course.axis.change_speed(trapezoid(20'000, 100'000), course.now);
  course.axis.change_speed(trapezoid(5'000, 100'000), course.now);
  course.axis.change_distance(9'000, false, course.now);
  EXPECT_EQ(course.step(), 9);  // 10 pulses, and already slower
  EXPECT_NEAR(course.axis.sample(course.now).speed_u_s, 9'900, 1e-6);
  ASSERT_GE(course.until_rest(), 0);
  EXPECT_EQ(course.travel(), 9'000);
  EXPECT_EQ(course.output_pulses, 9'000);
  EXPECT_EQ(course.nearest, 0);

  AxisCourse stopped;
  stopped.axis.run(+1, trapezoid(10'000, 100'000), 0);
  stopped.steps(501);
  stopped.axis.change_speed(trapezoid(20'000, 100'000), stopped.now);
  stopped.axis.slow_down(stopped.now);
  stopped.until_rest();
  EXPECT_EQ(stopped.travel(), 5'000);
}

TEST(AxisChange, ASlowerRampGivenTooLateEndsAbruptlyOnTheTarget) {
  AxisCourse course;
  course.axis.move(10'000, trapezoid(10'000, 100'000), 0);
  course.steps(1001);  // it is about to decelerate
  course.axis.change_speed(trapezoid(10'000, 1'000), course.now);
  course.until_rest();
  EXPECT_EQ(course.travel(), 10'000);
  EXPECT_EQ(course.farthest, 10'000);
}

TEST(AxisChange, WhatStopsOrStandsTakesNoNewSpeed) {
  AxisCourse course;
  course.axis.run(+1, trapezoid(10'000, 10'000), 0);
  course.steps(1001);
  course.axis.slow_down(course.now);
  course.steps(10);
  const Axis before = course.axis;
  course.axis.change_speed(trapezoid(90'000, 10'000), course.now);
  course.axis.change_distance(5, false, course.now);
  EXPECT_EQ(course.axis, before);
  course.until_rest();
  EXPECT_EQ(course.farthest, 10'000);  // 5000 up and 5000 down again
  const Axis standing = course.axis;
  course.axis.change_speed(trapezoid(90'000, 10'000), course.now);
  EXPECT_EQ(course.axis, standing);
}

struct DistanceCase {
  Tick when;  // ticks done
  std::int64_t changed;
  std::int64_t farthest;
};

TEST(AxisChange, AnotherDistanceIsCountedFromWhereTheMoveBegan) {
  // 10000 pulses at 10000 pps with 500 pulses of ramp at either end. After 501 ticks 4500 are sent.
  constexpr std::array<DistanceCase, 13> kCases{{
      {0, 2'000, 2'000},
      {1, 2'000, 2'000},
      {501, 20'000, 20'000},
      {501, 10'000, 10'000},
      {501, 6'000, 6'000},
      {501, 5'001, 5'001},
      {501, 5'000, 5'000},   // just within reach
      {501, 4'999, 5'000},   // and just out of reach
      {501, 4'500, 5'000},   // its present position
      {501, 4'000, 5'000},   // already passed
      {501, 0, 5'000},       // back to its start
      {501, -3'000, 5'000},  // and further
      {1'090, 9'000, 10'000},
  }};
  for (const DistanceCase& c : kCases) {
    for (const int direction : {+1, -1}) {
      AxisCourse course;
      course.axis.move(direction * 10'000, trapezoid(10'000, 100'000), 0);
      course.steps(c.when);
      course.axis.change_distance(c.changed, false, course.now);
      ASSERT_GE(course.until_rest(), 0);
      EXPECT_EQ(course.travel(), direction * c.changed) << c.when << " to " << c.changed;
      EXPECT_EQ(direction > 0 ? course.farthest : -course.nearest, c.farthest)
          << c.when << " to " << c.changed;
      EXPECT_EQ(course.output_pulses, course.travel());
      EXPECT_EQ(course.axis.cause, Cause::arrived);
      EXPECT_EQ(course.endings, 1);
    }
  }
}

TEST(AxisChange, BeforeItHasBegunAMoveMayStillTurnRound) {
  AxisCourse course;
  course.axis.move(1'000, constant(10'000), 0);
  course.axis.change_distance(-50, false, 0);
  course.until_rest();
  EXPECT_EQ(course.travel(), -50);
  EXPECT_EQ(course.farthest, 0);
  course.axis.move(1'000, constant(10'000), course.now);
  course.axis.change_distance(0, false, course.now);
  EXPECT_FALSE(course.axis.moving());
}

TEST(AxisChange, WithStopIfPassedItEndsAtOnceOnWhatIsPassed) {
  for (const std::int64_t changed : {4'500, 4'499, 0, -10}) {
    AxisCourse course;
    course.axis.move(10'000, trapezoid(10'000, 100'000), 0);
    course.steps(501);
    course.axis.change_distance(changed, true, course.now);
    EXPECT_FALSE(course.axis.moving());
    EXPECT_EQ(course.steps(100), 0);
    EXPECT_EQ(course.travel(), 4'500);
    EXPECT_EQ(course.axis.cause, Cause::stopped);
  }
}

TEST(AxisChange, WithStopIfPassedItEndsAbruptlyOnWhatIsTooNear) {
  for (const std::int64_t changed : {4'501, 4'600, 4'999, 5'000, 5'001}) {
    AxisCourse course;
    course.axis.move(10'000, trapezoid(10'000, 100'000), 0);
    course.steps(501);
    course.axis.change_distance(changed, true, course.now);
    ASSERT_GE(course.until_rest(), 0);
    EXPECT_EQ(course.travel(), changed);
    EXPECT_EQ(course.farthest, changed);
    EXPECT_EQ(course.axis.cause, Cause::arrived);
  }
}

TEST(AxisChange, ASecondChangeWhileItOvershootsIsWhereItReturnsTo) {
  for (const std::int64_t second : {3'000, 5'000, 7'000}) {
    AxisCourse course;
    course.axis.move(10'000, trapezoid(10'000, 100'000), 0);
    course.steps(501);
    course.axis.change_distance(1'000, false, course.now);
    course.steps(50);
    course.axis.change_distance(second, false, course.now);
    ASSERT_GE(course.until_rest(), 0);
    EXPECT_EQ(course.travel(), second);
    EXPECT_EQ(course.endings, 1);
  }
}

TEST(AxisChange, AStopWhileItOvershootsKeepsItFromReturning) {
  AxisCourse course;
  course.axis.move(10'000, trapezoid(10'000, 100'000), 0);
  course.steps(501);
  course.axis.change_distance(1'000, false, course.now);
  course.steps(50);
  course.axis.slow_down(course.now);
  course.until_rest();
  EXPECT_EQ(course.travel(), 5'000);
  EXPECT_EQ(course.axis.cause, Cause::stopped);
}

TEST(AxisChange, AReturnThatIsForbiddenEndsWhereItTurns) {
  AxisCourse course;
  course.axis.move(10'000, trapezoid(10'000, 100'000), 0);
  course.steps(501);
  course.axis.change_distance(1'000, false, course.now);
  course.environment.set_steady(Signal::limit_minus, true);
  course.until_rest();
  EXPECT_EQ(course.travel(), 5'000);
  EXPECT_EQ(course.axis.cause, Cause::limit_minus);
  EXPECT_EQ(course.endings, 1);
}

TEST(AxisChange, AReturnThatCannotBePlannedIsRefusedInAdvance) {
  // Deceleration starts 400 pulses before the target. A short move is so slow by then that it would have to
  // creep the rest, at a start speed of 0.
  SpeedLaw law = trapezoid(10'000, 100'000);
  law.slow_down_at_u = 400;
  AxisCourse course;
  course.axis.move(10'000, law, 0);
  course.steps(501);
  const Axis before = course.axis;
  EXPECT_THROW(course.axis.change_distance(4'900, false, course.now), BadMotion);
  EXPECT_EQ(course.axis, before);
  course.until_rest();
  EXPECT_EQ(course.travel(), 10'000);
}

/// Everything that can be changed during the motion, at random; the last request must be the result.
TEST(AxisChange, NoChangeEverLosesOrRepeatsOrReversesAPulse) {
  RandomLaws laws(seed());
  int refused = 0;
  for (int i = 0; i < random_cases(3'000); ++i) {
    const auto any_law = [&] {
      const double top = laws.usual_number();
      return SpeedLaw{.start_speed_u_s = laws.start_speed(top),
                      .top_speed_u_s = top,
                      .up = laws.any_ramp(top, false),
                      .down = laws.any_ramp(top, false),
                      .when_short = static_cast<Short>(laws.below(3))};
    };
    const SpeedLaw law = any_law();
    auto target = static_cast<std::int64_t>(laws.of_any_size(1, 1e6));
    const int direction = laws.below(2) == 0 ? +1 : -1;
    std::string input = "seed " + std::to_string(seed()) + ": { " + code(law) + " move(" +
                        std::to_string(direction * target) + ", law, 0); }";
    AxisCourse course;
    ASSERT_EQ(course.axis.move(direction * target, law, 0), Cause::none);
    bool stopped = false;
    bool may_return = false;
    for (int changes = 0; changes < 4 && course.axis.moving(); ++changes) {
      const auto ticks = static_cast<Tick>(laws.of_any_size(1, 500)) - 1;
      for (Tick tick = 0; tick < ticks; ++tick) {
        const std::int64_t pulses = course.step();
        ASSERT_TRUE(may_return || pulses * direction >= 0) << input << " tick " << course.now;
      }
      if (!course.axis.moving()) break;
      const std::string when = ", " + std::to_string(course.now) + ");";
      try {
        switch (laws.below(8)) {
          case 0:
          case 1:
          case 2: {
            const SpeedLaw changed = any_law();
            input += " { " + code(changed) + " change_speed(law" + when + " }";
            course.axis.change_speed(changed, course.now);
            break;
          }
          case 3:
          case 4:
          case 5: {
            if (may_return) break;  // its coordinate may be that of the return
            const std::int64_t sent = course.travel() * direction;
            auto changed = sent + static_cast<std::int64_t>(laws.of_any_size(1, 1e4)) - 1;
            const bool back = laws.below(4) == 0;
            if (back) changed = sent - static_cast<std::int64_t>(laws.of_any_size(1, 1e4));
            const bool stop_if_passed = laws.below(2) == 0;
            input += " change_distance(" + std::to_string(changed) + (stop_if_passed ? ", true" : ", false") +
                     when;
            course.axis.change_distance(changed, stop_if_passed, course.now);
            if (stop_if_passed && changed <= sent) {
              stopped = true;
            } else {
              target = changed;
              may_return = !stop_if_passed;
            }
            break;
          }
          case 6: {
            if (laws.below(4) != 0) break;
            input += " slow_down(" + std::to_string(course.now) + ");";
            course.axis.slow_down(course.now);
            stopped = true;
            break;
          }
          default: break;
        }
      } catch (const BadMotion& refusal) {
        ++refused;
        input += " // " + std::string(refusal.what());
      }
    }
    for (Tick ticks = 0; ticks < 300'000 && course.axis.moving(); ++ticks) {
      const std::int64_t pulses = course.step();
      ASSERT_TRUE(may_return || pulses * direction >= 0) << input << " tick " << course.now;
    }
    ASSERT_EQ(course.output_pulses, course.travel()) << input;
    if (course.axis.moving()) continue;  // at a crawl
    course.step();                       // which reports a stop
    if (!stopped) {
      ASSERT_EQ(course.travel(), direction * target) << input;
      ASSERT_EQ(course.axis.cause, Cause::arrived) << input;
    }
    ASSERT_EQ(course.endings, 1) << input;
  }
  EXPECT_LT(refused, random_cases(3'000));
}

}  // namespace axis_change_test
}  // namespace understudy::motion
