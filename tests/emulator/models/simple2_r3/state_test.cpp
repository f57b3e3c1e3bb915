// A Simple2-R3's whole state as bytes: saved, restored, hashed, refused.
// tests/emulator/world/snapshot_test.cpp tests how it continues.
#include <gtest/gtest.h>

#include "base/state/state_error.h"
#include "emulator/device/user_program.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/device.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace state_test {

using Saved = std::vector<std::byte>;

std::string refusal_of(Device& device, const Saved& bytes) {
  try {
    device.restore_state(bytes);
    return "";
  } catch (const StateError& error) {
    return error.what();
  }
}

/// Busy: it moves, its program runs and waits, its memory writes.
struct BusySimple2 : ReadySimple2 {
  explicit BusySimple2(const Given& given = {}) : ReadySimple2(given) {
    device().user_program()->load_program("Out 2 1\nDelay_mSec 100\nEND\n");
    set("PROG_MAIN_RunTime_START", 0);
    set_one_pulse_a_tick('A', 500);
    set("Aaxis_Move_INC", 1);
    set("Baxis_VelMode_ACC", 30'000);
    set("Baxis_DirectmRPM", 60'000);
    set("Timer1_Value", 12);
    run(25);
  }
};

TEST(Simple2State, EverythingThatAHostCanSeeComesBack) {
  BusySimple2 busy;
  const Saved state = busy.device().save_state();
  const std::string program = busy.device().user_program()->program_text();
  const Value a = busy.coordinate('A');
  const Value b = busy.coordinate('B');
  EXPECT_TRUE(busy.moving('A'));
  EXPECT_TRUE(busy.moving('B'));
  EXPECT_TRUE(busy.bit("PROG_MAIN_RunTime_Status"));
  EXPECT_TRUE(busy.bit("EEPROM_Writing"));
  EXPECT_TRUE(busy.output(2));

  // All of it changes.
  busy.set("ALL_STOP", 1);
  busy.set("Factory_Reset", 1);
  busy.run(2000);
  EXPECT_FALSE(busy.moving('A'));
  EXPECT_FALSE(busy.bit("PROG_MAIN_RunTime_Status"));
  EXPECT_FALSE(busy.bit("EEPROM_Writing"));
  EXPECT_FALSE(busy.output(2));
  EXPECT_EQ(busy.get("Baxis_VelMode_ACC"), 1000);
  EXPECT_NE(busy.device().user_program()->program_text(), program);
  EXPECT_NE(busy.device().save_state(), state);

  busy.device().restore_state(state);
  EXPECT_EQ(busy.coordinate('A'), a);
  EXPECT_EQ(busy.coordinate('B'), b);
  EXPECT_TRUE(busy.moving('A'));
  EXPECT_TRUE(busy.moving('B'));
  EXPECT_TRUE(busy.bit("PROG_MAIN_RunTime_Status"));
  EXPECT_TRUE(busy.bit("EEPROM_Writing"));
  EXPECT_TRUE(busy.output(2));
  EXPECT_EQ(busy.get("Baxis_VelMode_ACC"), 30'000);
  EXPECT_EQ(busy.device().user_program()->program_text(), program);
  EXPECT_TRUE(saves(busy.device(), state));
}

/// Each thing that is done to a device shows in its hash, and what is undone does not.
TEST(Simple2State, TheHashShowsWhatIsDone) {
  struct Case {
    const char* name;
    Value value;
  };
  const Case cases[] = {{"Aaxis_Pulse", 7},    {"PROG_VAR31", -1},  {"MAIN_LINE255_JMP", 9},
                        {"DOUT_6", 1},         {"Baxis_SVON", 1},   {"Cord_B", -5},
                        {"ENCA", 1},           {"Timer2_Value", 1}, {"PWD_Input", 3},
                        {"Counter2_Value", 1}, {"ADC_1V_B", 401}};
  for (const auto& [name, value] : cases) {
    OneSimple2 one;
    OneSimple2 same;
    one.set(name, value);
    EXPECT_NE(one.device().state_hash(), same.device().state_hash()) << name;
    same.set(name, value);
    EXPECT_EQ(one.device().state_hash(), same.device().state_hash()) << name;
  }
  OneSimple2 device;
  const std::uint64_t before = device.device().state_hash();
  device.input(10, true);
  EXPECT_NE(device.device().state_hash(), before);
  device.input(10, false);
  EXPECT_EQ(device.device().state_hash(), before);
  device.world().switch_power(0, false);
  EXPECT_NE(device.device().state_hash(), before);
}

TEST(Simple2State, BytesThatAreNoStateAreRefusedAndChangeNothing) {
  BusySimple2 busy;
  const Saved state = busy.device().save_state();
  const auto refused = [&](const std::string& what, auto spoil) {
    Saved bad = state;
    spoil(bad);
    EXPECT_EQ(refusal_of(busy.device(), bad), what);
    EXPECT_TRUE(saves(busy.device(), state));
  };
  // Inputs first: how many (32 bits), then each (32 bits); then the power (8), the last tick (64), and the
  // image, of which the second slot is HW_Code, of 16 bits.
  constexpr std::size_t kPower = 4 + 4 * kTerminalCount;
  static constexpr std::size_t kImage = kPower + 1 + 8;
  refused("the bytes end too early", [](Saved& s) { s.clear(); });
  refused("the bytes end too early", [](Saved& s) { s.pop_back(); });
  refused("bytes are left over", [](Saved& s) { s.push_back({}); });
  refused("its terminals are different", [](Saved& s) { s[0] = std::byte{kTerminalCount - 1}; });
  refused("a number is out of range", [](Saved& s) { s[4] = std::byte{2}; });  // DIN 0
  refused("a number is out of range", [](Saved& s) { s[7] = std::byte{0xFF}; });
  refused("a boolean must be 0 or 1", [](Saved& s) { s[kPower] = std::byte{2}; });
  refused("a number is out of range", [](Saved& s) { s[kPower + 8] = std::byte{0x80}; });  // the tick
  EXPECT_EQ(state[kImage + 4], std::byte{0x01});
  EXPECT_EQ(state[kImage + 5], std::byte{0xC0});
  refused("MAIN_LINE0_CMD holds a value that is not valid", [](Saved& s) {
    // A program cell holds 8 bits; it is the first slot of the image that holds less than its type.
    s[kImage + 4 * slot("MAIN_LINE{}_CMD") + 1] = std::byte{1};
  });
}

TEST(Simple2State, EveryPrefixIsRefused) {
  BusySimple2 busy;
  const Saved state = busy.device().save_state();
  for (std::size_t size = 0; size < state.size(); size += size < 300 ? 1 : 37) {
    EXPECT_EQ(
        refusal_of(busy.device(), Saved(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(size))),
        "the bytes end too early")
        << size;
  }
  EXPECT_TRUE(saves(busy.device(), state));
}

/// A motor's state is motion's to judge.
TEST(Simple2State, AMotorThatCannotBeIsRefused) {
  BusySimple2 busy;
  auto& device = dynamic_cast<Simple2R3&>(busy.device());
  device.state().axes[0].motor.last_direction = 2;
  const Saved bad = device.save_state();
  device.state().axes[0].motor.last_direction = 1;
  const Saved good = device.save_state();
  EXPECT_EQ(refusal_of(device, bad), "a number is out of range");
  EXPECT_EQ(device.save_state(), good);
}

/// Every field with a bound, and both of its ends.
TEST(Simple2State, NumbersBeyondTheirBoundsAreRefused) {
  using Number = std::int64_t;
  struct Bounded {
    const char* what;
    void (*put)(State& state, Number value);
    Number min;
    Number max;
  };
  constexpr Number kReach = Number{1} << 61;
  constexpr Number kFastest = INT64_MAX / 4 / 3200;  // at 3200 pulses per revolution
  const Bounded fields[] = {
      {"pulses_this_tick", [](State& s, Number v) { s.axes[0].pulses_this_tick = v; }, -kReach, kReach},
      {"alarm_clear_until", [](State& s, Number v) { s.axes[0].alarm_clear_until = v; }, -kReach, kReach},
      {"target_urpm", [](State& s, Number v) { s.axes[1].target_urpm = v; }, INT32_MIN * Number{1000},
       INT32_MAX * Number{1000}},
      {"speed_urpm", [](State& s, Number v) { s.axes[0].speed_urpm = v; }, -kFastest, kFastest},
      {"speed_urpm of one pulse a revolution",
       [](State& s, Number v) {
         s.image[kAxisSlots[0].resolution] = 1;
         s.axes[0].speed_urpm = v;
       },
       -INT64_MAX / 4, INT64_MAX / 4},
      {"velocity_phase", [](State& s, Number v) { s.axes[0].velocity_phase = v; }, -kVelocityPhase,
       kVelocityPhase},
      {"velocity_resolution",
       [](State& s, Number v) { s.axes[0].velocity_resolution = static_cast<std::uint32_t>(v); }, 1,
       Number{1} << 31},
      {"encoder_raw", [](State& s, Number v) { s.axes[1].encoder_raw = v; }, -kReach, kReach - 1},
      {"encoder_counts", [](State& s, Number v) { s.axes[1].encoder_counts = v; }, -kReach, kReach - 1},
      {"encoder_followed", [](State& s, Number v) { s.axes[1].encoder_followed = v; }, -kReach, kReach - 1},
      {"encoder_preset", [](State& s, Number v) { s.axes[0].encoder_preset = v; }, -kReach, kReach},
      {"encoder_history", [](State& s, Number v) { s.axes[1].encoder_history[100] = v; }, -kReach,
       kReach - 1},
      {"encoder_changed", [](State& s, Number v) { s.axes[1].encoder_changed = v; }, -kReach, kReach},
      {"first_tick", [](State& s, Number v) { s.first_tick = v; }, -kReach, kReach},
      {"timers", [](State& s, Number v) { s.timers[1].since = v; }, -kReach, kReach},
      {"delay_until_ms", [](State& s, Number v) { s.execution.delay_until_ms = v; }, 0,
       tick_at(kHorizon) * 2},
      {"kept.distance", [](State& s, Number v) { s.kept[0].move.distance_pulses = v; }, -(Number{1} << 33),
       Number{1} << 33},
      {"kept.speed", [](State& s, Number v) { s.kept[0].move.speed_rpm = static_cast<std::uint32_t>(v); }, 0,
       UINT16_MAX},
      {"kept.acceleration",
       [](State& s, Number v) { s.kept[1].move.acceleration_10ms = static_cast<std::uint32_t>(v); }, 0,
       UINT16_MAX},
      {"kept.deceleration",
       [](State& s, Number v) { s.kept[1].move.deceleration_10ms = static_cast<std::uint32_t>(v); }, 0,
       UINT16_MAX},
      {"kept.value", [](State& s, Number v) { s.kept[1].value = v; }, INT32_MIN, INT32_MAX},
  };
  for (const Bounded& field : fields) {
    BusySimple2 busy;
    auto& device = dynamic_cast<Simple2R3&>(busy.device());
    device.state().image[kAxisSlots[0].resolution] = 3200;
    device.state().axes[0].speed_urpm = 0;
    const Saved good = device.save_state();
    const auto with = [&](Number value) {
      field.put(device.state(), value);
      Saved state = device.save_state();
      device.restore_state(good);
      return state;
    };
    for (const Number end : {field.min, field.max}) {
      const Saved state = with(end);
      EXPECT_EQ(refusal_of(device, state), "") << field.what << " " << end;
      device.restore_state(good);
    }
    for (const Number beyond : {field.min - 1, field.max + 1}) {
      const Saved state = with(beyond);
      EXPECT_EQ(refusal_of(device, state), "a number is out of range") << field.what << " " << beyond;
      EXPECT_EQ(device.save_state(), good) << field.what;
    }
  }
}

TEST(Simple2State, AMemoryThatWritesInDisorderIsRefused) {
  BusySimple2 busy;
  Device& device = busy.device();
  const Saved writing = device.save_state();
  busy.run(10'000);  // all is written
  ASSERT_FALSE(busy.bit("EEPROM_Writing"));
  const Saved written = device.save_state();
  // Both are states, of memories with different jobs.
  EXPECT_EQ(refusal_of(device, writing), "");
  EXPECT_EQ(refusal_of(device, written), "");

  Eeprom memory(std::array<std::uint32_t, 3>{1, 2, 3}, std::array{true, true, false});
  Eeprom other(std::array<std::uint32_t, 3>{1, 2, 3}, std::array{true, false, true});
  Eeprom smaller(std::array<std::uint32_t, 2>{1, 2}, std::array{true, true});
  EXPECT_NO_THROW(memory.check_restored(memory));
  EXPECT_THROW(memory.check_restored(other), StateError);
  EXPECT_THROW(memory.check_restored(smaller), StateError);
  memory.write(0, 9, 5, 100);
  memory.write(1, 9, 5, 100);
  EXPECT_NO_THROW(memory.check_restored(memory));
  memory.rewrite(std::array<std::uint32_t, 3>{9, 9, 9}, 500, 100);
  memory.write(1, 5, 5, 100);
  EXPECT_NO_THROW(memory.check_restored(memory));
  memory.write(0, 5, 2'000'000, 100);  // longer than any
  EXPECT_THROW(memory.check_restored(memory), StateError);
}

TEST(Simple2State, ADeviceOfAnotherFirmwareTakesIt) {
  // Registers are laid out alike; whose state it is, is the snapshot's to judge.
  OneSimple2 old(Given{.firmware = 139});
  OneSimple2 now;
  now.set("Aaxis_Speed", 123);
  old.device().restore_state(now.device().save_state());
  EXPECT_EQ(old.get("Aaxis_Speed"), 123);
}

}  // namespace state_test
}  // namespace understudy::emulator::models::simple2_r3
