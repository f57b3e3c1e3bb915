// Open streams: segments keep the speed until one is marked as the last, and a stream without further
// segments ends at speed.
#include <gtest/gtest.h>

#include <cmath>

#include "motion/state.h"
#include "tests/motion/coordinated_bench.h"
#include "tests/motion/path_shapes.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace path_run_open_test {

Path piece(double from, double to) { return Shape::line_to(place_of(from, 0), place_of(to, 0)).path(); }

/// Along the x axis, 10,000 u/s at 100,000 u/s2 from 1,000 u/s, as a separate law.
SpeedLaw law() {
  return {.start_speed_u_s = 1'000,
          .top_speed_u_s = 10'000,
          .up = RampLaw::by_slope(1e5),
          .down = RampLaw::by_slope(1e5)};
}

/// From rest, never decelerating.
double place_after(double t_s) {
  const double rising_s = 9'000 / 1e5;
  if (t_s <= rising_s) return 1'000 * t_s + 0.5 * 1e5 * t_s * t_s;
  return 495 + 10'000 * (t_s - rising_s);  // (1000 + 10000) / 2 * 0.09
}

TEST(PathRunOpen, WhatRunsDryEndsAtSpeedOnItsEnd) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(300); ++i) {
    PathRun run;
    run.set_speed(law(), 0);
    run.set_open(true, 0);
    double end = 0;
    const std::int64_t pieces = random.between(1, 12);
    for (std::int64_t n = 0; n < pieces; ++n) {
      const auto length = static_cast<double>(random.of_any_size(1, 400));
      run.append(piece(end, end + length), {.rule = Joint::Rule::join}, 0);
      end += length;
    }
    run.start(0);
    Tick tick = 1;
    for (; run.queued() > 0 && tick < 10'000; ++tick) {
      const double x = run.step(tick)[0];
      ASSERT_NEAR(x, std::min(end, place_after(static_cast<double>(tick - 1) / 1000)), 1e-9) << tick;
    }
    EXPECT_TRUE(run.ran_dry());
    EXPECT_FALSE(run.running());
    // In the first tick that is not before the closed form's end.
    const auto at = [](Tick t) { return place_after(static_cast<double>(t - 1) / 1000); };
    EXPECT_GE(at(tick - 1), end - 1e-6);
    EXPECT_LT(at(tick - 2), end);
    EXPECT_EQ(run.step(tick), place_of(end, 0));
  }
}

TEST(PathRunOpen, ALatePathBeginsFromRestAgain) {
  PathRun run;
  run.set_speed(law(), 0);
  run.set_open(true, 0);
  run.append(piece(0, 800), {.rule = Joint::Rule::join}, 0);
  run.start(0);
  Tick tick = 0;
  while (run.queued() > 0) run.step(++tick);
  EXPECT_TRUE(run.ran_dry());
  for (int i = 0; i < 7; ++i) EXPECT_EQ(run.step(++tick), place_of(800, 0));
  run.append(piece(800, 2000), {.rule = Joint::Rule::join}, tick);
  EXPECT_FALSE(run.ran_dry());
  const Tick late = tick + 1;
  while (run.queued() > 0) {
    const double x = run.step(++tick)[0];
    ASSERT_NEAR(x, std::min(2000.0, 800 + place_after(static_cast<double>(tick - late) / 1000)), 1e-9);
  }
  EXPECT_TRUE(run.ran_dry());
}

TEST(PathRunOpen, OneAheadIsEnoughToKeepTheSpeed) {
  // A stream of short lines, each given when the previous one starts, runs like one long line.
  PathRun run;
  run.set_speed(law(), 0);
  run.set_open(true, 0);
  double end = 0;
  const auto add = [&](Tick now) {
    run.append(piece(end, end + 25), {.rule = Joint::Rule::join}, now);
    end += 25;
  };
  add(0);
  add(0);
  run.start(0);
  for (Tick tick = 1; tick <= 1000; ++tick) {
    ASSERT_NEAR(run.step(tick)[0], place_after(static_cast<double>(tick - 1) / 1000), 1e-7) << tick;
    while (run.queued() < 2) add(tick);
  }
  EXPECT_FALSE(run.ran_dry());
}

