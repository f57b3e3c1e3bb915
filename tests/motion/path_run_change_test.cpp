// Changes of a run in progress: different speeds, override, pause and resume. The path stays the same.
#include <gtest/gtest.h>

#include "motion/bad_motion.h"
#include "tests/motion/path_shapes.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace path_run_change_test {

constexpr double kPi = std::numbers::pi;

struct Course {
  PathRun run;
  Walk walk;

  /// A line, a half circle, and another line with a corner of 90 degrees: 50 + 10 pi + 50.
  explicit Course(Joint joint = kJoin, const SpeedLaw& law = by_slope(100, 1000)) {
    run.set_speed(law, 0);
    const Shape first = Shape::line_to(place_of(0, 0), place_of(50, 0));
    const Shape arc = Shape::arc(first.end, place_of(50, 10), kPi);
    const Shape last = Shape::line_to(arc.end, arc.end + place_of(0, 50));
    for (const Shape& shape : {first, arc, last}) add(shape, joint);
  }
  void add(const Shape& shape, Joint joint, Tick now = 0) {
    walk.shapes.push_back(shape);
    run.append(shape.path(), joint, now);
  }
  void steps(Tick from, Tick to) {
    for (Tick tick = from; tick <= to; ++tick) walk.step(run, tick);
  }
  /// Returns the last tick; -1 if it does not end.
  Tick to_the_end(Tick after) {
    for (Tick tick = after + 1; tick < after + 200'000; ++tick) {
      walk.step(run, tick);
      if (run.queued() == 0) return tick;
    }
    return -1;
  }
};

const double kCourse_u = 100 + 10 * kPi;

TEST(PathRunChange, OverrideScalesTheTopSpeedWhileItMoves) {
  for (const double factor : {0.5, 2.0, 0.01, 1.3}) {
    Course course;
    course.run.start(0);
    course.steps(1, 301);
    ASSERT_NEAR(course.walk.speed_u_s, 100, 1e-9);
    course.run.set_override(factor, 301);
    const double speed = 100 * factor;
    const auto ramp_ms = static_cast<Tick>(std::abs(speed - 100));
    course.steps(302, 301 + ramp_ms / 2);
    EXPECT_NEAR(course.run.sample(301 + ramp_ms / 2).speed_u_s,
                100 + (factor > 1 ? 1.0 : -1.0) * static_cast<double>(ramp_ms / 2), 1e-6);
    course.steps(302 + ramp_ms / 2, 302 + ramp_ms);
    EXPECT_NEAR(course.run.sample(302 + ramp_ms).speed_u_s, speed, 1e-6) << factor;
    const Tick end = course.to_the_end(302 + ramp_ms);
    // At 100: 5 up and 20 on; the ramp to the new speed; the rest at that, down to 0.
    const double ramp_u = std::abs(speed * speed - 1e4) / 2000;
    const double down_u = speed * speed / 2000;
    const double closed_s =
        0.3 + std::abs(speed - 100) / 1000 + (kCourse_u - 25 - ramp_u - down_u) / speed + speed / 1000;
    EXPECT_NEAR(static_cast<double>(end - 1), 1000 * closed_s, 1) << factor;
    EXPECT_EQ(course.walk.place, course.walk.shapes.back().end);
    EXPECT_LT(course.walk.off_u, 1e-9);
  }
}

TEST(PathRunChange, OverrideZeroHoldsOnThePathUntilItIsRaised) {
  Course course;
  course.run.start(0);
  course.steps(1, 601);  // in the arc: 5 + 50
  course.run.set_override(0, 601);
  course.steps(602, 2000);
  EXPECT_TRUE(course.run.at_rest(2000));
  EXPECT_FALSE(course.run.paused());
  EXPECT_TRUE(course.run.running());
  EXPECT_NEAR(course.walk.along_u, 60, 1e-6);  // 55 and the 5 of the stop
  course.run.set_override(1, 2000);
  const Tick end = course.to_the_end(2000);
  EXPECT_NEAR(static_cast<double>(end - 2001), 1000 * trapezoid_s(kCourse_u - 60, 100, 1000), 1);
  EXPECT_LT(course.walk.off_u, 1e-9);
}

TEST(PathRunChange, OverrideGivenBeforeTheStartHolds) {
  for (const double factor : {0.5, 2.0}) {
    Course course(kJoin);
    course.run.set_override(factor, 0);
    course.run.start(0);
    EXPECT_NEAR(static_cast<double>(course.to_the_end(0) - 1),
                1000 * trapezoid_s(kCourse_u, 100 * factor, 1000), 1);
  }
}

