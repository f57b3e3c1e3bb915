// Switches with hysteresis: where they turn on and off, from either side.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {
namespace plant_switch_test {

enum Switch : int { kHome = 1, kLower = 2, kUpper = 4 };

int switches_of(const PlantAxis& axis) {
  return (axis.at_home() ? kHome : 0) | (axis.at_lower_limit() ? kLower : 0) |
         (axis.at_upper_limit() ? kUpper : 0);
}

struct Place {
  std::int64_t position;
  int on;
};

/// Goes to each position in one step, in the order given.
void expect_course(const PlantSetup& setup, const std::vector<Place>& places) {
  PlantAxis axis(setup);
  for (const auto& [position, on] : places) {
    axis.move(position - axis.position_pulses());
    EXPECT_EQ(switches_of(axis), on) << "at " << position;
  }
}

TEST(PlantHysteresis, OfAHomeSwitchIsOnBothSides) {
  PlantSetup setup;
  setup.home = PulseSpan{100, 119};
  setup.home_hysteresis_pulses = 5;
  expect_course(setup, {{0, 0},
                        {95, 0},
                        {99, 0},  // it comes on at its edge ...
                        {100, kHome},
                        {99, kHome},
                        {95, kHome},
                        {94, 0},  // ... and releases 5 pulses
                                  // outside, that is one more
                        {95, 0},
                        {99, 0},
                        {100, kHome},
                        {119, kHome},
                        {120, kHome},
                        {124, kHome},
                        {125, 0},
                        {124, 0},
                        {120, 0},
                        {119, kHome},
                        {124, kHome},
                        {95, kHome},  // across the switch, still held
                        {94, 0},
                        {200, 0}});  // a step over it is not detected
}

TEST(PlantHysteresis, OfLimitSwitchesIsTowardsTheMiddle) {
  PlantSetup setup;
  setup.lower_limit = -50;
  setup.upper_limit = 50;
  setup.limit_hysteresis_pulses = 10;
  expect_course(setup, {{-49, 0},
                        {-50, kLower},
                        {-1000, kLower},
                        {-50, kLower},
                        {-49, kLower},
                        {-40, kLower},
                        {-39, 0},
                        {-49, 0},
                        {49, 0},
                        {50, kUpper},
                        {1000, kUpper},
                        {40, kUpper},
                        {39, 0},
                        {49, 0},
                        {50, kUpper}});
}

TEST(PlantHysteresis, WiderThanTheWayBetweenTheLimitsHoldsBoth) {
  PlantSetup setup;
  setup.lower_limit = -2;
  setup.upper_limit = 2;
  setup.limit_hysteresis_pulses = 10;
  expect_course(setup, {{0, 0},
                        {2, kUpper},
                        {-2, kUpper | kLower},
                        {2, kUpper | kLower},
                        {8, kUpper | kLower},
                        {9, kUpper},
                        {-8, kUpper | kLower},
                        {-9, kLower}});
}

TEST(PlantHysteresis, ASwitchOnePulseWideHoldsItsHysteresis) {
  PlantSetup setup;
  setup.home = PulseSpan{7, 7};
  setup.home_hysteresis_pulses = 1;
  expect_course(setup, {{6, 0}, {7, kHome}, {8, kHome}, {9, 0}, {8, 0}, {7, kHome}, {6, kHome}, {5, 0}});
}

TEST(PlantHysteresis, OfNothingIsTheBareSwitch) {
  PlantSetup setup;
  setup.home = PulseSpan{-1, 1};
  expect_course(setup, {{0, kHome}, {1, kHome}, {2, 0}, {1, kHome}, {-1, kHome}, {-2, 0}, {-1, kHome}});
}

TEST(PlantHysteresis, AMachineAtRestAtPowerUpIsOnOnlyWhereTheSwitchIs) {
  PlantSetup setup;
  setup.home = PulseSpan{1, 10};
  setup.upper_limit = 1;
  setup.home_hysteresis_pulses = setup.limit_hysteresis_pulses = 5;
  EXPECT_EQ(switches_of(PlantAxis(setup)), 0);
  setup.home = PulseSpan{0, 10};
  setup.upper_limit = 0;
  EXPECT_EQ(switches_of(PlantAxis(setup)), kHome | kUpper);
}

TEST(PlantHysteresis, APulseAtATimeIsSeenByTheLastEdgeThatWasCrossed) {
  // The oracle records where the machine has been: a switch is on if the machine was on it since it was last
  // farther away than the hysteresis.
  std::mt19937_64 random(20'240'601);
  const auto between = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  for (int round = 0; round < 200; ++round) {
    PlantSetup setup;
    const std::int64_t first = between(-20, 20);
    const std::int64_t last = first + between(0, 6);
    const std::int64_t hysteresis = between(0, 8);
    setup.home = PulseSpan{first, last};
    setup.home_hysteresis_pulses = hysteresis;
    PlantAxis axis(setup);
    std::vector<std::int64_t> been{0};
    for (int step = 0; step < 300; ++step) {
      axis.move(between(0, 3) == 0 ? between(-9, 9) : between(-1, 1));
      been.push_back(axis.position_pulses());
      bool expected = false;
      for (auto at = been.rbegin(); at != been.rend(); ++at) {
        if (*at < first - hysteresis || *at > last + hysteresis) break;
        if (*at >= first && *at <= last) expected = true;
      }
      ASSERT_EQ(axis.at_home(), expected) << "round " << round << " at " << axis.position_pulses();
    }
  }
}

}  // namespace plant_switch_test
}  // namespace understudy::emulator::world
