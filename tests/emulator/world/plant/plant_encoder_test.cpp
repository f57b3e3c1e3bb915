// Encoders: counts compared with the closed form, over random walks, ratios and both directions.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {
namespace plant_encoder_test {

PlantSetup with_encoder(int counts, int pulses, bool reversed) {
  PlantSetup setup;
  setup.encoder_counts_per_revolution = counts;
  setup.pulses_per_revolution = pulses;
  setup.encoder_reversed = reversed;
  return setup;
}

/// floor(pulses * counts / per) the long way: the largest whole number that is not above it.
std::int64_t floor_of(std::int64_t position, std::int64_t counts, std::int64_t per) {
  auto guess = static_cast<std::int64_t>(
      std::floor(static_cast<double>(position) * (static_cast<double>(counts) / static_cast<double>(per))));
  while (guess * per > position * counts) --guess;
  while ((guess + 1) * per <= position * counts) ++guess;
  return guess;
}

TEST(PlantEncoder, IsTheFloorOfTheRatioOverRandomWalks) {
  std::mt19937_64 random(71);
  const auto between = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  for (int round = 0; round < 300; ++round) {
    const auto counts = static_cast<int>(between(0, 2) == 0 ? between(1, 9) : between(1, 20'000));
    const auto pulses = static_cast<int>(between(0, 2) == 0 ? between(1, 9) : between(1, 20'000));
    PlantAxis axis(with_encoder(counts, pulses, false));
    PlantAxis reversed(with_encoder(counts, pulses, true));
    std::int64_t position = 0;
    for (int step = 0; step < 200; ++step) {
      const std::int64_t steps = between(0, 3) == 0 ? between(-100'000, 100'000) : between(-3, 3);
      position += steps;
      axis.move(steps);
      reversed.move(steps);
      ASSERT_EQ(axis.encoder_counts(), floor_of(position, counts, pulses))
          << counts << "/" << pulses << " at " << position;
      ASSERT_EQ(reversed.encoder_counts(), -axis.encoder_counts());
    }
  }
}

TEST(PlantEncoder, ReversedCountsTheSameEdgesTheOtherWay) {
  // 4 counts for 3 pulses: at -2 pulses -2.67 is -3, at 1 pulse 1.33 is 1.
  struct Case {
    std::int64_t position, counts;
  };
  for (const auto& [position, counts] :
       std::vector<Case>{{-3, 4}, {-2, 3}, {-1, 2}, {0, 0}, {1, -1}, {2, -2}, {3, -4}}) {
    PlantAxis axis(with_encoder(4, 3, true));
    axis.move(position);
    EXPECT_EQ(axis.encoder_counts(), counts) << position;
  }
}

TEST(PlantEncoder, ComesBackToItsCountWhereverItHasBeen) {
  PlantAxis axis(with_encoder(4000, 3201, false));
  std::mt19937_64 random(5);
  for (int i = 0; i < 1000; ++i) {
    const auto away = static_cast<std::int64_t>(random() % 2'000'000) - 1'000'000;
    const std::int64_t before = axis.encoder_counts();
    axis.move(away);
    axis.move(-away);
    ASSERT_EQ(axis.encoder_counts(), before);
  }
}

TEST(PlantEncoder, OfTheFinestKindIsExactAsFarAsAMachineGoes) {
  // 1e15 pulses are the limit of a machine without stops, 1e7 counts per pulse the finest encoder: 1e22
  // exceeds 64 bits and wraps at 62. 1e22 mod 2^62 = 1e22 - 2168 * 2^62 = 1864712049423024128, below 2^61.
  PlantAxis axis(with_encoder(10'000'000, 1, false));
  PlantAxis reversed(with_encoder(10'000'000, 1, true));
  for (PlantAxis* one : {&axis, &reversed}) one->move(200'000'000'000);
  EXPECT_EQ(axis.encoder_counts(), 2'000'000'000'000'000'000);
  EXPECT_EQ(reversed.encoder_counts(), -2'000'000'000'000'000'000);
  for (PlantAxis* one : {&axis, &reversed}) one->move(2'000'000'000'000'000);
  EXPECT_EQ(axis.position_pulses(), 1'000'000'000'000'000);
  EXPECT_EQ(axis.encoder_counts(), 1'864'712'049'423'024'128);
  EXPECT_EQ(reversed.encoder_counts(), -1'864'712'049'423'024'128);
  for (PlantAxis* one : {&axis, &reversed}) one->move(-2'000'000'000'000'000);
  EXPECT_EQ(axis.encoder_counts(), -1'864'712'049'423'024'128);
  EXPECT_EQ(reversed.encoder_counts(), 1'864'712'049'423'024'128);
}

}  // namespace plant_encoder_test
}  // namespace understudy::emulator::world
