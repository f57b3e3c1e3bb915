#include "motion/counter.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace counter_test {

using Range = Counter::Range;
__extension__ using Wide = __int128;

constexpr std::array<std::int64_t, 9> kTravels{
    0, 1, -1, 1'000'000'007, -1'000'000'007, INT64_MAX - 9, INT64_MIN + 9, INT64_MAX / 2, INT64_MIN / 2};

struct RangeCase {
  Range range;
  std::int64_t ring_top;
  std::int64_t min;
  std::int64_t max;
};

constexpr std::array<RangeCase, 7> kRanges{{
    {Range::bits32, 0, INT32_MIN, INT32_MAX},
    {Range::bits28, 0, -134'217'728, 134'217'727},
    {Range::ring, 0, 0, 0},
    {Range::ring, 1, 0, 1},
    {Range::ring, 9'999, 0, 9'999},
    {Range::ring, INT32_MAX, 0, INT32_MAX},
    {Range::ring, INT64_MAX - 1, 0, INT64_MAX - 1},
}};

Counter of(const RangeCase& c) { return {.range = c.range, .ring_top = c.ring_top}; }

/// The count of a ring, counted one by one from 0.
std::int64_t counted(std::int64_t ring_top, std::int64_t steps) {
  std::int64_t count = 0;
  for (; steps > 0; --steps) count = count == ring_top ? 0 : count + 1;
  for (; steps < 0; ++steps) count = count == 0 ? ring_top : count - 1;
  return count;
}

/// In 128 bits, where nothing is lost.
std::int64_t wrapped(const RangeCase& c, Wide value) {
  const Wide size = Wide{c.max} - c.min + 1;
  const Wide rest = (value - c.min) % size;
  return static_cast<std::int64_t>((rest < 0 ? rest + size : rest) + c.min);
}

TEST(Counter, KnowsItsEnds) {
  for (const RangeCase& c : kRanges) {
    EXPECT_EQ(of(c).min(), c.min);
    EXPECT_EQ(of(c).max(), c.max);
  }
  EXPECT_EQ(Counter{}.min(), std::nullopt);
  EXPECT_EQ(Counter{}.max(), std::nullopt);
}

TEST(Counter, ComesRoundAtEitherEnd) {
  for (const RangeCase& c : kRanges) {
    for (const std::int64_t travel : kTravels) {
      Counter counter = of(c);
      counter.set(c.max, travel);
      EXPECT_EQ(counter.at(travel), c.max) << travel;
      EXPECT_EQ(counter.at(travel + 1), c.min) << travel;
      counter.set(c.min, travel);
      EXPECT_EQ(counter.at(travel), c.min) << travel;
      EXPECT_EQ(counter.at(travel - 1), c.max) << travel;
    }
  }
}