TEST(PathRunChange, ANewTopSpeedIsTakenOnTheWay) {
  Course course;
  course.run.start(0);
  course.steps(1, 301);
  course.run.set_speed(by_slope(40, 1000), 301);
  course.steps(302, 361);
  EXPECT_NEAR(course.run.sample(361).speed_u_s, 40, 1e-6);
  course.run.set_speed(by_slope(120, 1000), 361);
  course.steps(362, 441);
  EXPECT_NEAR(course.run.sample(441).speed_u_s, 120, 1e-6);
  EXPECT_GT(course.to_the_end(441), 0);
  EXPECT_EQ(course.walk.place, course.walk.shapes.back().end);
  EXPECT_LT(course.walk.off_u, 1e-9);
}

TEST(PathRunChange, AccelerationIsChangedAtRestOnly) {
  Course course;
  course.run.set_speed(by_slope(100, 500), 0);
  course.run.set_speed(by_slope(100, 1000), 0);
  course.run.start(0);
  course.steps(1, 50);
  const PathRun before = course.run;
  for (const SpeedLaw& law : {by_slope(100, 1001), by_slope(50, 999)}) {
    try {
      course.run.set_speed(law, 50);
      ADD_FAILURE() << "taken";
    } catch (const BadMotion& refused) {
      EXPECT_EQ(refused.refusal(), Refusal::out_of_range);
    }
    EXPECT_EQ(course.run, before);
  }
  course.run.pause(50);
  course.steps(51, 200);
  course.run.set_speed(by_slope(100, 4000), 200);
  course.run.resume(200);
  const double left = kCourse_u - course.walk.along_u;
  EXPECT_NEAR(static_cast<double>(course.to_the_end(200) - 201), 1000 * trapezoid_s(left, 100, 4000), 1);
}

TEST(PathRunChange, PausedAtAnyTickItStopsAndResumesOnThePath) {
  // Through the arc and across the corner; slopes and positions are compared with the shapes at every tick.
  for (const Joint joint : {kJoin, join_below(89)}) {
    for (Tick at = 0; at < 1500; at += 7) {
      Course course(joint);
      course.run.start(0);
      Tick tick = 0;
      const auto step = [&] {
        course.walk.step(course.run, ++tick);
        ASSERT_LE(std::abs(course.walk.speed_u_s - course.walk.speed_before_u_s), 1000 * 1e-3 + 1e-6) << at;
        ASSERT_LE(course.walk.speed_u_s, 100 + 1e-6) << at;
        ASSERT_GE(course.walk.speed_u_s, -1e-6) << at;
      };
      while (tick < at && course.run.queued() > 0) step();
      const double speed = course.run.sample(tick).speed_u_s;
      const double along = course.walk.along_u;
      course.run.pause(tick);
      for (int i = 0; i < 102; ++i) step();
      ASSERT_TRUE(course.run.at_rest(tick));
      const Point stands = course.walk.place;
      step();
      ASSERT_EQ(course.walk.place, stands);
      ASSERT_LE(course.walk.along_u, along + speed * speed / 2000 + 1e-6) << at;
      course.run.resume(tick);
      while (course.run.queued() > 0 && tick < 5000) step();
      ASSERT_EQ(course.walk.place, course.walk.shapes.back().end) << at;
      ASSERT_LT(course.walk.off_u, 1e-9) << at;
    }
  }
}

TEST(PathRunChange, APauseStopsInTheLengthOfItsRamp) {
  Course course;
  course.run.start(0);
  course.steps(1, 301);
  course.run.pause(301);
  EXPECT_TRUE(course.run.paused());
  course.steps(302, 401);
  EXPECT_TRUE(course.run.at_rest(401));
  EXPECT_NEAR(course.walk.along_u, 25 + 5, 1e-9);
  course.run.resume(401);
  EXPECT_NEAR(static_cast<double>(course.to_the_end(401) - 402),
              1000 * trapezoid_s(kCourse_u - 30, 100, 1000), 1);
}

TEST(PathRunChange, ResumeWhileStillSlowingSpeedsUpAgain) {
  Course course;
  course.run.start(0);
  course.steps(1, 301);
  course.run.pause(301);
  course.steps(302, 341);
  EXPECT_NEAR(course.run.sample(341).speed_u_s, 60, 1e-9);
  course.run.resume(341);
  course.steps(342, 381);
  EXPECT_NEAR(course.run.sample(381).speed_u_s, 100, 1e-9);
  // The dip costs 40^2 / a, at the speed 100.
  EXPECT_NEAR(static_cast<double>(course.to_the_end(381) - 1),
              1000 * (trapezoid_s(kCourse_u, 100, 1000) + 1600.0 / 1000 / 100), 1);
}

