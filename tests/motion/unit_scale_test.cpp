#include "motion/unit_scale.h"

#include <gtest/gtest.h>

#include <array>

#include "motion/bad_motion.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace unit_scale_test {

__extension__ using Wide = __int128;

struct ScaleCase {
  std::int64_t multiplier;
  std::int64_t divider;
  std::int64_t units;
  std::int64_t pulses;
};

TEST(UnitScale, GivesTheManualsExamples) {
  constexpr std::array<ScaleCase, 4> kExamples{{
      // SUPER-40NC, CMX and CDV
      {8, 5, 1'000, 1'600},
      {8, 5, 5'000, 8'000},
      {1, 36, 90'000, 2'500},
      {600, 242, 2'420, 6'000},
  }};
  for (const ScaleCase& c : kExamples) {
    const UnitScale scale = UnitScale::of(c.multiplier, c.divider);
    EXPECT_EQ(scale.to_pulses(c.units), c.pulses);
    EXPECT_EQ(scale.to_pulses(-c.units), -c.pulses);
    EXPECT_EQ(scale.to_units(c.pulses), c.units);
    EXPECT_EQ(scale.to_units(-c.pulses), -c.units);
  }
}

TEST(UnitScale, MayCutPulsesOff) {
  struct Row {
    std::int64_t multiplier, divider, units, pulses;
  };
  for (const auto& [multiplier, divider, units, pulses] :
       {Row{8, 5, 3, 4}, Row{8, 5, 5, 8}, Row{1, 36, 35, 0}, Row{1, 36, 36, 1},
        Row{2, 3, INT64_MAX / 2, INT64_MAX / 2 / 3 * 2}}) {
    UnitScale scale = UnitScale::of(multiplier, divider);
    scale.truncates = true;
    EXPECT_EQ(scale.to_pulses(units), pulses);
    EXPECT_EQ(scale.to_pulses(-units), -pulses);
  }
  UnitScale scale = UnitScale::of(INT32_MAX, 1);
  scale.truncates = true;
  EXPECT_EQ(scale.to_pulses(INT64_MAX), std::nullopt);
  EXPECT_EQ(scale.to_units(INT32_MAX / 2 + 1), 1) << "the displayed value is the nearest one";
}

TEST(UnitScale, RoundsHalfAwayFromZero) {
  constexpr std::array<ScaleCase, 12> kCases{{
      {1, 2, 0, 0},
      {1, 2, 1, 1},
      {1, 2, 2, 1},
      {1, 2, 3, 2},
      {1, 3, 1, 0},
      {1, 3, 2, 1},
      {3, 2, 1, 2},
      {1, 10, 4, 0},
      {1, 10, 5, 1},
      {2, 5, 1, 0},
      {3, 5, 1, 1},
      {1, INT32_MAX, INT32_MAX / 2, 0},
  }};
  for (const ScaleCase& c : kCases) {
    const UnitScale scale = UnitScale::of(c.multiplier, c.divider);
    EXPECT_EQ(scale.to_pulses(c.units), c.pulses) << c.units << " * " << c.multiplier << " / " << c.divider;
    EXPECT_EQ(scale.to_pulses(-c.units), -c.pulses)
        << -c.units << " * " << c.multiplier << " / " << c.divider;
  }
}

TEST(UnitScale, IsTheNearestWholeNumberWhateverTheFactors) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(20'000); ++i) {
    const UnitScale scale = UnitScale::of(random.of_any_size(1, INT32_MAX), random.of_any_size(1, INT32_MAX));
    const std::int64_t units = random.of_any_size(1, INT64_C(1) << 40) * (random.between(0, 1) == 0 ? 1 : -1);
    const Wide exact = Wide{units} * scale.multiplier;  // times 1 / divider
    const std::optional<std::int64_t> pulses = scale.to_pulses(units);
    const auto report = [&] {
      return "seed " + std::to_string(seed()) + ": UnitScale::of(" + std::to_string(scale.multiplier) + ", " +
             std::to_string(scale.divider) + ").to_pulses(" + std::to_string(units) + ")";
    };
    if (!pulses) {
      const Wide size = exact < 0 ? -exact : exact;
      ASSERT_GE(size / scale.divider, Wide{INT64_MAX} - 1) << report();
      continue;
    }
    // Twice the rest is at most the divider, and if it is equal, the pulses are the ones further away.
    const Wide rest = exact - Wide{*pulses} * scale.divider;
    const Wide size = rest < 0 ? -rest : rest;
    ASSERT_LE(2 * size, scale.divider) << report();
    if (2 * size == scale.divider) {
      ASSERT_EQ(rest<0, exact> 0) << report();
    }
  }
}

TEST(UnitScale, WhatDoesNotFitIsNothing) {
  constexpr std::int64_t kMax = INT32_MAX;
  EXPECT_EQ(UnitScale::of(kMax, 1).to_pulses(INT64_MAX), std::nullopt);
  EXPECT_EQ(UnitScale::of(kMax, 1).to_pulses(INT64_MIN), std::nullopt);
  EXPECT_EQ(UnitScale::of(1, kMax).to_units(INT64_MAX), std::nullopt);
  EXPECT_EQ(UnitScale::of(2, 1).to_pulses(INT64_MAX / 2), INT64_MAX - 1);
  EXPECT_EQ(UnitScale::of(2, 1).to_pulses(INT64_MAX / 2 + 1), std::nullopt);
  EXPECT_EQ(UnitScale::of(2, 1).to_pulses(INT64_MIN / 2), INT64_MIN);
  EXPECT_EQ(UnitScale::of(2, 1).to_pulses(INT64_MIN / 2 - 1), std::nullopt);
  EXPECT_EQ(UnitScale::of(1, 1).to_pulses(INT64_MIN), INT64_MIN);
  EXPECT_EQ(UnitScale::of(kMax, kMax).to_pulses(INT64_MAX), INT64_MAX);
}

TEST(UnitScale, DemandsFactorsOfOneToTheGreatestOf32Bits) {
  constexpr std::array<std::int64_t, 6> kBad{0, -1, INT64_C(1) << 31, INT32_MIN, INT64_MAX, INT64_MIN};
  for (const std::int64_t bad : kBad) {
    EXPECT_THROW(UnitScale::of(bad, 1), BadMotion) << bad;
    EXPECT_THROW(UnitScale::of(1, bad), BadMotion) << bad;
  }
  EXPECT_EQ(UnitScale::of(INT32_MAX, 1).multiplier, INT32_MAX);
  EXPECT_EQ(UnitScale::of(1, INT32_MAX).divider, INT32_MAX);
  EXPECT_DOUBLE_EQ(UnitScale::of(8, 5).pulses_per_unit(), 1.6);
}

}  // namespace unit_scale_test
}  // namespace understudy::motion
