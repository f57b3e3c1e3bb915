#include "motion/following.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "motion/bad_motion.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace following_test {

__extension__ using Wide = __int128;

std::int64_t floor_of(Wide value, std::int64_t by) {
  const Wide quotient = value / by;
  return static_cast<std::int64_t>(value % by < 0 ? quotient - 1 : quotient);
}

/// Feeds this many counts, and steps one period.
std::int64_t period(Follower& follower, std::int64_t counts) {
  follower.feed(counts);
  std::int64_t pulses = 0;
  for (std::int32_t tick = 0; tick < follower.period_ticks; ++tick) pulses += follower.step();
  return pulses;
}

TEST(Following, ByOneToOneEveryCountIsAPulse) {
  Follower follower;
  for (const std::int64_t counts : {0, 1, -1, 17, -1000, 0, 3}) {
    follower.feed(counts);
    EXPECT_EQ(follower.step(), counts);
  }
}

struct RatioCase {
  std::int64_t numerator;
  std::int64_t denominator;
};

constexpr std::array<RatioCase, 10> kRatios{{
    {1, 1},
    {-1, 1},
    {0, 1},
    {3, 7},
    {-5, 3},
    {1, 1000},
    {1000, 1},
    {INT32_MAX, 2},
    {1, INT32_MAX},
    {-INT32_MAX, INT32_MAX - 1},
}};

