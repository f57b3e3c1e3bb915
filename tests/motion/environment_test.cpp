#include "motion/environment.h"

#include <gtest/gtest.h>

#include <array>

#include "motion/bad_motion.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace environment_test {

using Zone = Environment::Zone;

/// The index counted from the one mark at `index_at`, without a division.
bool index_at(const Environment& environment, std::int64_t travel) {
  if (environment.index_period <= 0) return false;
  if (travel < environment.index_from) return index_at(environment, environment.index_from);
  if (travel > environment.index_to) return index_at(environment, environment.index_to);
  std::int64_t mark = environment.index_at;
  while (mark > travel) mark -= environment.index_period;
  while (mark + environment.index_period <= travel) mark += environment.index_period;
  return travel - mark < environment.index_width;
}

Signals by_hand(const Environment& environment, std::int64_t travel) {
  unsigned on = environment.steady;
  for (std::size_t i = 0; i < environment.zone_count; ++i) {
    const Zone& zone = environment.zones[i];
    if (zone.from <= travel && travel <= zone.to) on |= bit(zone.signal);
  }
  if (index_at(environment, travel)) on |= bit(Signal::index);
  return static_cast<Signals>(on);
}

std::optional<std::int64_t> change_by_hand(const Environment& environment, std::int64_t travel,
                                           int direction) {
  for (std::int64_t steps = 1; steps <= 200; ++steps) {
    if (by_hand(environment, travel + direction * steps) != by_hand(environment, travel)) return steps;
  }
  return std::nullopt;
}

std::string code(const Environment& environment) {
  std::string out = "seed " + std::to_string(seed()) + ": Environment here; ";
  for (std::size_t i = 0; i < environment.zone_count; ++i) {
    out += "here.add(Signal(" + std::to_string(static_cast<int>(environment.zones[i].signal)) + "), " +
           std::to_string(environment.zones[i].from) + ", " + std::to_string(environment.zones[i].to) + "); ";
  }
  return out + "here.index_period = " + std::to_string(environment.index_period) +
         "; here.index_at = " + std::to_string(environment.index_at) +
         "; here.index_width = " + std::to_string(environment.index_width) +
         "; here.index_from = " + std::to_string(environment.index_from) +
         "; here.index_to = " + std::to_string(environment.index_to) + ";";
}

TEST(Environment, AreEmptyAtFirst) {
  const Environment environment;
  for (const std::int64_t travel : {INT64_C(0), INT64_MAX, INT64_MIN}) {
    EXPECT_EQ(environment.at(travel), 0);
    EXPECT_EQ(environment.steps_until_change(travel, +1), std::nullopt);
    EXPECT_EQ(environment.steps_until_change(travel, -1), std::nullopt);
  }
}

TEST(Environment, AZoneIncludesBothItsEnds) {
  Environment environment;
  environment.add(Signal::home, -3, 2);
  EXPECT_EQ(environment.at(-4), 0);
  EXPECT_EQ(environment.at(-3), bit(Signal::home));
  EXPECT_EQ(environment.at(2), bit(Signal::home));
  EXPECT_EQ(environment.at(3), 0);
  EXPECT_EQ(environment.steps_until_change(-5, +1), 2);
  EXPECT_EQ(environment.steps_until_change(-3, +1), 6);
  EXPECT_EQ(environment.steps_until_change(-3, -1), 1);
  EXPECT_EQ(environment.steps_until_change(3, +1), std::nullopt);
  EXPECT_EQ(environment.steps_until_change(3, -1), 1);
  EXPECT_EQ(environment.steps_until_change(-4, -1), std::nullopt);
}

TEST(Environment, AZoneThatEndsBeforeItBeginsIsNowhere) {
  Environment environment;
  environment.add(Signal::home, 3, 2);
  EXPECT_EQ(environment.at(2), 0);
  EXPECT_EQ(environment.at(3), 0);
  EXPECT_EQ(environment.steps_until_change(0, +1), std::nullopt);
}

