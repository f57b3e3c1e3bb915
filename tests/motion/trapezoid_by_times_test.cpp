#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "motion/bad_motion.h"
#include "tests/motion/exact_trapezoid.h"

namespace understudy::motion {
namespace trapezoid_by_times_test {

// 10 revolutions at 200 RPM with ramps of 50 ms: the manual's own example.
constexpr RegisterMove kManualExample{32'000, 200, 3200, 5, 5};
// "30 s, small distance".
constexpr RegisterMove kThirtySeconds{3200, 3000, 3200, 1500, 1500};

struct Golden {
  Tick t_ms;
  double position;  // as the table prints it
};

void expect_positions(const RegisterMove& move, const std::vector<Golden>& table) {
  const Profile profile = move.plan();
  for (const Golden& row : table) {
    EXPECT_EQ(pulses_at(profile, row.t_ms), static_cast<std::int64_t>(row.position)) << row.t_ms << " ms";
    const double exact = profile.sample(static_cast<double>(row.t_ms) / 1000.0).position_u;
    EXPECT_NEAR(exact, row.position, 0.006) << row.t_ms << " ms";
  }
}

TEST(TrapezoidByTimes, FollowsTheManualsExampleTickByTick) {
  expect_positions(kManualExample, {{1, 0.107},
                                    {10, 10.667},
                                    {25, 66.667},
                                    {50, 266.667},
                                    {51, 277.333},
                                    {100, 800},
                                    {1000, 10400},
                                    {1525, 16000},
                                    {3000, 31733.33},
                                    {3025, 31933.33},
                                    {3049, 31999.89},
                                    {3050, 32000}});
  EXPECT_EQ(end_tick(kManualExample.plan()), 3050);
}

TEST(TrapezoidByTimes, FollowsTheThirtySecondCaseTickByTick) {
  expect_positions(kThirtySeconds, {{100, 0.071},
                                    {1000, 7.111},
                                    {7500, 400},
                                    {15'000, 1600},
                                    {22'500, 2800},
                                    {29'000, 3192.889},
                                    {30'000, 3200}});
  EXPECT_EQ(end_tick(kThirtySeconds.plan()), 30'000);
}

TEST(TrapezoidByTimes, ReadsAppendixAConsistentlyUnlikeThePrintedFormula) {
  struct Case {
    RegisterMove move;
    double top_rpm;
    double duration_s;
  };
  const std::vector<Case> cases = {{{1600, 200, 3200, 5, 5}, 200, 0.2},
                                   {{533, 200, 3200, 5, 5}, 199.875, 0.1},
                                   {{100, 200, 3200, 5, 5}, 37.5, 0.1},
                                   {{3200, 3000, 3200, 1500, 1500}, 4, 30},
                                   {{6400, 600, 3200, 20, 50}, 2400.0 / 7, 0.7}};
  for (const auto& [move, top_rpm, duration_s] : cases) {
    const Profile profile = move.plan();
    const double ramp_s = static_cast<double>(move.acceleration_ms()) / 1000.0;
    EXPECT_NEAR(profile.sample(ramp_s).speed_u_s * 60 / 3200, top_rpm, 1e-9) << move.code();
    EXPECT_NEAR(profile.duration_s, duration_s, 1e-12) << move.code();
    EXPECT_EQ(end_tick(profile), std::llround(duration_s * 1000)) << move.code();
    EXPECT_EQ(pulses_at(profile, end_tick(profile)), move.distance_pulses) << move.code();
    EXPECT_LT(pulses_at(profile, end_tick(profile) - 1), move.distance_pulses) << move.code();
  }
}

TEST(TrapezoidByTimes, TopSpeedIsReachedIfTheDistanceFillsTheRamps) {
  // V = 10 pulses/ms, ramps 100 ms: 500 pulses fill them exactly.
  const auto top_at = [](std::int64_t distance) {
    return RegisterMove{distance, 200, 3000, 3, 7}.plan().sample(0.03).speed_u_s;
  };
  EXPECT_DOUBLE_EQ(top_at(499), 9980);
  EXPECT_DOUBLE_EQ(top_at(500), 10'000);
  EXPECT_DOUBLE_EQ(top_at(501), 10'000);
  EXPECT_EQ(end_tick(RegisterMove{499, 200, 3000, 3, 7}.plan()), 100);
  EXPECT_EQ(end_tick(RegisterMove{500, 200, 3000, 3, 7}.plan()), 100);
  EXPECT_EQ(end_tick(RegisterMove{501, 200, 3000, 3, 7}.plan()), 101);  // 100.1 ms
}

TEST(TrapezoidByTimes, NoDistanceIsNoMove) {
  const Profile profile = RegisterMove{0, 200, 3200, 5, 5}.plan();
  EXPECT_EQ(profile, Profile{});
  EXPECT_EQ(end_tick(profile), 0);
  for (const Tick t : {-1, 0, 1, 1000}) EXPECT_EQ(pulses_at(profile, t), 0);
}

TEST(TrapezoidByTimes, OnePulseComesWithTheEndOfItsRamps) {
  const Profile profile = RegisterMove{1, 200, 3200, 1, 1}.plan();
  EXPECT_EQ(end_tick(profile), 20);
  for (Tick t = 0; t < 20; ++t) EXPECT_EQ(pulses_at(profile, t), 0) << t;
  EXPECT_EQ(pulses_at(profile, 20), 1);
}

TEST(TrapezoidByTimes, TwoPulsesComeAtTheMiddleAndAtTheEnd) {
  const Profile profile = RegisterMove{2, 200, 3200, 1, 1}.plan();
  EXPECT_EQ(end_tick(profile), 20);
  for (Tick t = 0; t <= 20; ++t) EXPECT_EQ(pulses_at(profile, t), t < 10 ? 0 : t < 20 ? 1 : 2) << t;
}

TEST(TrapezoidByTimes, TheFarthestMoveAtTheCappedSpeedIsRightToThePulse) {
  const RegisterMove move{1LL << 32, 32'768, 1LL << 31, 3000, 3000};
  const Profile profile = move.plan();
  // 2^32 / 100 kHz + 30 s = 42979.67296 s
  EXPECT_EQ(end_tick(profile), 42'979'673);
  EXPECT_EQ(pulses_at(profile, 42'979'673), 1LL << 32);
  for (const Tick t : {1, 29'999, 30'000, 30'001, 1'000'000, 12'345'678, 30'000'000, 42'949'672, 42'949'673,
                       42'960'001, 42'979'000, 42'979'672}) {
    const Ratio exact = move.position(t);
    EXPECT_GE(pulses_at(profile, t), exact.floor()) << t;
    EXPECT_LE(pulses_at(profile, t), exact.plus_millionths(3).floor()) << t;
  }
}

TEST(TrapezoidByTimes, TheFarthestMoveAtTheLowestSpeedEndsOnTarget) {
  const RegisterMove move{1LL << 32, 1, 1, 3000, 3000};  // one pulse per minute
  const Profile profile = move.plan();
  EXPECT_EQ(end_tick(profile), ((1LL << 32) * 60 + 30) * 1000);
  EXPECT_EQ(pulses_at(profile, end_tick(profile)), 1LL << 32);
  // One second before the end 1/3600 of a pulse is missing: doubles still distinguish it, at 2^32.
  EXPECT_EQ(pulses_at(profile, end_tick(profile) - 1000), (1LL << 32) - 1);
  // A year into it: (t - TA/2) / 60.
  EXPECT_EQ(pulses_at(profile, 365LL * 86'400'000), (365LL * 86'400 - 15) / 60);
}

TEST(TrapezoidByTimes, OnePulseWithTheLongestRampsTakesAMinute) {
  // 2 pulses per minute is exactly the top speed that ramps of 30 s lead to; 1 per minute lengthens the move.
  const Profile profile = RegisterMove{1, 2, 1, 3000, 3000}.plan();
  EXPECT_EQ(end_tick(profile), 60'000);
  EXPECT_EQ(pulses_at(profile, 59'000), 0);
  EXPECT_EQ(pulses_at(profile, 60'000), 1);
  EXPECT_EQ(end_tick(RegisterMove{1, 1, 1, 3000, 3000}.plan()), 90'000);
}

TEST(TrapezoidByTimes, WhatIsOutsideTheDomainIsRefusedByName) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const SpeedLaw good{.top_speed_u_s = 1, .up = RampLaw::by_time(1), .down = RampLaw::by_time(1)};
  EXPECT_NO_THROW(plan(1, good));

  const auto refused = [](double distance, const SpeedLaw& law, const std::string& quantity) {
    try {
      plan(distance, law);
      ADD_FAILURE() << quantity << " was accepted";
    } catch (const BadMotion& error) {
      EXPECT_NE(std::string(error.what()).find(quantity), std::string::npos) << error.what();
    }
  };
  for (const double distance : {-1.0, -9.3e18, kNan, kInfinity, -kInfinity}) {
    refused(distance, good, "distance");
  }
  for (const double value : {0.0, -0.0, -1.0, kNan, kInfinity, -kInfinity}) {
    // A bad limit is an error whatever the distance: it is not a matter of luck whether it is noticed.
    for (const double distance : {0.0, 1.0, 1e6}) {
      SpeedLaw bad = good;
      bad.top_speed_u_s = value;
      refused(distance, bad, "top speed");
      bad = good;
      bad.up.duration_s = value;
      refused(distance, bad, "ramp: duration");
      bad = good;
      bad.down.duration_s = value;
      refused(distance, bad, "ramp: duration");
    }
    EXPECT_THROW(RampLaw::by_time(value), BadMotion) << value;
  }
}

TEST(TrapezoidByTimes, TheLastPulseOfASlowLongRampIsNotSentEarly) {
  // The missing distance near the end is R*u*u/(2*TD): with slow speeds and 30 s ramps a whole tick is less
  // than a millionth of a pulse.
  struct {
    std::int64_t distance_pulses;
    double top_speed_pps;
    double acceleration_time_s;
    Tick end;
  } const cases[] = {
      {1600, 3200.0 / 60, 0.01, 45'005},
      {3200, 2 * 1600.0 / 60, 0.01, 75'005},
      {1, 3200.0, 30, 60'000},
  };
  for (const auto& c : cases) {
    const Profile profile =
        plan(static_cast<double>(c.distance_pulses), SpeedLaw{.top_speed_u_s = c.top_speed_pps,
                                                              .up = RampLaw::by_time(c.acceleration_time_s),
                                                              .down = RampLaw::by_time(30)});
    EXPECT_EQ(end_tick(profile), c.end) << c.distance_pulses;
    EXPECT_EQ(pulses_at(profile, c.end - 1), c.distance_pulses - 1) << c.distance_pulses;
    EXPECT_EQ(pulses_at(profile, c.end), c.distance_pulses) << c.distance_pulses;
  }
}

}  // namespace trapezoid_by_times_test
}  // namespace understudy::motion
