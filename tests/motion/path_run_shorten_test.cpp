// A run that drops the paths that it has not reached, and ends where it can.
#include <gtest/gtest.h>

#include "tests/motion/path_shapes.h"

namespace understudy::motion {
namespace path_run_shorten_test {

/// Five joined lines of 20 at 100 u/s and 1000 u/s^2: 5 u to accelerate or stop.
PathRun five() {
  PathRun run;
  run.set_speed(by_slope(100, 1000), 0);
  for (int i = 0; i < 5; ++i) run.append(line(place_of(20 * i, 0), place_of(20 * i + 20, 0)), kJoin, 0);
  run.start(0);
  return run;
}

TEST(PathRunShorten, EndsAtTheFirstBorderAtWhichItCanStop) {
  struct Row {
    int after_ms;
    std::size_t kept;
    double end;
    Tick ms;  // of the whole: end / 100 + 0.1 s
  };
  // 15 are done after 200 ms: just enough. A millisecond later 15.1 are done, and 20.1 is the earliest.
  for (const Row& row : {Row{0, 1, 20, 300}, Row{150, 1, 20, 300}, Row{200, 1, 20, 300}, Row{201, 2, 40, 500},
                         Row{260, 1, 40, 500}, Row{1030, 1, 100, 1100}}) {
    PathRun run = five();
    Tick tick = 0;
    while (tick < row.after_ms + 1) run.step(++tick);
    EXPECT_EQ(run.shorten(tick), row.kept) << row.after_ms;
    EXPECT_EQ(run.queued(), row.kept) << row.after_ms;
    while (run.queued() > 0 && tick < 5000) run.step(++tick);
    EXPECT_EQ(tick - 1, row.ms) << row.after_ms;
    EXPECT_EQ(run.step(tick + 1), place_of(row.end, 0)) << row.after_ms;
  }
}

TEST(PathRunShorten, PausedItStillEndsThere) {
  PathRun run = five();
  Tick tick = 0;
  while (tick < 241) run.step(++tick);
  run.pause(tick);
  while (tick < 300) run.step(++tick);  // 19 + 1.77 done, in the second line
  EXPECT_EQ(run.shorten(tick), 1U);
  while (tick < 500) run.step(++tick);
  EXPECT_TRUE(run.at_rest(tick));
  EXPECT_DOUBLE_EQ(run.step(++tick)[0], 24);
  run.resume(tick);
  while (run.queued() > 0 && tick < 5000) run.step(++tick);
  EXPECT_EQ(run.step(tick + 1), place_of(40, 0));
}

TEST(PathRunShorten, WhatIsNotJoinedOrNotBegunIsForgotten) {
  PathRun apart;
  apart.set_speed(by_slope(100, 1000), 0);
  for (int i = 0; i < 3; ++i) apart.append(line(place_of(20 * i, 0), place_of(20 * i + 20, 0)), kStop, 0);
  PathRun waiting = apart;
  EXPECT_EQ(waiting.shorten(0), 0U);
  EXPECT_EQ(waiting.queued(), 0U);
  apart.start(0);
  for (Tick tick = 1; tick <= 250; ++tick) apart.step(tick);
  EXPECT_EQ(apart.shorten(250), 1U);
  Tick tick = 250;
  while (apart.queued() > 0 && tick < 5000) apart.step(++tick);
  EXPECT_EQ(apart.step(tick + 1), place_of(20, 0));
}

}  // namespace path_run_shorten_test
}  // namespace understudy::motion
