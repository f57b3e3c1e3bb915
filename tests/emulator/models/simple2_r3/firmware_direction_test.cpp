// DIR_Polarity before and after 1.41 (manual: 韌體版本 1.40 以前): until 1.40 the coordinate does not turn
// with the motor, so it counts the motor's sense; increments are as long as ever, absolute moves go wrong.
//
// At one pulse a millisecond with ramps of 10 ms a move of P pulses has gone t^2 / 20 after t ms up to 10,
// t - 5 up to P, P - (P + 10 - t)^2 / 20 up to its end after P + 10.
#include <cmath>

#include "emulator/device/axes.h"
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace firmware_direction_test {

constexpr Firmware kVersions[] = {139, 140, 141, 142, 150, 151, 152};

Value gone_after(double ms, double pulses) {
  if (ms >= pulses + 10) return static_cast<Value>(pulses);
  const double left = pulses + 10 - ms;
  const double gone = ms < 10 ? ms * ms / 20 : ms <= pulses ? ms - 5 : pulses - left * left / 20;
  return static_cast<Value>(std::floor(gone + 1e-6));
}

struct Polarity {
  Firmware firmware;
  char axis;
  bool reversed;
};

std::vector<Polarity> every_polarity() {
  std::vector<Polarity> all;
  for (const Firmware firmware : kVersions) {
    for (const char axis : {'A', 'B'}) {
      for (const bool reversed : {false, true}) all.push_back({firmware, axis, reversed});
    }
  }
  return all;
}

std::string text_of(const Polarity& p) {
  return std::to_string(p.firmware) + p.axis + (p.reversed ? " reversed" : "");
}

/// Coordinates count the other way than commands do.
bool diverges(const Polarity& p) { return p.reversed && p.firmware <= 140; }

struct Turned : ReadySimple2 {
  explicit Turned(const Polarity& polarity) : ReadySimple2({.firmware = polarity.firmware}), p(polarity) {
    set(name(p.axis, "DIR_Polarity"), p.reversed);
    set_one_pulse_a_tick(p.axis, 1000);
  }
  std::int64_t motor() { return world().plant(0, p.axis == 'A' ? 0 : 1).position_pulses(); }

  /// A move just begun, commanded by `pulses`, every millisecond of it and 5 more.
  void expect_move(Value pulses) {
    const Tick begin = now() + 1;
    const Value from = coordinate(p.axis);
    const std::int64_t motor_from = motor();
    const Value length = std::abs(pulses);
    for (Tick ms = 0; ms <= length + 15; ++ms) {
      run_to(begin + ms);
      const Value gone =
          (pulses < 0 ? -1 : +1) * gone_after(static_cast<double>(ms), static_cast<double>(length));
      ASSERT_EQ(motor() - motor_from, p.reversed ? -gone : gone) << ms;
      ASSERT_EQ(coordinate(p.axis) - from, diverges(p) ? -gone : gone) << ms;
      ASSERT_EQ(moving(p.axis), ms < length + 10) << ms;
    }
  }

  Polarity p;
};

TEST(FirmwareDirection, AnIncrementCountsInTheMotorsSenseUntil140) {
  for (const Polarity& p : every_polarity()) {
    SCOPED_TRACE(text_of(p));
    Turned machine(p);
    for (const Value pulses : {1000, -300, 20}) {
      machine.set(machine.name(p.axis, "Pulse"), pulses);
      machine.set(machine.name(p.axis, "Move_INC"), 1);
      ASSERT_NO_FATAL_FAILURE(machine.expect_move(pulses));
    }
    EXPECT_EQ(machine.coordinate(p.axis), diverges(p) ? -720 : 720);
  }
}

TEST(FirmwareDirection, AnAbsoluteMoveDivergesUntil140) {
  for (const Polarity& p : every_polarity()) {
    SCOPED_TRACE(text_of(p));
    Turned machine(p);
    machine.set(machine.name(p.axis, "Move_INC"), 1);
    ASSERT_NO_FATAL_FAILURE(machine.expect_move(1000));
    ASSERT_EQ(machine.coordinate(p.axis), diverges(p) ? -1000 : 1000);
    // To +1000. From -1000 that is +2000, which leads to -3000; from there +4000, to -7000.
    for (const Value further : {2000, 4000}) {
      machine.set(machine.name(p.axis, "Move_ABS"), 1);
      EXPECT_EQ(machine.moving(p.axis), diverges(p));
      if (diverges(p)) {
        ASSERT_NO_FATAL_FAILURE(machine.expect_move(further));
      }
      machine.run(20);
      EXPECT_EQ(machine.coordinate(p.axis), !diverges(p) ? 1000 : further == 2000 ? -3000 : -7000);
    }
    EXPECT_EQ(machine.motor(), p.reversed ? (diverges(p) ? -7000 : -1000) : 1000);
  }
}

TEST(FirmwareDirection, EveryAbsoluteMoveGoesFromMinus1000ToMinus3000) {
  enum class By { register_of_axis, register_of_all, set_of_axis, set_of_all, program, program_all };
  for (const By by : {By::register_of_axis, By::register_of_all, By::set_of_axis, By::set_of_all, By::program,
                      By::program_all}) {
    for (const Polarity& p : every_polarity()) {
      SCOPED_TRACE(text_of(p) + " by " + std::to_string(static_cast<int>(by)));
      Turned machine(p);
      machine.set("Parms_Pulse3", 1000);
      machine.set("Parms_Speed3", 20);
      machine.set("Parms_AccTime3", 1);
      machine.set("Parms_DecTime3", 1);
      machine.set("PROG_MEM4", 1000);
      machine.set(p.axis == 'A' ? "Baxis_SVON" : "Aaxis_SVON", 0);
      for (int i = 0; i < 2; ++i) {  // each time, not the first time only
        machine.set(p.axis == 'A' ? "Cord_A" : "Cord_B", -1000);
        const auto run_program = [&](std::uint16_t opcode) {
          machine.write(0x4000, {opcode, 4, 4, 0, 0xFF, 0, 0, 0});
          if (machine.now() % 2 == 0) machine.run(1);
          machine.set("PROG_MAIN_RunTime_START", 0);  // the next tick has its slot, and the move begins there
        };
        switch (by) {
          case By::register_of_axis: machine.set(machine.name(p.axis, "Move_ABS"), 1); break;
          case By::register_of_all: machine.set("ALL_Move_ABS", 1); break;
          case By::set_of_axis: machine.set(machine.name(p.axis, "ParmsMove_ABS"), 3); break;
          case By::set_of_all: machine.set("ALL_ParmsMove_ABS", 3); break;
          case By::program: run_program(p.axis == 'A' ? 0x21 : 0x31); break;
          case By::program_all: run_program(0x41); break;
        }
        ASSERT_NO_FATAL_FAILURE(machine.expect_move(2000));
        EXPECT_EQ(machine.coordinate(p.axis), diverges(p) ? -3000 : 1000);
      }
    }
  }
}

TEST(FirmwareDirection, VelocityAndSyncModeAreCountedAlike) {
  for (const Polarity& p : every_polarity()) {
    for (const bool sync : {false, true}) {
      SCOPED_TRACE(text_of(p) + (sync ? " sync" : " velocity"));
      Turned machine(p);
      if (sync) {
        machine.set(machine.name(p.axis, "SyncMode"), 1);
        for (int count = 1; count <= 100; ++count) {
          machine.device().axes()->set_encoder(p.axis == 'A' ? 0 : 1, count);
          machine.run(1);
        }
        machine.run(10);  // what a period gathers comes out in the next one
        EXPECT_EQ(machine.motor(), p.reversed ? -100 : 100);
      } else {
        // 65.536 RPM a second up to 20 RPM: 305.2 ms and 152.6 pulses; one pulse a ms from there: 847.4.
        machine.set(p.axis == 'A' ? "Axis_VelMode_ACC" : "Baxis_VelMode_ACC", 32768);
        machine.set(machine.name(p.axis, "DirectmRPM"), 20'000);
        machine.run(1000);
        EXPECT_EQ(machine.motor(), p.reversed ? -847 : 847);
      }
      EXPECT_EQ(machine.coordinate(p.axis), (diverges(p) ? 1 : p.reversed ? -1 : 1) * machine.motor());
    }
  }
}

// Changed at rest between two moves: earlier counts remain.
TEST(FirmwareDirection, ThePolarityCountsFromWhenItIsWritten) {
  for (const Polarity& p : every_polarity()) {
    SCOPED_TRACE(text_of(p));
    Turned machine(p);
    machine.set(machine.name(p.axis, "DIR_Polarity"), 0);
    machine.set(machine.name(p.axis, "Pulse"), 100);
    machine.set(machine.name(p.axis, "Move_INC"), 1);
    machine.run(200);
    EXPECT_EQ(machine.coordinate(p.axis), 100);
    machine.set(machine.name(p.axis, "DIR_Polarity"), p.reversed);
    machine.set(machine.name(p.axis, "Move_INC"), 1);
    ASSERT_NO_FATAL_FAILURE(machine.expect_move(100));
    EXPECT_EQ(machine.coordinate(p.axis), diverges(p) ? 0 : 200);
  }
}

}  // namespace firmware_direction_test
}  // namespace understudy::emulator::models::simple2_r3
