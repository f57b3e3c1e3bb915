// Homing that is stopped, dropped or restarted, in each of its phases.
//
// From between the switch and the limit ahead homing has all its phases; its times are worked out in
// homing_from_everywhere_test.cpp.
#include <functional>

#include "tests/emulator/models/simple2_r3/homing_machine.h"

namespace understudy::emulator::models::simple2_r3 {
namespace homing_interrupted_test {

constexpr int kOn = +1;
constexpr int kBack = -1;
constexpr std::int64_t kStart = 150;

const HomingCourse kWhole{.legs = {run_leg(0, kOn, 150),            // towards the limit
                                   run_leg(55, kBack, 200),         // the other way, and past the switch
                                   slow_leg(161, kBack, 200, 101),  // off it
                                   run_leg(171, kOn, 94),           // the approach
                                   slow_leg(182, kOn, 94, 6),       // past the edge
                                   back_leg(192, 105, 5)},          // back to it
                          .end = 212};

struct Moment {
  Tick ms;
  const char* phase;
  std::int64_t place;  // then
};

const std::vector<Moment> kMoments{
    {0, "before the first pulse", 150},
    {30, "towards the limit", 175},                  // 150 + 25
    {55, "on the limit", 200},                       // it is seen in the tick after
    {100, "the other way, before the switch", 160},  // 200 - 40
    {145, "the other way, on the switch", 115},      // 200 - 85
    {165, "slowing down off the switch", 96},        // 200 - (101 + 4 - 0.8)
    {176, "the approach", 95},                       // 94 + 1.25
    {187, "slowing down past the edge", 103},        // 94 + (6 + 5 - 1.25)
    {200, "on the way back to the edge", 104},       // 105 - 5 * 64 / 200
};

/// On kStart with the home bit lit: it has found home once, and has moved away from there.
struct HomedSimple2 : HomingSimple2 {
  explicit HomedSimple2(const HomingAxis& build, const Given& given = {})
      : HomingSimple2({at_start(build)}, given) {
    set(build.axis == 'A' ? "DIN0_Aaxis_Alarm" : "DIN5_Baxis_Alarm", 1);
    go_home();
    EXPECT_GT(milliseconds_to_end(), 0);
    set_one_pulse_a_tick(build.axis, build.direction * 50);
    set(name(build.axis, "Move_INC"), 1);
    EXPECT_EQ(milliseconds_to_end(), 60);
    EXPECT_EQ(place(), kStart);
    EXPECT_TRUE(homed()) << "a move does not change the home bit";
  }
  static HomingAxis at_start(HomingAxis build) {
    build.start = kStart;
    return build;
  }