TEST(PathRunOpen, TheLastPathSlowsDownOverThoseBefore) {
  // 495 u are needed to decelerate. A segment that is too short for that ends at its present speed.
  for (const double last : {700.0, 495.0, 200.0, 10.0}) {
    PathRun run;
    run.set_speed(law(), 0);
    run.set_open(true, 0);
    run.append(piece(0, 2000), {.rule = Joint::Rule::join}, 0);
    run.start(0);
    Tick tick = 0;
    double x = 0;
    while (x < 1990) x = run.step(++tick)[0];
    run.append(piece(2000, 2000 + last), {.rule = Joint::Rule::join}, tick);
    run.set_open(false, tick);
    const double begin = x;
    const double room = 2000 + last - begin;
    double speed = 10'000;
    while (run.queued() > 0) {
      speed = run.sample(tick).speed_u_s;
      run.step(++tick);
    }
    EXPECT_FALSE(run.ran_dry());
    EXPECT_EQ(run.step(tick + 1), place_of(2000 + last, 0));
    const double min = std::sqrt(std::max(1'000.0 * 1'000, 1e8 - 2 * 1e5 * room));
    EXPECT_LE(speed, min + 1e5 * 0.001 + 1e-6) << last;  // within the last tick
    EXPECT_GE(speed, min - 1e-6) << last;
  }
}

TEST(PathRunOpen, APathThatStopsBehindItIsSlowedDownFor) {
  PathRun run;
  run.set_speed(law(), 0);
  run.set_open(true, 0);
  run.append(piece(0, 2000), {.rule = Joint::Rule::join}, 0);
  run.start(0);
  for (Tick tick = 1; tick <= 50; ++tick) run.step(tick);
  run.append(piece(2000, 2100), {.rule = Joint::Rule::stop}, 50);
  Tick tick = 50;
  double speed = 0;
  while (run.queued() > 1) {
    speed = run.sample(tick).speed_u_s;
    run.step(++tick);
  }
  EXPECT_LE(speed, 1'101);
  EXPECT_FALSE(run.ran_dry());
  while (run.queued() > 0) run.step(++tick);
  EXPECT_TRUE(run.ran_dry());
}

TEST(PathRunOpen, PausesAndResumesOnThePath) {
  PathRun run;
  run.set_speed(law(), 0);
  run.set_open(true, 0);
  run.append(piece(0, 5000), {.rule = Joint::Rule::join}, 0);
  run.start(0);
  Tick tick = 0;
  for (; tick < 200; ++tick) run.step(tick + 1);
  run.pause(tick);
  for (; !run.at_rest(tick); ++tick) run.step(tick + 1);
  const Point stood = run.step(tick);
  run.resume(tick);
  const Tick begin = tick + 1;
  while (run.queued() > 0) {
    const double x = run.step(++tick)[0];
    ASSERT_NEAR(x, std::min(5000.0, stood[0] + place_after(static_cast<double>(tick - begin) / 1000)), 1e-6);
  }
  EXPECT_TRUE(run.ran_dry());
}

TEST(PathRunOpen, IsAValueThatIsSavedAndContinues) {
  PathRun run;
  run.set_speed(law(), 0);
  run.set_open(true, 0);
  run.append(piece(0, 900), {.rule = Joint::Rule::join}, 0);
  run.start(0);
  for (Tick tick = 1; tick <= 40; ++tick) run.step(tick);
  PathRun other;
  restore(other, save(run));
  EXPECT_EQ(other, run);
  EXPECT_TRUE(other.open());
  for (Tick tick = 41; tick <= 200; ++tick) ASSERT_EQ(other.step(tick), run.step(tick));
  EXPECT_TRUE(other.ran_dry());
}

TEST(PathRunOpen, AGroupThatRunsDryLetsItsAxesGo) {
  Bench bench(law());
  bench.add(piece(0, 900));
  bench.group.run.set_open(true, 0);
  ASSERT_EQ(bench.begin(), Cause::none);
  EXPECT_GT(bench.to_the_end(1000), 0);
  EXPECT_TRUE(bench.group.run.ran_dry());
  EXPECT_EQ(bench.group.cause, Cause::arrived);
  EXPECT_EQ(bench.axes[0].travel_pulses, 900);
  EXPECT_FALSE(bench.axes[0].moving());
}

}  // namespace path_run_open_test
}  // namespace understudy::motion
