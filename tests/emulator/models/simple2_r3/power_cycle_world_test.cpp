// Power cycles at random times (seeded; UNDERSTUDY_SEED overrides): fast-forwarded ticks equal single ticks,
// and stored values are never lost. Two controllers with machines, wires, programs that start automatically
// and count in memory, EEPROM writes and erasures in progress.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <random>

#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/terminals.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::models::simple2_r3 {
namespace power_cycle_world_test {

std::uint64_t seed() {
  const char* given = std::getenv("UNDERSTUDY_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 81'002;
}

/// Counts in MEM0 and moves A back and forth, with waits of many kinds; lines of CMD, DATA1, DATA2, JMP.
const std::vector<std::uint16_t> kProgram{
    0x2A, 0,  0, 1,  // SVON_A
    0x6B, 0,  0, 0,  // VAR_Inc MEM0
    0x22, 1,  0, 0,  // Move_Speed_A MEM1
    0x25, 2,  0, 0,  // Move_INC_A_Wait MEM2
    0x93, 2,  0, 0,  // VAR_INV MEM2
    0x09, 16, 1, 0,  // Out_Array_Select DOUT 4 ON
    0x02, 37, 0, 0,  // Delay_mSec 37
    0x09, 16, 0, 0,  // Out_Array_Select DOUT 4 OFF
    0x03, 1,  0, 0,  // Jump
};

class Outside {
 public:
  explicit Outside(std::uint64_t seed_value) : random_(seed_value) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  SimTime gap() {
    switch (between(0, 4)) {
      case 0: return SimTime{0};
      case 1: return SimTime{between(0, 3'000'000)};
      case 2: return kTickLength * between(1, 12);
      case 3: return SimTime{between(0, 4'000'000'000)};
      default: return SimTime{between(0, 100'000'000)};
    }
  }
  /// The same to both worlds.
  void act(world::World& one, world::World& other) {
    const std::string device = between(0, 1) == 0 ? "feeder." : "turner.";
    const std::size_t number = device == "feeder." ? 0 : 1;
    const auto both = [&](auto what) {
      what(one);
      what(other);
    };
    const auto write = [&](const std::string& name, Value value) {
      if (one.device(number).powered())
        both([&](world::World& world) { world::set(world, device + name, value); });
    };
    switch (between(0, 11)) {
      case 0:
      case 1: both([&](world::World& world) { world.switch_power(number, false); }); break;
      case 2:
      case 3:
      case 4: both([&](world::World& world) { world.switch_power(number, true); }); break;
      case 5: {  // off and on again
        both([&](world::World& world) { world.switch_power(number, false); });
        both([&](world::World& world) { world.switch_power(number, true); });
        break;
      }
      case 6: {
        const auto terminal = static_cast<int>(between(0, 10));
        const auto level = static_cast<std::int32_t>(between(0, 1));
        both([&](world::World& world) { world.set_external_input(number, terminal, level); });
        break;
      }
      case 7: write("PROG_MEM" + std::to_string(between(3, 31)), between(-5, 5)); break;
      case 8: write("Parms_Speed" + std::to_string(between(1, 16)), between(0, 5)); break;
      case 9: {
        constexpr const char* kTriggers[] = {"Aaxis_SVON", "Aaxis_GoHome",      "Baxis_Move_INC", "ALL_ACLR",
                                             "Aaxis_STOP", "Axis_ENC_Polarity", "Aaxis_SyncMode", "ALL_SVON",
                                             "DOUT_ALL",   "DIN0_Aaxis_Alarm"};
        write(kTriggers[between(0, std::size(kTriggers) - 1)], 1);
        break;
      }
      case 10: write("Aaxis_DirectmRPM", between(-100'000, 100'000)); break;
      default:
        if (between(0, 15) > 0 || !one.device(number).powered()) break;
        write(between(0, 1) == 0 ? "PROG_MAIN_Erase_ALL" : "Factory_Reset", 1);
        load(one, number);
        load(other, number);
    }
  }
  static void load(world::World& world, std::size_t number) {
    Device& device = world.device(number);
    EXPECT_EQ(write_words(*device.register_bank(), Table::holding, 0x4000, kProgram), Refusal::none);
    const std::string name = device.name() + ".";
    for (const auto& [what, value] :
         std::vector<std::pair<std::string, Value>>{{"PROG_MEM1", 60},
                                                    {"PROG_MEM2", 50},
                                                    {"AutoStart_MainProg", 1},
                                                    {"DIN2_Aaxis_UP_Limit", 1},
                                                    {"DOUT1_Aaxis_ACLR", 1},
                                                    {"Aaxis_Home_Speed", 30},
                                                    {"Axis_VelMode_ACC", 30'000}}) {
      EXPECT_EQ(world::set(world, name + what, value), Refusal::none) << what;
    }
  }

 private:
  std::mt19937_64 random_;
};

testing::AssertionResult same(world::World& one, world::World& other) {
  const auto differ = [](const std::string& what) {
    return testing::AssertionFailure() << what << " differs";
  };
  if (one.now() != other.now()) return differ("the time");
  if (one.next_due() != other.next_due()) return differ("what is due");
  for (std::size_t d = 0; d < 2; ++d) {
    if (one.device(d).powered() != other.device(d).powered()) return differ("the power");
    if (const auto same = same_state(one.device(d), other.device(d)); !same) return same;
    if (one.device(d).memory()->nv_image() != other.device(d).memory()->nv_image()) return differ("a memory");
    for (int i = 0; i < 18; ++i) {
      if (one.device(d).input(i) != other.device(d).input(i)) return differ("an input");
      if (one.device(d).terminals()->output(i) != other.device(d).terminals()->output(i))
        return differ("an output");
    }
    for (int axis = 0; axis < 2; ++axis) {
      if (one.plant(d, axis).position_pulses() != other.plant(d, axis).position_pulses())
        return differ("a machine");
    }
  }
  return testing::AssertionSuccess();
}

TEST(PowerCycleInAWorld, AtRandomTimesBulkTicksAreSingleTicksBitForBit) {
  std::cout << "seed " << seed() << "\n";
  std::uint64_t skipped = 0;
  std::uint64_t run = 0;
  int power_ups = 0;
  Value counted = 0;
  for (std::uint64_t sequence = 0; sequence < 10; ++sequence) {
    Outside outside(seed() + sequence);
    world::World bulk = world::make_world();
    world::World single = world::make_world();
    single.set_bulk_ticks(false);
    for (const std::size_t device : {0, 1}) {
      Outside::load(bulk, device);
      Outside::load(single, device);
    }
    SimTime time{0};
    for (int event = 0; event < 250; ++event) {
      time += outside.gap();
      bulk.advance_to(time);
      single.advance_to(time);
      ASSERT_TRUE(same(bulk, single)) << "seed " << seed() + sequence << " before event " << event;
      const bool was_on = bulk.device(0).powered();
      outside.act(bulk, single);
      power_ups += !was_on && bulk.device(0).powered();
      ASSERT_TRUE(same(bulk, single)) << "seed " << seed() + sequence << " after event " << event;
    }
    skipped += bulk.ticks_skipped();
    run += bulk.ticks_run();
    EXPECT_EQ(single.ticks_skipped(), 0u);
    for (std::size_t d : {0, 1}) {
      for (const auto& [name, value] : bulk.device(d).memory()->nv_image().registers) {
        if (name == "PROG_MEM0") counted += value;
      }
    }
  }
  EXPECT_GT(skipped, 10'000u);
  EXPECT_GT(run, 10'000u);
  EXPECT_GT(power_ups, 100);
  EXPECT_GT(counted, 100) << "programs started automatically";
}

TEST(PowerCycleInAWorld, WhatWasKeptOnceIsThereAfterEachPowerUp) {
  // Without erasures, a count in memory only grows, and is after power-up exactly what was kept before.
  std::cout << "seed " << seed() + 500 << "\n";
  Outside outside(seed() + 500);
  world::World world = world::make_world();
  Outside::load(world, 0);
  Value last = 0;
  SimTime time = time_of(1000);  // the program is kept
  for (int cycle = 0; cycle < 300; ++cycle) {
    time += SimTime{outside.between(0, 200'000'000)};
    world.advance_to(time);
    const NvImage kept = world.device(0).memory()->nv_image();
    world.switch_power(0, false);
    if (outside.between(0, 1) == 0) world.advance_to(time += kTickLength * outside.between(0, 50));
    EXPECT_EQ(world.device(0).memory()->nv_image(), kept) << "it is idle without power";
    world.switch_power(0, true);
    EXPECT_EQ(world.device(0).memory()->nv_image(), kept);
    for (const auto& [name, value] : kept.registers)
      ASSERT_EQ(world::get(world, "feeder." + name), value) << name;
    const Value counted = world::get(world, "feeder.PROG_MEM0");
    ASSERT_GE(counted, last);
    last = counted;
  }
  EXPECT_GT(last, 50);
}

TEST(PowerCycleInAWorld, AWireFromADeviceGoesDeadOneTickAfterItsPower) {
  world::World world = world::make_world();  // feeder.DOUT_4 -> turner.DIN_10
  world::set(world, "feeder.DOUT_4", 1);
  world.advance_to(time_of(10));
  EXPECT_EQ(world::get(world, "turner.DIN_10"), 1);
  world.switch_power(0, false);
  world.advance_to(time_of(11));
  EXPECT_EQ(world::get(world, "turner.DIN_10"), 1) << "checked before the wire";
  world.advance_to(time_of(12));
  EXPECT_EQ(world::get(world, "turner.DIN_10"), 0);
  world.switch_power(0, true);
  world.advance_to(time_of(100));
  EXPECT_EQ(world::get(world, "turner.DIN_10"), 0) << "it comes back with its outputs off";
}

TEST(PowerCycleInAWorld, InputsAreLookedAtAgainByADeviceThatComesBack) {
  world::World world = world::make_world();
  world::set(world, "feeder.DIN0_Aaxis_Alarm", 1);
  world::set(world, "feeder.AutoStart_MainProg", 0);
  world.advance_to(time_of(20));
  world.switch_power(0, false);
  world::set_input(world, "feeder.DIN_0", true);
  world.advance_to(time_of(30));
  world.switch_power(0, true);
  world.advance_to(time_of(31));
  EXPECT_EQ(world::get(world, "feeder.DIN_0"), 1);
  EXPECT_EQ(world::get(world, "feeder.STATUS.0"), 1);
}

}  // namespace power_cycle_world_test
}  // namespace understudy::emulator::models::simple2_r3
