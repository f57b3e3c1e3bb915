// How simulated time follows a wall clock that the test controls.
#include "emulator/serve/loop/pacer.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace understudy::emulator::serve {
namespace pacer_test {

using namespace std::chrono_literals;

constexpr WallTime kStart = 5000s;  // any moment of the wall clock

Pacer at_factor(double factor) { return {Speed{.factor = factor}, kStart}; }

TEST(ParseSpeed, KnowsWordsAndFactors) {
  EXPECT_EQ(parse_speed("free")->kind, Speed::Kind::free);
  EXPECT_EQ(parse_speed("manual")->kind, Speed::Kind::manual);
  const std::vector<std::pair<std::string_view, double>> factors = {
      {"real", 1}, {"1", 1}, {"10x", 10}, {"2.5", 2.5}, {"0.25x", 0.25}, {"10000", 10000}, {"1e3", 1000}};
  for (const auto& [text, factor] : factors) {
    const auto speed = parse_speed(text);
    ASSERT_TRUE(speed) << text;
    EXPECT_EQ(speed->kind, Speed::Kind::factor) << text;
    EXPECT_EQ(speed->factor, factor) << text;
  }
}

TEST(ParseSpeed, RefusesEverythingElse) {
  for (const char* text :
       {"",         "x",    "0",  "0x", "0.0",  "-1",  "+2",  "10001", "1e9",   "nan",   "-nan", "inf",
        "infinity", "Real", " 1", "1 ", "10xx", "x10", "1,5", "0x10",  "1e400", "real ", "10 x", "ten"}) {
    EXPECT_FALSE(parse_speed(text)) << "'" << text << "'";
  }
}

TEST(FormatSpeed, IsReadBackAsTheSameSpeed) {
  for (const char* text : {"real", "free", "manual", "10x", "2.5x", "0.25x", "0.1x", "10000x"}) {
    EXPECT_EQ(format_speed(*parse_speed(text)), text);
  }
}

TEST(Pacer, SimulatedTimeFollowsTheWallClockByTheFactor) {
  for (const auto& [factor, sim] : std::vector<std::pair<double, SimTime>>{
           {1, 8s}, {2, 16s}, {0.5, 4s}, {10, 80s}, {10000, 80000s}, {0.125, 1s}}) {
    const Pacer pacer = at_factor(factor);
    EXPECT_EQ(pacer.target(kStart), 0s) << factor;
    EXPECT_EQ(pacer.target(kStart + 8s), sim) << factor;
    EXPECT_FALSE(pacer.standing()) << factor;
  }
}

TEST(Pacer, WakesAtTheMomentOfWhatIsDueAndNeverBefore) {
  for (const double factor : {1.0, 3.0, 0.3, 7.7, 1000.0, 10000.0, 0.001}) {
    const Pacer pacer = at_factor(factor);
    for (const SimTime due : {1ms, 999ms, 1000ms, 3050ms, 86'400'000ms}) {
      const auto wake = pacer.wall_time_of(due);
      ASSERT_TRUE(wake) << factor;
      EXPECT_GE(pacer.target(*wake), due) << factor << ": woken too early";
      const double exact = static_cast<double>(due.count()) / factor;
      EXPECT_NEAR(static_cast<double>((*wake - kStart).count()), exact, 2 + exact * 1e-12) << factor;
    }
  }
}

TEST(Pacer, AMomentTooFarAwayForTheWallClockIsNotInThePast) {
  for (const double factor : {1e-3, 1e-7, 1e-9, 1e-15, 1e-300}) {
    const Pacer pacer = at_factor(factor);
    const auto wake = pacer.wall_time_of(24h * 365);
    EXPECT_GT(wake.value_or(WallTime::max()), kStart) << factor;
  }
}

TEST(Pacer, FreeIsBoundedAndOwesNothing) {
  Pacer free({.kind = Speed::Kind::free}, kStart);
  EXPECT_FALSE(free.standing());
  EXPECT_EQ(free.target(kStart + 1ms), 10s) << "10,000 times real time";
  EXPECT_EQ(free.wall_time_of(10s), kStart + 1ms + 1ns);
  EXPECT_EQ(free.target(kStart + 24h * 365 * 20), kHorizon) << "simulated time is limited";
  EXPECT_EQ(free.woke(kStart, kStart + 5s), 0s) << "work that it could not do is not a stall";
  EXPECT_EQ(free.slips(), 0U);
}

TEST(Pacer, ManualHasNoMomentsAndStands) {
  Pacer manual({.kind = Speed::Kind::manual}, kStart);
  EXPECT_FALSE(manual.wall_time_of(1s));
  EXPECT_TRUE(manual.standing());
  EXPECT_EQ(manual.target(kStart + 100h), 0s);
  manual.moved_to(250ms, kStart + 3s);
  EXPECT_EQ(manual.target(kStart + 100h), 250ms);
}

TEST(Pacer, APauseLeavesNoTraceInSimulatedTime) {
  for (const double factor : {1.0, 4.0, 0.5}) {
    Pacer pacer = at_factor(factor);
    pacer.pause(kStart + 2s);
    const SimTime at_pause{static_cast<std::int64_t>(2e9 * factor)};
    EXPECT_TRUE(pacer.paused());
    EXPECT_TRUE(pacer.standing());
    EXPECT_EQ(pacer.target(kStart + 50s), at_pause);
    EXPECT_FALSE(pacer.wall_time_of(at_pause + 1ms));
    pacer.pause(kStart + 60s);  // again: nothing new
    EXPECT_EQ(pacer.target(kStart + 70s), at_pause);
    pacer.resume(kStart + 100s);
    EXPECT_FALSE(pacer.paused());
    EXPECT_EQ(pacer.target(kStart + 100s), at_pause);
    EXPECT_EQ(pacer.target(kStart + 102s), 2 * at_pause);
    pacer.resume(kStart + 150s);  // again: nothing new
    EXPECT_EQ(pacer.target(kStart + 102s), 2 * at_pause);
  }
}

TEST(Pacer, WhatIsAdvancedDuringAPauseCountsFromThereOn) {
  Pacer pacer = at_factor(1);
  pacer.pause(kStart + 1s);
  pacer.moved_to(10s, kStart + 2s);
  EXPECT_EQ(pacer.target(kStart + 5s), 10s);
  pacer.resume(kStart + 5s);
  EXPECT_EQ(pacer.target(kStart + 6s), 11s);
}

TEST(Pacer, AManualClockStillStandsAfterPauseAndResume) {
  Pacer pacer({.kind = Speed::Kind::manual}, kStart);
  pacer.pause(kStart + 1s);
  EXPECT_TRUE(pacer.paused());
  pacer.resume(kStart + 2s);
  EXPECT_FALSE(pacer.paused());
  EXPECT_TRUE(pacer.standing());
  EXPECT_EQ(pacer.target(kStart + 9s), 0s);
}

TEST(Pacer, AStallBeyondOneSecondIsLeftOut) {
  struct Case {
    double factor;
    WallTime late, left_out;
  };
  for (const Case& c : std::vector<Case>{{1, 0s, 0s},
                                         {1, 999ms, 0s},
                                         {1, 1s, 0s},
                                         {1, 1s + 1ns, 1ns},
                                         {1, 4s, 3s},
                                         {10, 4s, 3s},
                                         {0.5, 61s, 60s}}) {
    Pacer pacer = at_factor(c.factor);
    const WallTime planned = kStart + 10s;
    EXPECT_EQ(pacer.woke(planned, planned + c.late), c.left_out) << c.late.count();
    EXPECT_EQ(pacer.slips(), c.left_out > 0s ? 1u : 0u);
    const WallTime counted = 10s + c.late - c.left_out;
    EXPECT_NEAR(static_cast<double>(pacer.target(planned + c.late).count()),
                static_cast<double>(counted.count()) * c.factor, 1.0)
        << c.late.count();
  }
}

TEST(Pacer, AStandingClockDoesNotStall) {
  Pacer pacer({.kind = Speed::Kind::manual}, kStart);
  EXPECT_EQ(pacer.woke(kStart, kStart + 60s), 0s);
  EXPECT_EQ(pacer.slips(), 0u);
}

TEST(Pacer, BeingWokenEarlyByAHostIsNotLateness) {
  Pacer pacer = at_factor(1);
  EXPECT_EQ(pacer.woke(kStart + 10ms, kStart + 3ms), 0s);
  EXPECT_EQ(pacer.lateness().count(), 0u);
  pacer.woke(kStart + 10ms, kStart + 10ms + 40us);
  EXPECT_EQ(pacer.lateness().count(), 1u);
  EXPECT_EQ(pacer.lateness().max(), 40us);
  // A wake-up just in time counts as one with no delay.
  pacer.woke(kStart + 10ms, kStart + 10ms);
  EXPECT_EQ(pacer.lateness().count(), 2u);
}

TEST(Lateness, OfNothingIsZero) {
  const Lateness lateness;
  EXPECT_EQ(lateness.percentile(50), 0s);
  EXPECT_EQ(lateness.max(), 0s);
}

TEST(Lateness, PercentilesSplitTheRecordedOnes) {
  Lateness lateness;
  std::vector<int> shuffled;
  for (int i = 1; i <= 1000; ++i) shuffled.push_back(i * 7 % 1009);
  for (const int us : shuffled) lateness.record(WallTime{us * 1000});
  std::sort(shuffled.begin(), shuffled.end());
  for (const int percent : {0, 1, 25, 50, 90, 99, 100}) {
    const auto us = lateness.percentile(percent).count() / 1000;
    const auto not_above =
        std::count_if(shuffled.begin(), shuffled.end(), [&](int one) { return one <= us; });
    const auto below = std::count_if(shuffled.begin(), shuffled.end(), [&](int one) { return one < us; });
    EXPECT_GE(not_above, percent * 10) << percent;
    EXPECT_LE(below, percent * 10) << percent;
  }
  EXPECT_EQ(lateness.percentile(100).count() / 1000, shuffled.back());
}

TEST(Lateness, PercentilesAreExactHoweverFarApartTheTimesAre) {
  Lateness lateness;
  std::vector<WallTime> all;
  std::uint64_t state = 7;
  for (int i = 0; i < 4'000; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    // From nanoseconds to minutes, some of them several times.
    const auto ns = static_cast<std::int64_t>(i % 5 == 0 ? i % 40 : (state >> 24U) >> (state >> 58U) % 40);
    all.emplace_back(ns);
    lateness.record(all.back());
  }
  std::sort(all.begin(), all.end());
  for (int percent = 0; percent <= 100; ++percent) {
    const std::size_t rank = std::min(all.size() - 1, all.size() * static_cast<std::size_t>(percent) / 100);
    EXPECT_EQ(lateness.percentile(percent), all[rank]) << percent;
  }
}

TEST(Lateness, ForgetsAllButTheLast4096ExceptTheGreatest) {
  Lateness lateness;
  lateness.record(9s);
  for (int i = 0; i < 4095; ++i) lateness.record(1us);
  EXPECT_EQ(lateness.percentile(100), 9s);
  lateness.record(1us);
  EXPECT_EQ(lateness.percentile(100), 1us);
  EXPECT_EQ(lateness.max(), 9s);
  EXPECT_EQ(lateness.count(), 4097u);
}

}  // namespace pacer_test
}  // namespace understudy::emulator::serve
