// Homing and the other commands: what replaces it, what it replaces, what it leaves, speed 0, and homing by a
// program. Courses as in homing_from_everywhere_test.cpp.
#include "tests/emulator/models/simple2_r3/homing_machine.h"

namespace understudy::emulator::models::simple2_r3 {
namespace homing_commands_test {

constexpr int kOn = +1;
constexpr int kBack = -1;

// From standstill before the switch, far enough to reach full speed: the edge after 100 - place + 5 ms.
HomingCourse from_before(std::int64_t place) {
  const Tick edge = 100 - place + 5;
  return {.legs = {run_leg(0, kOn, place), slow_leg(edge, kOn, place, static_cast<double>(100 - place)),
                   back_leg(edge + 10, 105, 5)},
          .end = edge + 30};
}

// --- what replaces it ---

TEST(HomingCommands, AMoveReplacesItFromStandstillWhereItIs) {
  for (const HomingAxis& build : every_build_of({})) {
    for (const char* trigger : {"Move_INC", "Move_ABS"}) {
      SCOPED_TRACE(std::string(trigger) + ", " + text_of(build));
      HomingSimple2 machine({build});
      const auto name = [&](std::string_view what) { return machine.name(build.axis, what); };
      machine.go_home();
      machine.step_by(51);  // at 50 ms: 45
      ASSERT_EQ(machine.place(), 45);
      // To -5: 50 pulses at one a ms, 60 ms with both ramps.
      const bool incremental = std::string_view(trigger) == "Move_INC";
      machine.set_one_pulse_a_tick(build.axis, build.direction * (incremental ? -50 : -5));
      machine.set(name(trigger), 1);
      const HomingCourse course{.legs = {run_leg(0, kBack, 45), slow_leg(50, kBack, 45, 45)}, .end = 60};
      for (Tick ms = -1; ms <= 200; ++ms) {
        if (ms >= 0) machine.step();
        ASSERT_EQ(machine.place(), course.place_at(std::max<Tick>(ms, 0))) << ms;
        ASSERT_EQ(machine.coordinate(build.axis), build.direction * machine.place()) << ms;
        ASSERT_EQ(machine.is_moving(), ms < 60) << ms;
        ASSERT_EQ(machine.get(name(trigger)), ms < 60) << ms;
        ASSERT_FALSE(machine.homing());
        ASSERT_FALSE(machine.homed());
        ASSERT_EQ(machine.get(name("GoHome")), 0);
      }
    }
  }
}

TEST(HomingCommands, AnotherModeReplacesIt) {
  struct Other {
    const char* trigger;
    Value value;
    Value mode;
  };
  // A velocity has its ramp: with VelMode_ACC 1000 not a pulse in 100 ms.
  for (const Other& other : {Other{"DirectmRPM", 1000, 1}, Other{"DirectPWM", 30, 2},
                             Other{"DirectPWM", 0, 2}, Other{"SyncMode", 1, 3}}) {
    for (const HomingAxis& build : every_build_of({})) {
      SCOPED_TRACE(std::string(other.trigger) + ", " + text_of(build));
      HomingSimple2 machine({build});
      machine.go_home();
      machine.step_by(51);
      machine.set(machine.name(build.axis, other.trigger), other.value);
      for (int ms = 0; ms < 100; ++ms) {
        ASSERT_FALSE(machine.homing());
        ASSERT_FALSE(machine.homed());
        ASSERT_EQ(machine.get(machine.name(build.axis, "GoHome")), 0);
        ASSERT_EQ(machine.get(machine.name(build.axis, "Mode")), other.mode);
        ASSERT_EQ(machine.place(), 45);
        // Of PWM the value, of velocity the target, of sync the encoder, which rests.
        const bool moves = other.mode == 1 || (other.mode == 2 && other.value != 0);
        ASSERT_EQ(machine.is_moving(), moves);
        machine.step();
      }
    }
  }
}

// --- what it replaces ---

TEST(HomingCommands, ItReplacesAMoveFromStandstillWhereItIs) {
  for (const HomingAxis& build : every_build_of({})) {
    for (const char* trigger : {"Move_INC", "Move_ABS"}) {
      SCOPED_TRACE(std::string(trigger) + ", " + text_of(build));
      HomingSimple2 machine({build});
      machine.set_one_pulse_a_tick(build.axis, build.direction * 1000);
      machine.set(machine.name(build.axis, trigger), 1);
      machine.step_by(51);  // at 50 ms: 45
      machine.go_home();
      EXPECT_EQ(machine.get(machine.name(build.axis, trigger)), 0);
      ASSERT_NO_FATAL_FAILURE(expect_courses(machine, {from_before(45)}));
    }
  }
}

TEST(HomingCommands, ItReplacesAHangingMoveAndAHangingHoming) {
  for (const HomingAxis& build : every_build_of({})) {
    HomingSimple2 machine({build});
    machine.set_move(build.axis, 1000, 0, 1, 1);
    machine.set(machine.name(build.axis, "Move_INC"), 1);
    machine.step_by(50);
    EXPECT_TRUE(machine.is_moving());
    machine.set(machine.name(build.axis, "Home_Speed"), 0);
    machine.go_home();
    machine.step_by(50);
    EXPECT_TRUE(machine.homing());
    machine.set(machine.name(build.axis, "Home_Speed"), 20);
    machine.go_home();
    ASSERT_NO_FATAL_FAILURE(expect_courses(machine, {from_before(0)}));
  }
}

TEST(HomingCommands, ItReplacesTheOtherModesAndIsAMatterOfPositionMode) {
  struct Other {
    const char* trigger;
    Value value;
  };
  for (const Other& other : {Other{"DirectmRPM", 10'000}, Other{"DirectPWM", 30}, Other{"SyncMode", 1}}) {
    for (const HomingAxis& build : every_build_of({})) {
      SCOPED_TRACE(std::string(other.trigger) + ", " + text_of(build));
      HomingSimple2 machine({build});
      machine.set(build.axis == 'A' ? "Axis_VelMode_ACC" : "Baxis_VelMode_ACC", 32768);
      machine.set(machine.name(build.axis, other.trigger), std::string_view(other.trigger) == "DirectmRPM"
                                                               ? build.direction * other.value
                                                               : other.value);
      machine.step_by(200);
      // 65.536 RPM a second up to 10 RPM: 152.6 ms and 38.1 pulses, then half a pulse a ms: 61.8.
      const bool runs = std::string_view(other.trigger) == "DirectmRPM";
      ASSERT_EQ(machine.place(), runs ? 61 : 0);
      machine.go_home();
      EXPECT_EQ(machine.get(machine.name(build.axis, "Mode")), 0);
      ASSERT_NO_FATAL_FAILURE(expect_courses(machine, {from_before(machine.place())}));
    }
  }
}

TEST(HomingCommands, IsDroppedWithServoOffOrAlarmAndKeepsTheHomeBit) {
  for (const HomingAxis& build : every_build_of({})) {
    HomingSimple2 machine({build});
    machine.set(build.axis == 'A' ? "DIN0_Aaxis_Alarm" : "DIN5_Baxis_Alarm", 1);
    machine.go_home();
    EXPECT_EQ(machine.milliseconds_to_end(), 135);
    const auto expect_dropped = [&] {
      for (const std::string& trigger : {machine.name(build.axis, "GoHome"), std::string("ALL_GoHome")}) {
        machine.set(trigger, 1);
        EXPECT_FALSE(machine.is_moving());
        EXPECT_FALSE(machine.homing());
        machine.step_by(50);
        EXPECT_EQ(machine.place(), 100);
        EXPECT_TRUE(machine.homed());
      }
    };
    machine.set(machine.name(build.axis, "SVON"), 0);
    expect_dropped();
    machine.set(machine.name(build.axis, "SVON"), 1);
    EXPECT_FALSE(machine.is_moving()) << "a dropped command does not come back";
    machine.input(build.input_of(0), true);
    machine.step();
    expect_dropped();
    machine.input(build.input_of(0), false);
    machine.step();
    EXPECT_FALSE(machine.is_moving());
  }
}

TEST(HomingCommands, ToAllTakesOnlyTheAxisWhoseServoIsOn) {
  HomingSimple2 machine({{.axis = 'A'}, {.axis = 'B', .direction = -1}});
  machine.set("Aaxis_SVON", 0);
  machine.set("ALL_GoHome", 1);
  machine.step_by(136);
  EXPECT_EQ(machine.place(0), 0);
  EXPECT_FALSE(machine.homed(0));
  EXPECT_EQ(machine.place(1), 100);
  EXPECT_TRUE(machine.homed(1));
}

TEST(HomingCommands, AZeroWrittenToItsTriggersDoesNothing) {
  HomingSimple2 machine({HomingAxis{}});
  for (const char* trigger : {"Aaxis_GoHome", "Baxis_GoHome", "ALL_GoHome"}) machine.set(trigger, 0);
  EXPECT_FALSE(machine.is_moving());
  machine.go_home();
  machine.step_by(51);
  for (const char* trigger : {"Aaxis_GoHome", "Baxis_GoHome", "ALL_GoHome"}) machine.set(trigger, 0);
  EXPECT_TRUE(machine.homing());
  EXPECT_EQ(machine.milliseconds_to_end(), 135 - 51);
}

// --- what it leaves behind ---

TEST(HomingCommands, TheHomeBitOutlastsEverythingButTheNextHoming) {
  for (const HomingAxis& build : every_build_of({})) {
    HomingSimple2 machine({build});
    const auto name = [&](std::string_view what) { return machine.name(build.axis, what); };
    machine.go_home();
    EXPECT_EQ(machine.milliseconds_to_end(), 135);
    machine.set_one_pulse_a_tick(build.axis, build.direction * -500);
    machine.set(name("Move_INC"), 1);
    machine.step_by(200);
    EXPECT_TRUE(machine.homed());
    machine.set(name("STOP"), 1);
    EXPECT_TRUE(machine.homed());
    machine.set(name("SVON"), 0);
    machine.set(name("SVON"), 1);
    EXPECT_TRUE(machine.homed());
    machine.set(build.axis == 'A' ? "Cord_A" : "Cord_B", 12345);
    machine.set(name("DirectmRPM"), 1000);
    machine.step_by(50);
    EXPECT_TRUE(machine.homed());
    machine.go_home();
    EXPECT_FALSE(machine.homed()) << "before the first tick";
  }
}

TEST(HomingCommands, AgainAndAgainItEndsOnTheSamePulse) {
  for (const HomingAxis& build : every_build_of({})) {
    HomingSimple2 machine({build});
    machine.go_home();
    EXPECT_EQ(machine.milliseconds_to_end(), 135);
    // From the edge's own pulse: off it, back on, back to it.
    const HomingCourse again{
        .legs = {run_leg(0, kBack, 100), slow_leg(5, kBack, 100, 1.25, 0.5), run_leg(15, kOn, 97),
                 slow_leg(23, kOn, 97, 3.2, 0.8), back_leg(33, 104, 4)},
        .end = 53};
    for (int i = 0; i < 10; ++i) {
      machine.go_home();
      ASSERT_NO_FATAL_FAILURE(expect_courses(machine, {again})) << i;
    }
  }
}

TEST(HomingCommands, TheCoordinateIsZeroedOrKeptAsTheFirmwareCounts) {
  for (const Firmware firmware : {139, 140, 141, 142, 150, 151, 152}) {
    for (const bool kept : {false, true}) {
      for (const HomingAxis& build : every_build_of({})) {
        SCOPED_TRACE(std::to_string(firmware) + (kept ? " kept, " : " zero, ") + text_of(build));
        HomingSimple2 machine(
            {build}, {.firmware = firmware, .choices = {{"home_coordinate", kept ? "kept" : "zero"}}});
        const std::string cord = build.axis == 'A' ? "Cord_A" : "Cord_B";
        machine.set(cord, 7000);
        machine.go_home();
        // 5 pulses past the edge and back come to nothing: 100 pulses remain. Until 1.40 the coordinate
        // counts the motor's sense.
        const int sense = build.reversed && firmware <= 140 ? -build.direction : build.direction;
        machine.step_by(116);
        EXPECT_EQ(machine.get(cord), 7000 + sense * 105);
        EXPECT_EQ(machine.milliseconds_to_end(), 135 - 116);
        EXPECT_EQ(machine.place(), 100);
        EXPECT_EQ(machine.get(cord), kept ? 7000 + sense * 100 : 0);
        EXPECT_TRUE(machine.homed());
      }
    }
  }
}

TEST(HomingCommands, AGivenUpHomingLeavesTheCoordinateAlone) {
  for (const HomingAxis& build : every_build_of({.home = {}})) {
    HomingSimple2 machine({build});
    machine.go_home();
    EXPECT_EQ(machine.milliseconds_to_end(), 611);
    EXPECT_EQ(machine.coordinate(build.axis), build.direction * -200);
  }
}

// --- speed 0 ---

TEST(HomingCommands, AtSpeed0ItHangsUntilSomethingEndsIt) {
  struct Ending {
    const char* name;
    Value value;
  };
  for (const Ending& by : {Ending{"STOP", 1}, Ending{"SVON", 0}, Ending{"Move_INC", 1}, Ending{"alarm", 1}}) {
    for (const std::int64_t start : {0, 100, 110, 150}) {
      for (const HomingAxis& build : every_build_of({.start = start, .speed_rpm = 0})) {
        SCOPED_TRACE(std::string(by.name) + ", " + text_of(build));
        HomingSimple2 machine({build});
        machine.set(build.axis == 'A' ? "DIN0_Aaxis_Alarm" : "DIN5_Baxis_Alarm", 1);
        machine.go_home();
        for (int i = 0; i < 10; ++i) {
          machine.step_by(1000);
          EXPECT_TRUE(machine.homing());
          EXPECT_TRUE(machine.is_moving());
          EXPECT_EQ(machine.get(machine.name(build.axis, "GoHome")), 1);
          EXPECT_EQ(machine.place(), start);
        }
        if (std::string_view(by.name) == "alarm") {
          machine.input(build.input_of(0), true);
          machine.step();
        } else {
          machine.set(machine.name(build.axis, by.name), by.value);  // Move_INC: by 0 pulses
        }
        EXPECT_FALSE(machine.homing());
        EXPECT_FALSE(machine.is_moving());
        EXPECT_FALSE(machine.homed());
        machine.step_by(100);
        EXPECT_EQ(machine.place(), start);
      }
    }
  }
}

TEST(HomingCommands, AtSpeed0ALimitChangesNothing) {
  // At the limit it would search the other way: as slowly. Only the second limit is the end.
  ReadySimple2 feeder;
  feeder.set("DIN2_Aaxis_UP_Limit", 1);
  feeder.set("DIN3_Aaxis_DN_Limit", 1);
  feeder.input(3, true);  // the direction is negative
  feeder.run(1);
  feeder.set("Aaxis_GoHome", 1);
  feeder.run(1000);
  EXPECT_EQ(feeder.get("STATUS.6"), 1);
  EXPECT_EQ(feeder.coordinate('A'), 0);
  feeder.input(2, true);
  feeder.run(1);
  EXPECT_EQ(feeder.get("STATUS.6"), 0);
  EXPECT_EQ(feeder.get("STATUS.8"), 0);
}

// --- programs ---

// Started at 20, the first slot is 22. Homing given in it begins in that tick; it is over in tick 22 + 135,
// which slot 158 sees; the next line has slot 160.
TEST(HomingCommands, AProgramWaitsForItInEitherWay) {
  struct Wait {
    const char* name;
    std::vector<std::uint16_t> for_a, for_b;
  };
  const std::vector<Wait> table{
      {"Move_Home_Wait", {0x28, 0, 0, 0}, {0x38, 0, 0, 0}},
      {"Move_Home_ALL_Wait", {0x48, 0, 0, 0}, {0x48, 0, 0, 0}},
      {"Move_Home, Wait_Move", {0x27, 0, 0, 0, 0x24, 9, 0, 0}, {0x37, 0, 0, 0, 0x34, 9, 0, 0}},
      {"Move_Home_ALL, Wait_Move_ALL", {0x47, 0, 0, 0, 0x44, 9, 0, 0}, {0x47, 0, 0, 0, 0x44, 9, 0, 0}},
      // Jump_STATUS_ON to itself while the homing bit is on.
      {"Move_Home, Jump_STATUS_ON", {0x27, 0, 0, 0, 0xC0, 9, 6, 9}, {0x37, 0, 0, 0, 0xC0, 9, 7, 9}},
  };
  for (const Wait& row : table) {
    for (const HomingAxis& build : every_build_of({})) {
      SCOPED_TRACE(std::string(row.name) + ", " + text_of(build));
      HomingSimple2 machine({build});
      machine.set(build.axis == 'A' ? "Baxis_SVON" : "Aaxis_SVON", 0);
      std::vector<std::uint16_t> program = build.axis == 'A' ? row.for_a : row.for_b;
      program.insert(program.end(), {0x05, 0, 1, 0, 0xFF, 0, 0, 0});  // Out 0 ON, END
      machine.write(0x4000, program);
      machine.set("PROG_MAIN_RunTime_START", 0);
      for (Tick tick = 21; tick <= 200; ++tick) {
        machine.step();
        ASSERT_EQ(machine.now(), tick);
        ASSERT_EQ(machine.homing(), tick >= 22 && tick < 22 + 135) << tick;
        ASSERT_EQ(machine.bit("DOUT_0"), tick >= 160) << tick;
        ASSERT_EQ(machine.bit("PROG_MAIN_RunTime_Status"), tick < 162) << tick;
      }
      EXPECT_EQ(machine.place(), 100);
      EXPECT_TRUE(machine.homed());
    }
  }
}

}  // namespace homing_commands_test
}  // namespace understudy::emulator::models::simple2_r3
