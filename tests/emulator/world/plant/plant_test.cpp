#include "emulator/world/plant/plant.h"

#include <gtest/gtest.h>

#include <vector>

namespace understudy::emulator::world {
namespace plant_test {

PlantSetup with_travel(std::int64_t first, std::int64_t last) {
  PlantSetup setup;
  setup.travel = PulseSpan{first, last};
  return setup;
}

TEST(PlantAxis, WithoutASetUpGoesAnywhereAndHasNoSwitches) {
  PlantAxis axis;
  axis.move(1'000'000'000'000);
  axis.move(-1);
  EXPECT_EQ(axis.position_pulses(), 999'999'999'999);
  EXPECT_EQ(axis.lost_pulses(), 0);
  EXPECT_FALSE(axis.at_home());
  EXPECT_FALSE(axis.at_lower_limit());
  EXPECT_FALSE(axis.at_upper_limit());
  EXPECT_FALSE(axis.has_encoder());
  EXPECT_EQ(axis.encoder_counts(), 0);
}

TEST(PlantAxis, LosesPulsesAtItsStopsAndTurnsBackAtOnce) {
  struct Step {
    std::int64_t pulses, position, lost;
  };
  PlantAxis axis(with_travel(-5, 10));
  for (const auto& [pulses, position, lost] : std::vector<Step>{{9, 9, 0},
                                                                {1, 10, 0},
                                                                {1, 10, 1},
                                                                {100, 10, 101},
                                                                {0, 10, 101},
                                                                {-1, 9, 101},
                                                                {3, 10, 103},
                                                                {-15, -5, 103},
                                                                {-1, -5, 104},
                                                                {-20, -5, 124},
                                                                {5, 0, 124}}) {
    axis.move(pulses);
    EXPECT_EQ(axis.position_pulses(), position) << pulses;
    EXPECT_EQ(axis.lost_pulses(), lost) << pulses;
  }
}

TEST(PlantAxis, MayHaveNoRoomAtAll) {
  PlantAxis axis(with_travel(0, 0));
  axis.move(3);
  axis.move(-4);
  EXPECT_EQ(axis.position_pulses(), 0);
  EXPECT_EQ(axis.lost_pulses(), 7);
}

TEST(PlantAxis, SwitchesAreOnAtTheirEdgesAndNotOnePulseBefore) {
  PlantSetup setup;
  setup.home = PulseSpan{-3, 4};
  setup.lower_limit = -20;
  setup.upper_limit = 30;
  struct Case {
    std::int64_t position;
    bool lower, home, upper;
  };
  for (const Case& c : std::vector<Case>{{-21, true, false, false},
                                         {-20, true, false, false},
                                         {-19, false, false, false},
                                         {-4, false, false, false},
                                         {-3, false, true, false},
                                         {0, false, true, false},
                                         {4, false, true, false},
                                         {5, false, false, false},
                                         {29, false, false, false},
                                         {30, false, false, true},
                                         {31, false, false, true}}) {
    PlantAxis axis(setup);
    axis.move(c.position);
    EXPECT_EQ(axis.at_lower_limit(), c.lower) << c.position;
    EXPECT_EQ(axis.at_home(), c.home) << c.position;
    EXPECT_EQ(axis.at_upper_limit(), c.upper) << c.position;
  }
}

TEST(PlantAxis, ASwitchOnePulseWideIsOnAtThatPulseAlone) {
  PlantSetup setup;
  setup.home = PulseSpan{7, 7};
  PlantAxis axis(setup);
  for (int position = 0; position < 15; ++position) {
    EXPECT_EQ(axis.at_home(), position == 7) << position;
    axis.move(1);
  }
}

TEST(PlantAxis, AnEncoderIsRoundedTowardsMinusInfinity) {
  struct Case {
    int counts, pulses;  // per revolution
    std::int64_t position, encoder;
  };
  for (const Case& c : std::vector<Case>{
           {1, 4, 0, 0},
           {1, 4, 3, 0},
           {1, 4, 4, 1},
           {1, 4, -1, -1},
           {1, 4, -4, -1},
           {1, 4, -5, -2},
           {4000, 3200, 3, 3},  // 3.75
           {4000, 3200, -3, -4},
           {4000, 3200, -4, -5},
           {3, 2, 1, 1},
           {3, 2, -1, -2},
           {3200, 3200, -77, -77},
           {10'000'000, 1, 1'000'000, 10'000'000'000'000},
           {10'000'000, 3, -1, -3'333'334},
       }) {
    PlantSetup setup;
    setup.encoder_counts_per_revolution = c.counts;
    setup.pulses_per_revolution = c.pulses;
    PlantAxis axis(setup);
    EXPECT_TRUE(axis.has_encoder());
    axis.move(c.position);
    EXPECT_EQ(axis.encoder_counts(), c.encoder) << c.counts << "/" << c.pulses << " at " << c.position;
  }
}

TEST(PlantAxis, ASlowTurnThroughZeroCountsEvenly) {
  PlantSetup setup;
  setup.encoder_counts_per_revolution = 1;
  setup.pulses_per_revolution = 5;
  PlantAxis axis(setup);
  axis.move(-25);
  for (int pulses = 0; pulses <= 50; ++pulses) {
    EXPECT_EQ(axis.encoder_counts(), -5 + pulses / 5)
        << pulses;  // one count every 5 pulses, on both sides of 0
    axis.move(1);
  }
}

TEST(PlantAxis, AnEncoderDoesNotTurnWhereTheMachineStands) {
  PlantSetup setup = with_travel(-10, 10);
  setup.encoder_counts_per_revolution = 2;
  PlantAxis axis(setup);
  axis.move(100);
  EXPECT_EQ(axis.encoder_counts(), 20);
}

}  // namespace plant_test
}  // namespace understudy::emulator::world
