// Paths that arrive while others run: streams, early and late joints.
#include <gtest/gtest.h>

#include "motion/bad_motion.h"
#include "tests/motion/path_shapes.h"

namespace understudy::motion {
namespace path_run_stream_test {

TEST(PathRunStream, ThousandsOfShortPathsKeepSpeedDuringRefills) {
  // A circle in chords of 0.02, refilled every fourth tick; at 1 per second and tick 5 chords pass in 0.1.
  constexpr int kPaths = 20'001;
  constexpr double kChord = 0.02;
  constexpr double kSpeed = 50;
  const double turn = 2 * std::numbers::pi / 700;
  PathRun run;
  run.set_speed(by_slope(kSpeed, 500), 0);
  Walk walk;
  Point here = place_of(0, 0);
  const auto refill = [&](Tick now) {
    while (!run.full() && static_cast<int>(walk.shapes.size()) < kPaths) {
      const double angle = turn * static_cast<double>(walk.shapes.size());
      const Point next = here + kChord * place_of(std::cos(angle), std::sin(angle));
      walk.shapes.push_back(Shape::line_to(here, next));
      run.append(walk.shapes.back().path(), kJoin, now);
      here = next;
    }
  };
  refill(0);
  run.start(0);
  const double length = kPaths * kChord;
  const double closed_ms = 1000 * trapezoid_s(length, kSpeed, 500);
  Tick tick = 0;
  while (run.queued() > 0 && tick < 20'000) {
    walk.step(run, ++tick);
    if (tick % 4 == 0) refill(tick);
    const double left = length - walk.along_u;
    // A full queue of 0.64 is less than the 2.5 that a stop from top speed takes: the speed is what can be
    // stopped within the queue's length, but never dips.
    if (tick > 100 && left > 1) {
      ASSERT_GT(walk.speed_u_s, 23) << tick;
    }
    ASSERT_LE(walk.speed_u_s, kSpeed * (1 + 1e-9)) << tick;
  }
  EXPECT_EQ(walk.done, walk.shapes.size());
  EXPECT_EQ(walk.place, here);
  EXPECT_LT(walk.off_u, 1e-9);
  EXPECT_GT(static_cast<double>(tick), closed_ms);
}

TEST(PathRunStream, AQueueLongEnoughToStopInKeepsTheTopSpeed) {
  constexpr int kPaths = 3000;
  PathRun run;
  run.set_speed(by_slope(50, 500), 0);  // stops in 2.5; the queue holds 6.4, and 0.2 pass in four ticks
  Walk walk;
  const auto refill = [&](Tick now) {
    while (!run.full() && static_cast<int>(walk.shapes.size()) < kPaths) {
      const double x = 0.2 * static_cast<double>(walk.shapes.size());
      walk.shapes.push_back(Shape::line_to(place_of(x, 0), place_of(x + 0.2, 0)));
      run.append(walk.shapes.back().path(), join_below(1), now);
    }
  };
  refill(0);
  run.start(0);
  Tick tick = 0;
  while (run.queued() > 0 && tick < 20'000) {
    walk.step(run, ++tick);
    if (tick % 4 == 0) refill(tick);
    if (tick > 102 && walk.along_u < kPaths * 0.2 - 2.6) {
      ASSERT_NEAR(walk.speed_u_s, 50, 1e-7) << tick;
    }
  }
  EXPECT_NEAR(static_cast<double>(tick - 1), 1000 * trapezoid_s(kPaths * 0.2, 50, 500), 1);
  EXPECT_EQ(walk.place, walk.shapes.back().end);
}

struct Late {
  Tick appended_at;  // the second path of 100, while the first runs (decelerating from tick 1001 on)
  PathRun::LateJoint how;
  Joint joint;
};

/// Two lines of 100 at speed 100 and slope 1000: ticks until the end, and the minimum speed between the
/// ramps.
std::pair<Tick, double> two_lines(const Late& late) {
  PathRun run;
  run.set_late_joint(late.how);
  run.set_speed(by_slope(100, 1000), 0);
  const Path first = line(place_of(0, 0), place_of(100, 0));
  const Path second = line(place_of(100, 0), place_of(200, 0));
  run.append(first, kStop, 0);
  run.start(0);
  double min = 100;
  for (Tick tick = 1;; ++tick) {
    const Point place = run.step(tick);
    if (tick == late.appended_at) run.append(second, late.joint, tick);
    if (place[0] > 10 && place[0] < 190) min = std::min(min, run.sample(tick).speed_u_s);
    if (run.queued() == 0 && tick >= late.appended_at) {
      EXPECT_EQ(place, second.end);
      return {tick - 1, min};
    }
    if (tick > 5000) return {-1, 0};
  }
}

TEST(PathRunStream, AnEarlyJointLengthensTheChainWithoutADipInSpeed) {
  for (const auto how : {PathRun::LateJoint::speed_up_again, PathRun::LateJoint::from_rest}) {
    for (const Tick at : {1, 50, 100, 500, 1000}) {
      const auto [ms, min] = two_lines({at, how, kJoin});
      EXPECT_EQ(ms, 2100) << at;
      EXPECT_NEAR(min, 100, 1e-6) << at;
    }
  }
}

TEST(PathRunStream, ALateJointSpeedsUpAgainOrBeginsFromRest) {
  // Deceleration starts 1000 ms after the beginning; t ms later the speed is 100 - t.
  for (const Tick t : {1, 2, 50, 99}) {
    const auto [ms, min] = two_lines({1001 + t, PathRun::LateJoint::speed_up_again, kJoin});
    const double low = 100 - static_cast<double>(t);
    EXPECT_NEAR(min, low, 1e-6) << t;
    // A dip from 100 to `low` and back costs (100 - low)^2 / a, of the speed 100.
    EXPECT_NEAR(static_cast<double>(ms), 2100 + (100 - low) * (100 - low) / 1000 / 100 * 1000, 1) << t;
    const auto [ms_from_rest, min_from_rest] = two_lines({1001 + t, PathRun::LateJoint::from_rest, kJoin});
    EXPECT_EQ(ms_from_rest, 2200) << t;
    EXPECT_LT(min_from_rest, 1.1) << t;
  }
}

TEST(PathRunStream, AStopAtTheJointAlwaysTakesTwoWholeMoves) {
  for (const Tick at : {1, 500, 1050, 1100}) {
    EXPECT_EQ(two_lines({at, PathRun::LateJoint::speed_up_again, kStop}).first, 2200) << at;
  }
}

TEST(PathRunStream, WhatIsAppendedAfterTheEndBeginsInTheNextTick) {
  const auto [ms, min] = two_lines({1500, PathRun::LateJoint::speed_up_again, kJoin});
  EXPECT_EQ(ms, 1500 + 1100);
  PathRun run;
  run.set_speed(by_slope(100, 1000), 0);
  run.start(0);  // with nothing to run
  EXPECT_FALSE(run.running());
  run.step(1);
  run.append(line(place_of(0, 0), place_of(10, 0)), kJoin, 1);
  EXPECT_TRUE(run.running());
  EXPECT_EQ(finish(run, 1), 202);
}

TEST(PathRunStream, WhatWasNotJoinedInTimeIsNotJoinedLater) {
  // The second arrives too late; the third is joined to the second.
  PathRun run;
  run.set_late_joint(PathRun::LateJoint::from_rest);
  run.set_speed(by_slope(100, 1000), 0);
  run.append(line(place_of(0, 0), place_of(10, 0)), kStop, 0);
  run.start(0);
  for (Tick tick = 1; tick <= 150; ++tick) run.step(tick);
  run.append(line(place_of(10, 0), place_of(20, 0)), kJoin, 150);
  run.append(line(place_of(20, 0), place_of(40, 0)), kJoin, 150);
  EXPECT_EQ(finish(run, 150), 201 + static_cast<Tick>(1000 * trapezoid_s(30, 100, 1000)));
}

TEST(PathRunStream, AbandonForgetsEverythingAtOnceAndAnotherRunBegins) {
  PathRun run;
  run.set_speed(by_slope(100, 1000), 0);
  run.append(line(place_of(0, 0), place_of(100, 0)), kStop, 0);
  run.append(line(place_of(100, 0), place_of(200, 0)), kStop, 0);
  run.start(0);
  Point place;
  for (Tick tick = 1; tick <= 300; ++tick) place = run.step(tick);
  run.abandon();
  EXPECT_EQ(run.queued(), 0U);
  EXPECT_FALSE(run.running());
  EXPECT_TRUE(run.at_rest(300));
  EXPECT_EQ(run.step(301), place);
  run.append(line(place, place_of(0, 0)), kJoin, 301);
  EXPECT_EQ(run.step(302), place);  // not started
  run.start(302);
  EXPECT_GT(finish(run, 302), 302);
  EXPECT_EQ(run.step(5000), place_of(0, 0));
}

}  // namespace path_run_stream_test
}  // namespace understudy::motion