TEST(Counter, ARingAtZeroGoesToItsTopByAPulseBackwards) {
  Counter counter{.range = Range::ring, .ring_top = 9'999};
  EXPECT_EQ(counter.at(0), 0);
  EXPECT_EQ(counter.at(-1), 9'999);
  EXPECT_EQ(counter.at(9'999), 9'999);
  EXPECT_EQ(counter.at(10'000), 0);
}

TEST(Counter, ARingIsWhatCountingByHandGives) {
  for (const std::int64_t top : {0, 1, 2, 6, 10}) {
    const Counter counter{.range = Range::ring, .ring_top = top};
    for (std::int64_t travel = -40; travel <= 40; ++travel) {
      EXPECT_EQ(counter.at(travel), counted(top, travel)) << top << " at " << travel;
    }
  }
}

TEST(Counter, ALinearOneNeverComesRound) {
  Counter counter;
  EXPECT_EQ(counter.at(INT64_MAX), INT64_MAX);
  EXPECT_EQ(counter.at(INT64_MIN), INT64_MIN);
  counter.set(1'000, INT64_MIN + 1'000);
  EXPECT_EQ(counter.at(INT64_MIN), 0);
  EXPECT_EQ(counter.at(INT64_MIN + 2'000), 2'000);
}

TEST(Counter, SettingWrapsTheNumberIntoTheRange) {
  Counter counter{.range = Range::bits32};
  counter.set(INT64_C(2'147'483'648), 17);
  EXPECT_EQ(counter.at(17), INT32_MIN);
  counter.range = Range::bits28;
  counter.set(INT64_C(1) << 28, 17);
  EXPECT_EQ(counter.at(17), 0);
  counter = {.range = Range::ring, .ring_top = 99};
  counter.set(-1, 17);
  EXPECT_EQ(counter.at(17), 99);
  counter.set(250, 17);
  EXPECT_EQ(counter.at(17), 50);
}

TEST(Counter, IsExactHoweverFarTheTravelIsFromWhereItWasSet) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(20'000); ++i) {
    const RangeCase& c = kRanges[static_cast<std::size_t>(random.between(0, kRanges.size() - 1))];
    const auto any = [&] {
      const std::int64_t near = kTravels[static_cast<std::size_t>(random.between(0, kTravels.size() - 1))];
      return random.between(0, 1) == 0 ? near + random.between(-9, 9) : random.between(INT64_MIN, INT64_MAX);
    };
    const std::int64_t value = any();
    const std::int64_t from = any();
    const std::int64_t to = any();
    Counter counter = of(c);
    counter.set(value, from);
    ASSERT_EQ(counter.at(from), wrapped(c, value)) << "seed " << seed();
    ASSERT_EQ(counter.at(to), wrapped(c, Wide{value} + to - from))
        << "seed " << seed() << ": top " << c.max << ", " << value << " set at " << from << ", asked at "
        << to;
  }
}

TEST(Counter, StepsUntilIsWhatTryingOutGives) {
  for (std::int64_t top = 0; top <= 7; ++top) {
    for (const std::int64_t from : {INT64_C(0), INT64_C(-13), INT64_MAX - 40, INT64_MIN + 40}) {
      Counter counter{.range = Range::ring, .ring_top = top};
      counter.set(3, from);
      for (std::int64_t value = -2; value <= top + 2; ++value) {
        for (const int direction : {+1, -1}) {
          for (std::int64_t travel = from - 9; travel <= from + 9; ++travel) {
            std::optional<std::int64_t> tried;
            for (std::int64_t steps = top + 1; steps >= 1; --steps) {
              if (counter.at(travel + direction * steps) == value) tried = steps;
            }
            ASSERT_EQ(counter.steps_until(value, travel, direction), tried)
                << "top " << top << ", value " << value << ", travel " << travel << ", " << direction;
          }
        }
      }
    }
  }
}

struct StepsCase {
  Range range;
  std::int64_t now;
  std::int64_t value;
  std::optional<std::int64_t> up;
  std::optional<std::int64_t> down;
};

TEST(Counter, StepsUntilAtTheEndsOfARange) {
  constexpr std::int64_t kSize32 = INT64_C(1) << 32;
  constexpr std::int64_t kSize28 = INT64_C(1) << 28;
  const std::array<StepsCase, 14> cases{{
      {Range::bits32, 0, 5, 5, kSize32 - 5},
      {Range::bits32, 5, 5, kSize32, kSize32},
      {Range::bits32, INT32_MAX, INT32_MIN, 1, kSize32 - 1},
      {Range::bits32, INT32_MIN, INT32_MAX, kSize32 - 1, 1},
      {Range::bits32, 0, INT64_C(1) << 31, std::nullopt, std::nullopt},
      {Range::bits28, 134'217'727, -134'217'728, 1, kSize28 - 1},
      {Range::bits28, 0, 134'217'728, std::nullopt, std::nullopt},
      {Range::linear, 0, 5, 5, std::nullopt},
      {Range::linear, 5, 5, std::nullopt, std::nullopt},
      {Range::linear, 5, -5, std::nullopt, 10},
      {Range::linear, 0, INT64_MAX, INT64_MAX, std::nullopt},
      {Range::linear, -1, INT64_MIN, std::nullopt, INT64_MAX},
      {Range::linear, INT64_MIN, INT64_MIN + 3, 3, std::nullopt},
      {Range::linear, INT64_MIN, INT64_MIN, std::nullopt, std::nullopt},
  }};
  for (const StepsCase& c : cases) {
    for (const std::int64_t travel : {INT64_C(0), INT64_C(777), INT64_C(-777)}) {
      Counter counter{.range = c.range};
      counter.set(c.now, travel);
      EXPECT_EQ(counter.steps_until(c.value, travel, +1), c.up) << c.now << " to " << c.value;
      EXPECT_EQ(counter.steps_until(c.value, travel, -1), c.down) << c.now << " to " << c.value;
    }
  }
}

}  // namespace counter_test
}  // namespace understudy::motion