TEST(Following, LosesNoRemainderOverAMillionCounts) {
  RandomMoves random(seed());
  for (const RatioCase& ratio : kRatios) {
    for (const std::int32_t ticks : {1, 5, 7}) {
      Follower follower{
          .numerator = ratio.numerator, .denominator = ratio.denominator, .period_ticks = ticks};
      follower.check();
      Wide fed = 0;
      std::int64_t sent = 0;
      for (std::int64_t done = 0; done < 1'000'000;) {
        const std::int64_t counts = random.between(-300, 2'000);
        done += std::abs(counts);
        fed += counts;
        sent += period(follower, counts);
        ASSERT_EQ(sent, floor_of(fed * ratio.numerator, ratio.denominator))
            << "seed " << seed() << ": " << ratio.numerator << " / " << ratio.denominator << " a period of "
            << ticks << " after " << static_cast<std::int64_t>(fed);
      }
    }
  }
}

TEST(Following, ThereAndBackAgainIsNowhere) {
  for (const RatioCase& ratio : kRatios) {
    Follower follower{.numerator = ratio.numerator, .denominator = ratio.denominator};
    std::int64_t sent = 0;
    for (int i = 0; i < 1000; ++i) sent += period(follower, 7);
    for (int i = 0; i < 7000; ++i) sent += period(follower, -1);
    EXPECT_EQ(sent, 0) << ratio.numerator << " / " << ratio.denominator;
  }
}

TEST(Following, PulsesOfAPeriodComeOutEvenly) {
  // Simple2-R3's 200 Hz: five ticks.
  Follower follower{.period_ticks = 5};
  struct EvenCase {
    std::int64_t counts;
    std::array<std::int64_t, 5> pulses;
  };
  constexpr std::array<EvenCase, 5> kCases{{
      {10, {2, 2, 2, 2, 2}},
      {1, {0, 0, 0, 0, 1}},
      {7, {1, 1, 2, 1, 2}},
      {-10, {-2, -2, -2, -2, -2}},
      {0, {0, 0, 0, 0, 0}},
  }};
  for (const EvenCase& c : kCases) {
    follower.feed(c.counts);
    for (const std::int64_t pulses : c.pulses) EXPECT_EQ(follower.step(), pulses) << c.counts;
  }
}

TEST(Following, WhatIsFedWithinAPeriodComesOutInTheNext) {
  Follower follower{.period_ticks = 5};
  EXPECT_EQ(follower.step(), 0);
  follower.feed(10);
  for (int tick = 1; tick < 5; ++tick) EXPECT_EQ(follower.step(), 0);
  for (int tick = 0; tick < 5; ++tick) EXPECT_EQ(follower.step(), 2);
  EXPECT_EQ(follower.step(), 0);
}

TEST(Following, NoFasterThanItsTopSpeedAndOnTheAverageExactlyThat) {
  for (const std::int64_t top_pps : {1, 3, 333, 1000, 1001, 123'456}) {
    for (const std::int32_t ticks : {1, 5}) {
      for (const int sign : {+1, -1}) {
        Follower follower{.period_ticks = ticks, .top_speed_pps = top_pps};
        std::int64_t sent = 0;
        for (std::int64_t i = 1; i <= 2'000; ++i) {
          sent += period(follower, sign * 1'000'000);
          ASSERT_EQ(sent, sign * (top_pps * ticks * i / 1000)) << top_pps << " " << ticks << " " << i;
        }
      }
    }
  }
}

TEST(Following, WhatTheTopSpeedCutsOffIsForgotten) {
  Follower follower{.top_speed_pps = 10'000};
  EXPECT_EQ(period(follower, 35), 10);
  EXPECT_EQ(period(follower, 0), 0);
  EXPECT_EQ(period(follower, 5), 5);
  EXPECT_EQ(follower.behind_pulses, 0);
}

TEST(Following, OrIsSentLaterWhereItCatchesUp) {
  Follower follower{.top_speed_pps = 10'000, .catches_up = true};
  EXPECT_EQ(period(follower, 35), 10);
  EXPECT_EQ(period(follower, 0), 10);
  EXPECT_FALSE(follower.quiet());
  EXPECT_EQ(period(follower, -2), 10);
  EXPECT_EQ(period(follower, 0), 3);
  EXPECT_EQ(period(follower, 0), 0);
  EXPECT_TRUE(follower.quiet());
}

TEST(Following, CatchesUpWithEveryPulseHoweverItWasFed) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(200); ++i) {
    Follower follower{.numerator = random.between(-20, 20),
                      .denominator = random.between(1, 20),
                      .period_ticks = static_cast<std::int32_t>(random.between(1, 8)),
                      .top_speed_pps = random.of_any_size(20'000, 1'000'000),
                      .catches_up = true};
    Wide fed = 0;
    std::int64_t sent = 0;
    for (int feeds = 0; feeds < 100; ++feeds) {
      const std::int64_t counts = random.between(-5'000, 5'000);
      fed += counts;
      sent += period(follower, counts);
    }
    for (int more = 0; more < 200'000 && !follower.quiet(); ++more) sent += period(follower, 0);
    ASSERT_EQ(sent, floor_of(fed * follower.numerator, follower.denominator)) << "seed " << seed();
  }
}

TEST(Following, ItsSpeedChangesByNoMoreThanTheSlope) {
  RandomMoves random(seed());
  for (const bool catches_up : {false, true}) {
    for (const std::int64_t slope_pps : {1, 999, 1000, 2'500, 40'000}) {
      Follower follower{.period_ticks = 5, .slope_pps = slope_pps, .catches_up = catches_up};
      const std::int64_t max = std::max<std::int64_t>(1, slope_pps * 5 / 1000);
      std::int64_t before = 0;
      for (int i = 0; i < 2'000; ++i) {
        const std::int64_t now = period(follower, random.between(-500, 500) * random.between(0, 1));
        ASSERT_LE(std::abs(now - before), max) << slope_pps << " in period " << i;
        before = now;
      }
    }
  }
}

TEST(Following, CatchesUpAlongTheSlopeWithoutGoingTooFar) {
  for (const std::int64_t top_pps : {0, 20'000}) {
    for (const std::int64_t slope_pps : {1'000, 2'500, 40'000}) {
      for (const std::int64_t counts : {1, 7, 100, 1'000, 123'457, -5'000}) {
        Follower follower{
            .period_ticks = 5, .top_speed_pps = top_pps, .slope_pps = slope_pps, .catches_up = true};
        const std::int64_t max = slope_pps * 5 / 1000;
        std::int64_t sent = period(follower, counts);
        std::int64_t before = sent;
        for (int i = 0; i < 20'000 && !follower.quiet(); ++i) {
          const std::int64_t now = period(follower, 0);
          ASSERT_LE(std::abs(now - before), max) << counts << " in period " << i;
          ASSERT_GE(now * (counts < 0 ? -1 : 1), 0) << counts << " turns back in period " << i;
          sent += now;
          before = now;
        }
        EXPECT_TRUE(follower.quiet()) << counts << " by " << slope_pps;
        EXPECT_EQ(sent, counts) << "by " << slope_pps;
      }
    }
  }
}

TEST(Following, SpeedsUpAndSlowsDownAlongTheSlope) {
  Follower follower{.period_ticks = 1, .slope_pps = 2'000};  // two more pulses per tick in each tick
  const std::array<std::int64_t, 10> fed{7, 7, 7, 7, 7, 0, 0, 0, 0, 0};
  const std::array<std::int64_t, 10> sent{2, 4, 6, 7, 7, 5, 3, 1, 0, 0};
  for (std::size_t i = 0; i < fed.size(); ++i) EXPECT_EQ(period(follower, fed[i]), sent[i]) << i;
}

TEST(Following, TheSlopeCountsByThePeriod) {
  Follower follower{.period_ticks = 5, .slope_pps = 2'000};  // ten more pulses in each period of 5 ms
  const std::array<std::int64_t, 10> fed{35, 35, 35, 35, 35, 0, 0, 0, 0, 0};
  const std::array<std::int64_t, 10> sent{10, 20, 30, 35, 35, 25, 15, 5, 0, 0};
  for (std::size_t i = 0; i < fed.size(); ++i) EXPECT_EQ(period(follower, fed[i]), sent[i]) << i;
}

TEST(Following, IsQuietWhenNothingIsToCome) {
  Follower follower{.period_ticks = 5};
  EXPECT_TRUE(follower.quiet());
  follower.feed(3);
  EXPECT_FALSE(follower.quiet());
  for (int tick = 0; tick < 4; ++tick) {
    follower.step();
    EXPECT_FALSE(follower.quiet());
  }
  period(follower, 0);
  for (int tick = 0; tick < 5; ++tick) follower.step();
  EXPECT_EQ(follower.gathered, 0);
}

TEST(Following, HugeCountsSaturateInsteadOfWrapping) {
  for (const bool catches_up : {false, true}) {
    Follower follower{.numerator = INT32_MAX, .period_ticks = 7, .catches_up = catches_up};
    for (int i = 0; i < 5; ++i) EXPECT_GE(period(follower, INT64_MAX / 8), INT64_MAX / 5);
    for (int i = 0; i < 20; ++i) period(follower, INT64_MIN / 8);
    EXPECT_LE(period(follower, INT64_MIN / 8), INT64_MIN / 5);
  }
}

TEST(Following, RefusesWhatIsOutOfRange) {
  const std::vector<Follower> bad{
      {.denominator = 0},
      {.denominator = -1},
      {.denominator = INT64_C(1) << 31},
      {.numerator = INT64_C(1) << 31},
      {.numerator = INT32_MIN},
      {.period_ticks = 0},
      {.period_ticks = 1001},
      {.top_speed_pps = -1},
      {.top_speed_pps = INT64_C(1) << 31},
      {.slope_pps = -1},
      {.slope_pps = INT64_C(1) << 31},
  };
  for (std::size_t i = 0; i < bad.size(); ++i) EXPECT_THROW(bad[i].check(), BadMotion) << i;
  const Follower widest{.numerator = -INT32_MAX,
                        .denominator = INT32_MAX,
                        .period_ticks = 1000,
                        .top_speed_pps = INT32_MAX,
                        .slope_pps = INT32_MAX};
  EXPECT_NO_THROW(widest.check());
}

}  // namespace following_test
}  // namespace understudy::motion