  void go_home_until(const Moment& moment) {
    go_home();
    step_by(moment.ms + 1);
    EXPECT_EQ(place(), moment.place) << moment.phase;
    EXPECT_TRUE(homing());
    EXPECT_FALSE(homed()) << "off as soon as homing starts";
  }
  void expect_at_rest(const Moment& moment) {
    const char letter = axis().axis;
    EXPECT_EQ(place(), moment.place);
    EXPECT_EQ(coordinate(letter), axis().direction * (moment.place - 100));
    EXPECT_FALSE(is_moving());
    EXPECT_FALSE(homing());
    EXPECT_FALSE(homed());
    EXPECT_EQ(get(name(letter, "GoHome")), 0);
    EXPECT_EQ(get(name(letter, "Mode")), 0);
  }
  void alarm(bool on) { input(axis().input_of(0), on); }
};

struct Interruption {
  const char* name;
  std::function<void(HomedSimple2&)> begin;
  std::function<void(HomedSimple2&)> end = [](HomedSimple2&) {};
  Tick acts_after = 0;
};

const std::vector<Interruption> kInterruptions{
    {"STOP", [](HomedSimple2& m) { m.set(m.name(m.axis().axis, "STOP"), 1); }},
    {"ALL_STOP", [](HomedSimple2& m) { m.set("ALL_STOP", 1); }},
    {"SVOFF", [](HomedSimple2& m) { m.set(m.name(m.axis().axis, "SVON"), 0); },
     [](HomedSimple2& m) { m.set(m.name(m.axis().axis, "SVON"), 1); }},
    {"ALL_SVON 0", [](HomedSimple2& m) { m.set("ALL_SVON", 0); },
     [](HomedSimple2& m) { m.set("ALL_SVON", 1); }},
    {"an increment of 0",
     [](HomedSimple2& m) {
       m.set(m.name(m.axis().axis, "Pulse"), 0);
       m.set(m.name(m.axis().axis, "Move_INC"), 1);
     }},
    {"a move to where it is",
     [](HomedSimple2& m) {
       m.set(m.name(m.axis().axis, "Pulse"), m.coordinate(m.axis().axis));
       m.set(m.name(m.axis().axis, "Move_ABS"), 1);
     }},
    {"an alarm", [](HomedSimple2& m) { m.alarm(true); },
     [](HomedSimple2& m) {
       m.alarm(false);
       m.step();
     },
     1},  // seen when the next tick begins
};

TEST(HomingInterrupted, StandsAtOnceInEveryPhaseAndFindsHomeAfterwards) {
  for (const HomingAxis& build : every_build_of({})) {
    for (const Moment& moment : kMoments) {
      for (const Interruption& by : kInterruptions) {
        SCOPED_TRACE(std::string(by.name) + ", " + moment.phase + ", " + text_of(build));
        HomedSimple2 machine(build);
        machine.go_home_until(moment);
        by.begin(machine);
        machine.step_by(by.acts_after);
        machine.expect_at_rest(moment);
        machine.step_by(300);
        machine.expect_at_rest(moment);
        by.end(machine);
        machine.expect_at_rest(moment);
        machine.go_home();
        EXPECT_TRUE(machine.homing());
        EXPECT_GT(machine.milliseconds_to_end(), 0);
        EXPECT_EQ(machine.place(), 100);
        EXPECT_EQ(machine.coordinate(build.axis), 0);
        EXPECT_TRUE(machine.homed());
      }
    }
  }
}

TEST(HomingInterrupted, ByAProgramInItsSlot) {
  struct Instruction {
    const char* name;
    std::uint16_t for_a, for_b;
  };
  for (const Instruction& by : {Instruction{"STOP", 0x2F, 0x3F}, Instruction{"STOP_ALL", 0x4F, 0x4F},
                                Instruction{"SVOFF", 0x2B, 0x3B}, Instruction{"SVOFF_ALL", 0x4B, 0x4B}}) {
    for (const HomingAxis& build : every_build_of({})) {
      for (const Moment& moment : kMoments) {
        SCOPED_TRACE(std::string(by.name) + ", " + moment.phase + ", " + text_of(build));
        HomedSimple2 machine(build);
        machine.write(0x4000, {build.axis == 'A' ? by.for_a : by.for_b, 0, 0, 0, 0xFF, 0, 0, 0});
        // The line is executed in an even tick, the one after the moment, before the axes have their turn.
        if ((machine.now() + 1 + moment.ms) % 2 == 0) machine.step();
        machine.go_home_until(moment);
        ASSERT_EQ(machine.now() % 2, 1);
        machine.set("PROG_MAIN_RunTime_START", 0);
        EXPECT_TRUE(machine.homing());
        machine.step();
        machine.expect_at_rest(moment);
        machine.step_by(300);
        machine.expect_at_rest(moment);
      }
    }
  }
}

TEST(HomingInterrupted, FactoryResetStopsItAndPutsTheHomeBitOut) {
  for (const Moment& moment : kMoments) {
    HomedSimple2 machine(HomingAxis{});
    machine.go_home_until(moment);
    machine.set("Factory_Reset", 1);
    machine.step_by(300);
    EXPECT_EQ(machine.place(), moment.place);
    EXPECT_EQ(machine.status(), 0);
  }
  HomedSimple2 homed(HomingAxis{});
  homed.set("Factory_Reset", 1);
  EXPECT_FALSE(homed.homed());
}

// By hand from the place at each moment: it begins again there, from standstill.
TEST(HomingInterrupted, RestartedItBeginsFromStandstillWhereItIs) {
  struct Anew {
    std::size_t moment;
    HomingCourse course;
  };
  // clang-format off
  const std::vector<Anew> table{
      {1, {.legs = {run_leg(0, kOn, 175),                    // 25 pulses to the limit: 30 ms
                    run_leg(30, kBack, 200), slow_leg(136, kBack, 200, 101),
                    run_leg(146, kOn, 94), slow_leg(157, kOn, 94, 6), back_leg(167, 105, 5)},
           .end = 187}},
      {3, {.legs = {run_leg(0, kOn, 160),                    // 40 pulses: 45 ms
                    run_leg(45, kBack, 200), slow_leg(151, kBack, 200, 101),
                    run_leg(161, kOn, 94), slow_leg(172, kOn, 94, 6), back_leg(182, 105, 5)},
           .end = 202}},
      {4, {.legs = {run_leg(0, kBack, 115),                  // on the switch: 16 pulses to 99: 21 ms
                    slow_leg(21, kBack, 115, 16),
                    run_leg(31, kOn, 94), slow_leg(42, kOn, 94, 6), back_leg(52, 105, 5)},
           .end = 72}},
      {5, {.legs = {run_leg(0, kOn, 96),                     // 4 pulses: in the 9th ms, at 4.05 and 0.9
                    slow_leg(9, kOn, 96, 4.05, 0.9),         // to 8.55
                    back_leg(19, 104, 4)},
           .end = 39}},
      {6, {.legs = {run_leg(0, kOn, 95),                     // 5 pulses: 10 ms
                    slow_leg(10, kOn, 95, 5), back_leg(20, 105, 5)},
           .end = 40}},
      {7, {.legs = {run_leg(0, kBack, 103),                  // on the switch: 4 pulses to 99
                    slow_leg(9, kBack, 103, 4.05, 0.9),      // to 95
                    run_leg(19, kOn, 95), slow_leg(29, kOn, 95, 5), back_leg(39, 105, 5)},
           .end = 59}},
      {8, {.legs = {run_leg(0, kBack, 104),                  // on the switch: 5 pulses to 99: 10 ms
                    slow_leg(10, kBack, 104, 5),             // to 94
                    run_leg(20, kOn, 94), slow_leg(31, kOn, 94, 6), back_leg(41, 105, 5)},
           .end = 61}},
  };
  // clang-format on
  for (const HomingAxis& build : every_build_of({})) {
    for (const Anew& row : table) {
      SCOPED_TRACE(std::string(kMoments[row.moment].phase) + ", " + text_of(build));
      HomedSimple2 machine(build);
      machine.go_home_until(kMoments[row.moment]);
      machine.go_home();
      ASSERT_NO_FATAL_FAILURE(expect_courses(machine, {row.course}));
      EXPECT_EQ(machine.place(), 100);
    }
  }
}

TEST(HomingInterrupted, OnlyItsOwnAxisMatters) {
  // B homes while A stops, is switched off and has an alarm.
  HomingSimple2 machine({{.axis = 'B', .start = kStart}});
  machine.set("DIN0_Aaxis_Alarm", 1);
  machine.set_one_pulse_a_tick('A', 1000);
  machine.set("Aaxis_Move_INC", 1);
  machine.go_home();
  const Tick begin = machine.now() + 1;
  for (Tick ms = 0; ms <= kWhole.end; ++ms) {
    machine.step();
    ASSERT_EQ(machine.now(), begin + ms);
    ASSERT_EQ(machine.place(), kWhole.place_at(ms)) << ms;
    ASSERT_EQ(machine.homed(), ms == kWhole.end) << ms;
    if (ms == 30) machine.set("Aaxis_STOP", 1);
    if (ms == 60) machine.set("Aaxis_GoHome", 1);
    if (ms == 90) machine.input(0, true);
    if (ms == 120) machine.input(0, false);
    if (ms == 150) machine.set("Aaxis_SVON", 0);
  }
}

TEST(HomingInterrupted, ItsParametersAreThoseOfItsBeginning) {
  for (const HomingAxis& build : every_build_of({.start = kStart})) {
    SCOPED_TRACE(text_of(build));
    HomingSimple2 machine({build});
    machine.go_home();
    machine.set(machine.name(build.axis, "Home_Speed"), 1000);
    machine.set(machine.name(build.axis, "Home_AccTime"), 77);
    machine.set(machine.name(build.axis, "Resoultion"), 123);
    machine.set(machine.direction_name(build.axis), build.direction < 0);
    ASSERT_NO_FATAL_FAILURE(expect_courses(machine, {kWhole}));
  }
}

TEST(HomingInterrupted, AnAlarmStopsNothingWithAlarmReactionNone) {
  Given given;
  given.choices["alarm_reaction"] = "none";
  HomedSimple2 machine(HomingAxis{}, given);
  machine.alarm(true);
  machine.step();
  machine.go_home();
  EXPECT_EQ(machine.milliseconds_to_end(), kWhole.end);
  EXPECT_EQ(machine.place(), 100);
  EXPECT_TRUE(machine.homed());
}

}  // namespace homing_interrupted_test
}  // namespace understudy::emulator::models::simple2_r3
