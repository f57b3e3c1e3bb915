// Faults of a machine: stalled, losing steps, pushed by force.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {
namespace plant_fault_test {

class Machine {
 public:
  explicit Machine(const PlantSetup& setup = {}) : axis_(setup) {}
  PlantAxis& axis() { return axis_; }
  MachineFaults& faults() { return axis_.faults(); }
  void step(std::int64_t pulses) { axis_.step(++tick_, pulses, {}); }
  std::int64_t position() const { return axis_.position_pulses(); }
  std::int64_t lost() const { return axis_.lost_pulses(); }

 private:
  PlantAxis axis_;
  Tick tick_ = 0;
};

TEST(PlantStall, LosesEveryPulseUntilItIsOver) {
  Machine machine;
  machine.step(10);
  machine.faults().stalled = true;
  machine.step(7);
  machine.step(-3);
  machine.step(0);
  EXPECT_EQ(machine.position(), 10);
  EXPECT_EQ(machine.lost(), 10);
  machine.faults().stalled = false;
  machine.step(-4);
  EXPECT_EQ(machine.position(), 6);
  EXPECT_EQ(machine.lost(), 10);
}

TEST(PlantStall, StandsOnItsSwitchWithItsEncoder) {
  PlantSetup setup;
  setup.home = PulseSpan{0, 10};
  setup.encoder_counts_per_revolution = 3;
  Machine machine(setup);
  machine.step(10);
  machine.faults().stalled = true;
  machine.step(100);
  EXPECT_TRUE(machine.axis().at_home());
  EXPECT_EQ(machine.axis().encoder_counts(), 30);
}

TEST(PlantLostSteps, AreEveryNthPulseWhateverTheTicksAreCutInto) {
  // Two oracles: how many of n pulses are lost, and where the machine is, pulse by pulse.
  std::mt19937_64 random(90'125);
  const auto between = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  for (int round = 0; round < 200; ++round) {
    const std::int64_t one_in = between(0, 3) == 0 ? between(1, 3) : between(1, 400);
    Machine machine;
    machine.faults().loses_one_in = one_in;
    std::int64_t made = 0;
    std::int64_t at = 0;
    for (int tick = 0; tick < 400; ++tick) {
      const std::int64_t pulses = between(0, 2) == 0 ? 0 : between(-100, 100);
      machine.step(pulses);
      for (std::int64_t i = 0; i < std::abs(pulses); ++i) {
        if (++made % one_in != 0) at += pulses < 0 ? -1 : 1;
      }
      ASSERT_EQ(machine.position(), at) << "one in " << one_in << " round " << round << " tick " << tick;
      ASSERT_EQ(machine.lost(), made / one_in);
    }
  }
}

TEST(PlantLostSteps, AreCommandedPulsesThatDoNotMove) {
  // Conservation: commanded = moved + lost, with the sign of the commanded pulses, tick by tick.
  std::mt19937_64 random(4);
  PlantSetup setup;
  setup.travel = PulseSpan{-2000, 2000};
  Machine machine(setup);
  std::int64_t lost = 0;
  for (int tick = 0; tick < 20'000; ++tick) {
    if (tick % 97 == 0) machine.faults().loses_one_in = static_cast<std::int64_t>(random() % 60);
    if (tick % 131 == 0) machine.faults().stalled = random() % 3 == 0;
    const auto pulses = static_cast<std::int64_t>(random() % 201) - 100;
    const std::int64_t before = machine.position();
    const std::int64_t lost_before = machine.lost();
    machine.step(pulses);
    const std::int64_t lost_now = machine.lost() - lost_before;
    ASSERT_GE(lost_now, 0);
    ASSERT_EQ(pulses, machine.position() - before + (pulses < 0 ? -lost_now : lost_now)) << tick;
    lost += lost_now;
  }
  EXPECT_EQ(machine.lost(), lost);
  EXPECT_GT(lost, 1000);
}

TEST(PlantLostSteps, OneInOneIsAStall) {
  Machine machine;
  machine.faults().loses_one_in = 1;
  machine.step(50);
  machine.step(-20);
  EXPECT_EQ(machine.position(), 0);
  EXPECT_EQ(machine.lost(), 70);
}

TEST(PlantLostSteps, OfAnotherRateAreCountedAgain) {
  Machine machine;
  machine.faults().loses_one_in = 1000;
  machine.step(999);  // one more would be lost
  EXPECT_EQ(machine.lost(), 0);
  machine.faults().loses_one_in = 2;
  machine.step(1);
  EXPECT_EQ(machine.position(), 1000) << "the first of two";
  machine.step(1);
  EXPECT_EQ(machine.lost(), 1);
}

TEST(PlantLostSteps, AreCountedAgainAfterTheyWereOver) {
  Machine machine;
  machine.faults().loses_one_in = 10;
  machine.step(9);
  machine.faults().loses_one_in = 0;
  machine.step(25);
  machine.faults().loses_one_in = 10;
  machine.step(9);
  EXPECT_EQ(machine.lost(), 0);
  machine.step(1);
  EXPECT_EQ(machine.lost(), 1);
  EXPECT_EQ(machine.position(), 9 + 25 + 9);
}

TEST(PlantSlip, MovesTheMachineOnceAndLosesNoPulse) {
  PlantSetup setup;
  setup.encoder_counts_per_revolution = 2;
  setup.upper_limit = 100;
  Machine machine(setup);
  machine.faults().slipped_pulses = 120;
  machine.step(-5);
  EXPECT_EQ(machine.position(), 115);
  EXPECT_EQ(machine.lost(), 0);
  EXPECT_EQ(machine.axis().encoder_counts(), 230);
  EXPECT_TRUE(machine.axis().at_upper_limit());
  machine.step(0);
  machine.step(1);
  EXPECT_EQ(machine.position(), 116);
}

TEST(PlantSlip, EndsAtTheStopsAndComesBeforeTheControllersPulses) {
  PlantSetup setup;
  setup.travel = PulseSpan{-10, 10};
  Machine machine(setup);
  machine.faults().slipped_pulses = 1'000'000;
  machine.step(-4);
  EXPECT_EQ(machine.position(), 6);
  EXPECT_EQ(machine.lost(), 0) << "a force against the stop is not a pulse";
  machine.faults().slipped_pulses = -2;
  machine.step(7);
  EXPECT_EQ(machine.position(), 10);
  EXPECT_EQ(machine.lost(), 1);
}

TEST(PlantSlip, MovesAStalledMachineToo) {
  Machine machine;
  machine.faults().stalled = true;
  machine.faults().slipped_pulses = -30;
  machine.step(9);
  EXPECT_EQ(machine.position(), -30);
  EXPECT_EQ(machine.lost(), 9);
}

}  // namespace plant_fault_test
}  // namespace understudy::emulator::world