TEST(Environment, ZonesMayReachToTheEndOfAllNumbers) {
  Environment environment;
  environment.add(Signal::limit_plus, 1'000, INT64_MAX);
  environment.add(Signal::limit_minus, INT64_MIN, -1'000);
  EXPECT_EQ(environment.at(INT64_MAX), bit(Signal::limit_plus));
  EXPECT_EQ(environment.at(INT64_MIN), bit(Signal::limit_minus));
  EXPECT_EQ(environment.steps_until_change(0, +1), 1'000);
  EXPECT_EQ(environment.steps_until_change(0, -1), 1'000);
  EXPECT_EQ(environment.steps_until_change(5'000, -1), 4'001);
  EXPECT_EQ(environment.steps_until_change(-5'000, +1), 4'001);
  for (const std::int64_t travel : {INT64_C(-5'000), INT64_C(0), INT64_C(5'000)}) {
    // The forecast of a change that never comes must be too far away to matter.
    if (const auto up = environment.steps_until_change(travel, +1); travel >= 1'000 && up) {
      EXPECT_GT(*up, INT64_MAX / 2);
    }
    if (const auto down = environment.steps_until_change(travel, -1); travel <= -1'000 && down) {
      EXPECT_GT(*down, INT64_MAX / 2);
    }
  }
}

TEST(Environment, TheIndexComesOnceARevolutionOnEitherSideOfZero) {
  Environment environment;
  environment.index_period = 100;
  environment.index_at = 7;
  environment.index_width = 3;
  for (std::int64_t turn = -3; turn <= 3; ++turn) {
    const std::int64_t mark = 7 + 100 * turn;
    EXPECT_EQ(environment.at(mark - 1), 0) << mark;
    EXPECT_EQ(environment.at(mark), bit(Signal::index)) << mark;
    EXPECT_EQ(environment.at(mark + 2), bit(Signal::index)) << mark;
    EXPECT_EQ(environment.at(mark + 3), 0) << mark;
    EXPECT_EQ(environment.steps_until_change(mark - 1, +1), 1);
    EXPECT_EQ(environment.steps_until_change(mark, +1), 3);
    EXPECT_EQ(environment.steps_until_change(mark + 3, +1), 97);
    EXPECT_EQ(environment.steps_until_change(mark + 3, -1), 1);
    EXPECT_EQ(environment.steps_until_change(mark + 2, -1), 3);
    EXPECT_EQ(environment.steps_until_change(mark - 1, -1), 97);
  }
}

TEST(Environment, AnIndexOfFullWidthStaysOnAndOneOfNoWidthStaysOff) {
  Environment environment;
  environment.index_period = 10;
  environment.index_width = 10;
  EXPECT_EQ(environment.at(-123), bit(Signal::index));
  EXPECT_EQ(environment.steps_until_change(0, +1), std::nullopt);
  environment.index_width = 0;
  EXPECT_EQ(environment.at(-123), 0);
  EXPECT_EQ(environment.steps_until_change(0, -1), std::nullopt);
}

TEST(Environment, TheIndexStaysAsItIsAtTheMachinesStops) {
  // On at 0, 10, 20 ... for two pulses each, and the machine stops at 5 and at 21, where the index is on.
  Environment environment;
  environment.index_period = 10;
  environment.index_width = 2;
  environment.index_from = 5;
  environment.index_to = 21;
  struct Case {
    std::int64_t travel;
    bool is_on;
    std::optional<std::int64_t> up;
    std::optional<std::int64_t> down;
  };
  const Case cases[] = {{-100, false, 110, {}},
                        {0, false, 10, {}},
                        {5, false, 5, {}},
                        {9, false, 1, {}},
                        {10, true, 2, 1},
                        {11, true, 1, 2},
                        {15, false, 5, 4},
                        {19, false, 1, 8},
                        {20, true, {}, 1},
                        {21, true, {}, 2},
                        {22, true, {}, 3},
                        {30, true, {}, 11},
                        {INT64_MAX, true, {}, INT64_MAX - 19},
                        {INT64_MIN, false, {}, {}}};
  for (const Case& each : cases) {
    EXPECT_EQ(environment.at(each.travel), each.is_on ? bit(Signal::index) : 0) << each.travel;
    EXPECT_EQ(environment.steps_until_change(each.travel, +1), each.up) << each.travel;
    EXPECT_EQ(environment.steps_until_change(each.travel, -1), each.down) << each.travel;
  }
}

TEST(Environment, EveryChangeRaisesTheVersion) {
  Environment environment;
  environment.add(Signal::home, 1, 2);
  EXPECT_EQ(environment.version, 1U);
  environment.set_steady(Signal::alarm, true);
  EXPECT_EQ(environment.version, 2U);
  EXPECT_EQ(environment.at(0), bit(Signal::alarm));
  environment.set_steady(Signal::alarm, false);
  EXPECT_EQ(environment.version, 3U);
  EXPECT_EQ(environment.at(0), 0);
}

TEST(Environment, RefuseAThirteenthZoneAndStayAsTheyWere) {
  Environment environment;
  for (int i = 0; i < 12; ++i) environment.add(Signal::mark, 10 * i, 10 * i + 4);
  const Environment before = environment;
  EXPECT_THROW(environment.add(Signal::mark, 100, 110), BadMotion);
  EXPECT_EQ(environment, before);
}

TEST(Environment, AreWhatLookingAtEveryPulseGives) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(400); ++i) {
    Environment environment;
    const std::int64_t zones = random.between(0, 12);
    for (std::int64_t zone = 0; zone < zones; ++zone) {
      const std::int64_t from = random.between(-30, 30);
      environment.add(static_cast<Signal>(random.between(0, kSignals - 1)), from,
                      from + random.between(-2, 15));
    }
    environment.index_period = random.between(0, 1) * random.between(1, 20);
    environment.index_at = random.between(-50, 50);
    environment.index_width = random.between(0, 5);
    for (std::int64_t travel = -60; travel <= 60; ++travel) {
      ASSERT_EQ(environment.at(travel), by_hand(environment, travel))
          << code(environment) << " at " << travel;
      for (const int direction : {+1, -1}) {
        // It may be early, never late: until then nothing changes, and from there on it finds the change.
        const std::optional<std::int64_t> change = change_by_hand(environment, travel, direction);
        std::int64_t steps = 0;
        int looks = 0;
        while (by_hand(environment, travel + direction * steps) == by_hand(environment, travel)) {
          const auto more = environment.steps_until_change(travel + direction * steps, direction);
          if (!more || ++looks > 50) break;
          ASSERT_GE(*more, 1);
          for (std::int64_t between = 1; between < *more; ++between) {
            ASSERT_EQ(by_hand(environment, travel + direction * (steps + between)),
                      by_hand(environment, travel))
                << code(environment) << " at " << travel << ", " << direction;
          }
          steps += *more;
        }
        if (change) {
          ASSERT_EQ(steps, *change) << code(environment) << " at " << travel << ", " << direction;
        }
      }
    }
  }
}

TEST(Environment, OfOneSignalEachAreToldToThePulse) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(300); ++i) {
    Environment environment;
    for (const Signal signal : {Signal::limit_plus, Signal::limit_minus, Signal::home, Signal::mark}) {
      const std::int64_t from = random.between(-30, 30);
      environment.add(signal, from, from + random.between(0, 20));
    }
    // Changes that cancel out do not occur: each signal has one zone.
    for (std::int64_t travel = -60; travel <= 60; ++travel) {
      ASSERT_EQ(environment.steps_until_change(travel, +1), change_by_hand(environment, travel, +1))
          << code(environment) << travel;
      ASSERT_EQ(environment.steps_until_change(travel, -1), change_by_hand(environment, travel, -1))
          << code(environment) << travel;
    }
  }
}

TEST(Environment, SlackKeepsASignalOnUntilItIsFarEnough) {
  for (const bool outside : {false, true}) {
    Environment environment;
    if (outside) {
      environment.add_outside(Signal::home, 10, 19, 3);
    } else {
      environment.add(Signal::home, 10, 19, 3);
    }
    // A switch that comes on from 10 to 19, and releases 3 outside; the signal is the switch or its inverse.
    bool is_on = false;
    Signals seen = environment.at(0);
    const auto go = [&](std::int64_t to, std::int64_t from) {
      for (std::int64_t at = from; at != to; at += to > from ? 1 : -1) {
        const int direction = to > from ? +1 : -1;
        const std::int64_t next = at + direction;
        is_on = is_on ? next >= 7 && next <= 22 : next >= 10 && next <= 19;
        const Signals now = environment.at(next, seen);
        EXPECT_EQ(now == bit(Signal::home), is_on != outside) << next << " going " << direction;
        if (now != seen) {
          EXPECT_EQ(environment.steps_until_change(at, direction), 1) << at << " going " << direction;
        }
        seen = now;
      }
    };
    go(12, 0);
    go(8, 12);
    go(21, 8);
    go(30, 21);
    go(20, 30);
    go(15, 20);
    go(-5, 15);
    EXPECT_EQ(environment.at(INT64_MIN) == bit(Signal::home), outside);
    EXPECT_EQ(environment.at(INT64_MAX) == bit(Signal::home), outside);
  }
}

}  // namespace environment_test
}  // namespace understudy::motion
