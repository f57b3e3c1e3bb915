// Power cycles at any moment: what survives them and what does not, for every register, and a device that
// restarts as if it had only kept its memory.
#include <functional>

#include "emulator/device/memory/persistent_memory.h"
#include "tests/emulator/device/register_map/register_facts.h"
#include "tests/emulator/models/simple2_r3/switched_simple2.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::models::simple2_r3 {
namespace power_cycle_test {

constexpr Value kForeverSpeedMilliRpm = 60'000;

// --- every register ------------------------------------------------------------------------------------

/// Something else than the factory's, within the range; for each address another one where there is room.
std::uint16_t other_word(const RegisterFact& r) {
  if (r.is_32_bit) return static_cast<std::uint16_t>(r.factory_word + 1 + r.address % 251);
  const Value low = r.min.value_or(0);
  const Value high = r.name.starts_with("MAIN_LINE") ? 0xFF : r.max.value_or(0xFFFF);
  Value value = low + r.address % (high - low + 1);
  if (r.name.starts_with("ADC_")) value = r.factory_word + 25;
  if (value == r.factory_word) value = value == high ? low : value + 1;
  return static_cast<std::uint16_t>(value);
}

/// What a register reads after power-up that follows from what others have kept.
const std::map<std::uint16_t, std::uint16_t> kFollowing = {
    {0x0000, 0x0003},  // both alarms are assigned and the inputs, being off, mean alarm
    {0x0D00, 1},       // the servo's output is on without servo, as its polarity is 0
    {0x0D02, 1},
    {0x0DF0, 0x05},
};

TEST(PowerCycle, KeepsEveryRegisterThatTheManualMarksAndNoOther) {
  Switched feeder;
  const auto registers = simple2_r3_registers();
  std::size_t written = 0;
  for (const RegisterFact& r : registers) {
    // A password would lock what is to be compared; it has tests of its own.
    if (!r.writable || !r.readable || r.name == "NEW_PWD") continue;
    feeder.write(r.address, {other_word(r)});
    ++written;
  }
  EXPECT_GT(written, 1300u);
  feeder.run(10'000);
  ASSERT_FALSE(feeder.bit("EEPROM_Writing"));
  const NvImage memory = feeder.device().memory()->nv_image();
  feeder.cycle(50);

  // A device that is made from a file of this memory is the same.
  DeviceSettings settings;
  settings.nv = memory;
  const auto copy = world::make_simple2(settings);
  std::size_t kept = 0;
  for (const RegisterFact& r : registers) {
    if (!r.readable) continue;
    const auto follows = kFollowing.find(r.address);
    const std::uint16_t expected = follows != kFollowing.end() ? follows->second
                                   : r.persistent              ? other_word(r)
                                                               : r.factory_word;
    kept += r.persistent;
    EXPECT_EQ(world::read(feeder.device(), r.address, 1), world::Words{expected}) << r.name;
    EXPECT_EQ(world::read(*copy, r.address, 1), world::Words{expected}) << r.name << " from a file";
  }
  EXPECT_GT(kept, 1200u);
  EXPECT_EQ(feeder.device().memory()->nv_image(), memory);
  EXPECT_EQ(copy->memory()->nv_image(), memory);
}

// --- in the middle of everything
// -----------------------------------------------------------------------------

struct Situation {
  const char* what;
  std::function<void(Switched&)> begin;
  const char* busy;  // a register that shows that it is in progress
  Value busy_value = 1;
};

void start_with_cells(Switched& feeder, const world::Words& cells) {
  feeder.write(0x4000, cells);
  feeder.set("PROG_MAIN_RunTime_START", 0);
  feeder.run(30);
}

const std::vector<Situation> kSituations = {
    {"an incremental move",
     [](Switched& f) {
       f.set_one_pulse_a_tick('A', 5000);
       f.set("Aaxis_Move_INC", 1);
       f.run(500);
     },
     "Aaxis_Move_INC"},
    {"an absolute move of both axes",
     [](Switched& f) {
       f.set_one_pulse_a_tick('A', -5000);
       f.set_one_pulse_a_tick('B', 5000);
       f.set("ALL_Move_ABS", 1);
       f.run(5);  // on the ramp
     },
     "STATUS", 0b1100'0011'0000},
    {"a move that hangs at speed 0",
     [](Switched& f) {
       f.set_move('B', 7, 0, 0, 0);
       f.set("Baxis_Move_INC", 1);
       f.run(5);
     },
     "Baxis_Move_INC"},
    {"homing",
     [](Switched& f) {
       f.set("Aaxis_Home_Speed", 60);
       f.set("Aaxis_GoHome", 1);
       f.run(700);
     },
     "Aaxis_GoHome"},
    {"velocity mode",
     [](Switched& f) {
       f.set("Axis_VelMode_ACC", 32'768);
       f.set("Aaxis_DirectmRPM", kForeverSpeedMilliRpm);
       f.run(2000);
     },
     "Aaxis_Mode", 1},
    {"PWM mode",
     [](Switched& f) {
       f.set("Baxis_DirectPWM", 50);
       f.run(20);
     },
     "Baxis_Mode", 2},
    {"sync mode",
     [](Switched& f) {
       f.set("ALL_SyncMode", 1);
       f.run(20);
     },
     "Aaxis_Mode", 3},
    {"outputs on",
     [](Switched& f) {
       f.set("DOUT_ALL", 0x7F);
       f.run(5);
     },
     "DOUT_ALL", 0x7F},
    {"the servo's outputs",
     [](Switched& f) {
       f.set("DOUT0_Aaxis_SVON", 1);
       f.set("DOUT2_Baxis_SVON", 1);
       f.run(50);
     },
     "DOUT_ALL", 0x05},
    {"an ACLR pulse",
     [](Switched& f) {
       f.set("DOUT1_Aaxis_ACLR", 1);
       f.run(50);
       f.set("Aaxis_ACLR", 1);
       f.run(100);
     },
     "DOUT_1"},
    {"a program in a delay",
     [](Switched& f) {
       start_with_cells(f, {0x02, 0xFF, 0xFF, 0});
     },
     "PROG_MAIN_RunTime_Status"},
    {"a program that waits for an input",
     [](Switched& f) {
       start_with_cells(f, {0x01, 3, 1, 0});
     },
     "PROG_MAIN_RunTime_Status"},
    {"a program in a loop",
     [](Switched& f) {
       start_with_cells(f, {0, 0, 0, 1, 0x51, 1, 0, 0, 0x04, 1, 0, 0, 0xFF, 0, 0, 0});
     },
     "PROG_MAIN_RunTime_Status"},
    {"a program that waits for its move",
     [](Switched& f) {
       f.set("PROG_MEM0", 5000);
       f.set_one_pulse_a_tick('A', 0);
       start_with_cells(f, {0x25, 0, 0, 0});
     },
     "Aaxis_Move_INC"},
    {"timers, counters and variables",
     [](Switched& f) {
       start_with_cells(f, {0x55, 1, 0, 0, 0x55, 2, 0, 0, 0x51, 2, 0, 0, 0x6B, 33, 0, 0, 0xFF, 0, 0, 0});
     },
     "Counter2_Value"},
    {"presets of coordinates and encoders",
     [](Switched& f) {
       f.set("Cord_A", 12'345);
       f.set("Cord_B", -1);
       f.set("ENCA", 777);
       f.set("ENCB", INT32_MIN);
       f.run(5);
     },
     "Cord_A", 12'345},
};

/// Reached in every situation with the machine and its encoder away from where they were at power-up.
Given machine() {
  world::PlantSetup plant;
  plant.encoder_counts_per_revolution = 1;
  return {.plant = {{0, plant}, {1, plant}}};
}

TEST(PowerCycle, StopsWhateverWasGoingOnAndForgetsItWholly) {
  for (const Situation& situation : kSituations) {
    for (const Tick off_for : {0, 1, 777}) {
      SCOPED_TRACE(std::string(situation.what) + ", off for " + std::to_string(off_for) + " ms");
      Switched feeder(machine());
      feeder.set("ALL_SVON", 1);
      feeder.run_to(10);
      feeder.set_one_pulse_a_tick('A', 40);
      feeder.set("Aaxis_Move_INC", 1);
      feeder.run(100);
      situation.begin(feeder);
      EXPECT_EQ(feeder.get(situation.busy), situation.busy_value) << "it is in the middle of it";

      const std::int64_t places[] = {feeder.place(0), feeder.place(1)};
      EXPECT_NE(places[0], 0);
      const NvImage memory = feeder.device().memory()->nv_image();
      feeder.power(false);
      EXPECT_FALSE(feeder.outputs_any()) << "nothing is driven without power";
      feeder.run(off_for);
      EXPECT_FALSE(feeder.outputs_any());
      feeder.power(true);

      // One that has kept the same memory, and has just been switched on for the first time.
      Switched twin({.set = memory.registers});
      twin.run_to(feeder.now());
      twin.cycle();
      for (int looks = 0; looks < 3; ++looks) {
        for (const RegisterFact& r : simple2_r3_registers()) {
          if (!r.readable) continue;
          ASSERT_EQ(world::read(feeder.device(), r.address, 1), world::read(twin.device(), r.address, 1))
              << r.name << " " << looks;
        }
        ASSERT_EQ(feeder.place(0), places[0]) << "the machine does not move";
        ASSERT_EQ(feeder.place(1), places[1]);
        feeder.run(looks == 0 ? 1 : 3000);
        twin.run(looks == 0 ? 1 : 3000);
      }
      for (const char* zero : {"STATUS", "Cord_A", "Cord_B", "ENCA", "ENCB", "ENCA_RPM", "Aaxis_Mode",
                               "Baxis_Mode", "DOUT_ALL", "PROG_MAIN_RunTime_Status", "EEPROM_Writing"}) {
        EXPECT_EQ(feeder.get(zero), 0) << zero;
      }

      // Ready to work, from 0 on, wherever the machine is.
      for (Switched* device : {&feeder, &twin}) {
        device->set("Aaxis_SVON", 1);
        device->set_one_pulse_a_tick('A', -30);
        device->set("Aaxis_Move_ABS", 1);
        device->run(300);
        EXPECT_EQ(device->coordinate('A'), -30);
      }
      EXPECT_EQ(feeder.place(0), places[0] - 30);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(PowerCycle, TheEncoderCountsFrom0WhereverTheMachineStands) {
  for (const Value reversed : {0, 1}) {
    Switched feeder(machine());
    feeder.set("Axis_ENC_Polarity", reversed);
    feeder.set("ALL_SVON", 1);
    feeder.run_to(10);
    feeder.set_one_pulse_a_tick('A', 400);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(1000);
    const Value sign = reversed == 0 ? 1 : -1;
    EXPECT_EQ(feeder.get("ENCA"), 400 * sign);
    feeder.cycle();
    EXPECT_EQ(feeder.get("ENCA"), 0);
    EXPECT_EQ(feeder.place(0), 400);
    feeder.run(500);
    EXPECT_EQ(feeder.get("ENCA"), 0);
    EXPECT_EQ(feeder.get("ENCA_RPM"), 0) << "nothing has turned";
    feeder.set("Aaxis_SVON", 1);
    feeder.set_one_pulse_a_tick('A', -25);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(100);
    EXPECT_EQ(feeder.get("ENCA"), -25 * sign);
    EXPECT_EQ(feeder.place(0), 375);
  }
}

TEST(PowerCycle, AMoveIsCutToThePulse) {
  // s(t) = t^2/20 up to 10 ms, then t - 5; a move given at tick 10 is at s(t) in tick 11 + t.
  for (const Tick t : {0, 1, 4, 5, 10, 11, 300}) {
    Switched feeder(machine());
    feeder.set("ALL_SVON", 1);
    feeder.run_to(10);
    feeder.set_one_pulse_a_tick('A', 5000);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run_to(11 + t);
    feeder.cycle(t % 2);
    feeder.run(500);
    EXPECT_EQ(feeder.place(0), t <= 10 ? t * t / 20 : t - 5) << t;
    EXPECT_EQ(feeder.coordinate('A'), 0);
  }
}

}  // namespace power_cycle_test
}  // namespace understudy::emulator::models::simple2_r3