TEST(PathRunChange, PausedOverAChainsEndTheNextWaitsForResume) {
  Course course(kStop);
  course.run.start(0);
  Tick tick = 0;
  while (course.walk.done == 0) course.walk.step(course.run, ++tick);
  course.run.pause(tick);  // the arc is at its beginning
  course.steps(tick + 1, tick + 500);
  EXPECT_EQ(course.walk.done, 1U);
  EXPECT_EQ(course.walk.place, course.walk.shapes[0].end);
  course.run.resume(tick + 500);
  EXPECT_GT(course.to_the_end(tick + 500), 0);
  EXPECT_LT(course.walk.off_u, 1e-9);

  // While it decelerates for the end anyway: it gets there, or to within rounding errors.
  Course late(kStop);
  late.run.start(0);
  late.steps(1, 551);
  late.run.pause(551);
  late.steps(552, 1000);
  EXPECT_LE(late.walk.done, 1U);
  EXPECT_NEAR(late.walk.along_u, 50, 1e-9);
  EXPECT_TRUE(late.run.at_rest(1000));
  late.run.resume(1000);
  EXPECT_GT(late.to_the_end(1000), 0);
  EXPECT_EQ(late.walk.place, late.walk.shapes.back().end);
}

TEST(PathRunChange, WhereNothingRunsPauseAndOverrideHoldForWhatComes) {
  PathRun run;
  run.pause(0);
  run.set_override(0, 0);
  run.resume(0);
  run.set_override(1, 0);
  run.step(1);
  EXPECT_EQ(run.step(2), place_of(0, 0));
  run.set_speed(by_slope(100, 1000), 2);
  run.pause(2);
  run.start(2);
  run.append(line(place_of(1, 0), place_of(11, 0)), kStop, 2);
  for (Tick tick = 3; tick < 300; ++tick) EXPECT_EQ(run.step(tick), place_of(1, 0));
  EXPECT_TRUE(run.running());
  run.resume(299);
  EXPECT_EQ(finish(run, 299), 300 + 200);
}

TEST(PathRunChange, CommandsInEveryTickDoNotKeepItFromSettingOut) {
  Course course;
  course.run.start(0);
  Tick tick = 0;
  while (course.run.queued() > 0 && tick < 5000) {
    course.walk.step(course.run, ++tick);
    course.run.set_override(tick % 2 == 0 ? 1.0 : 0.9, tick);
    course.run.set_speed(by_slope(tick % 3 == 0 ? 100 : 90, 1000), tick);
  }
  EXPECT_EQ(course.walk.place, course.walk.shapes.back().end);
  EXPECT_LT(course.walk.off_u, 1e-9);
}

TEST(PathRunChange, AtTheVeryEndOfAnSCurveCommandsAreTakenToo) {
  // Stops that end on a tick except for rounding errors: there the speed is 0 minus a rounding error.
  constexpr std::pair<Tick, Tick> kPausedAndStanding[]{{29, 87}, {99, 297}, {190, 570}, {232, 696}};
  for (const double jerk : {100, 200, 300, 400, 600, 800, 900, 1600, 2300}) {
    for (const auto& [at, later] : kPausedAndStanding) {
      PathRun run;
      run.set_speed({.top_speed_u_s = 10, .up = RampLaw::by_jerk(jerk), .down = RampLaw::by_jerk(jerk)}, 0);
      run.append(line(place_of(0, 0), place_of(1000, 0)), kStop, 0);
      run.start(0);
      Tick tick = 0;
      while (tick < 1 + at) run.step(++tick);
      run.pause(tick);
      while (tick < 1 + at + later) run.step(++tick);
      run.resume(tick);
      run.set_override(0.5, tick);
      ASSERT_GT(finish(run, tick), 0) << jerk << " " << at;
    }
  }
}

TEST(PathRunChange, ALoweredSpeedOutOfReachStillEndsAtTheEndPoint) {
  // A stop that would take longer with the new law than is left: slower is refused during motion, so this is
  // the law that starts to decelerate too late (a chip's) and is cut off.
  SpeedLaw law = by_slope(100, 1000);
  law.slow_down_reckoned_by = RampLaw::by_slope(2000);
  Course course(kJoin, law);
  course.run.start(0);
  course.steps(1, 301);
  course.run.set_override(0.9, 301);
  EXPECT_GT(course.to_the_end(301), 0);
  EXPECT_EQ(course.walk.place, course.walk.shapes.back().end);
  Course paused(kJoin, law);
  paused.run.start(0);
  Tick tick = 0;
  while (paused.walk.along_u < kCourse_u - 3) paused.walk.step(paused.run, ++tick);
  paused.run.pause(tick);  // 5 would be needed
  for (int i = 0; i < 200; ++i) {
    paused.walk.step(paused.run, ++tick);
    ASSERT_LE(paused.run.sample(tick).position_u, kCourse_u + 1e-9);
  }
  EXPECT_EQ(paused.run.queued(), 0U);
  EXPECT_EQ(paused.walk.place, paused.walk.shapes.back().end);
}

}  // namespace path_run_change_test
}  // namespace understudy::motion
