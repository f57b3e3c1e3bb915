// Homing with unusual switches: home at a limit, narrow, or missing; and when homing gives up. Courses as in
// homing_from_everywhere_test.cpp.
#include "tests/emulator/models/simple2_r3/homing_machine.h"

namespace understudy::emulator::models::simple2_r3 {
namespace homing_switches_test {

constexpr int kOn = +1;
constexpr int kBack = -1;

struct Case {
  const char* name;
  HomingAxis machine;
  HomingCourse course;
  std::int64_t ends_on;
};

void expect_all(const std::vector<Case>& table) {
  for (const Case& row : table) {
    for (const HomingAxis& build : every_build_of(row.machine)) {
      SCOPED_TRACE(std::string(row.name) + ", " + text_of(build));
      HomingSimple2 machine({build});
      machine.go_home();
      ASSERT_NO_FATAL_FAILURE(expect_courses(machine, {row.course}));
      EXPECT_EQ(machine.place(), row.ends_on);
    }
  }
}

// A limit is seen in the tick after the one that reached it, which is when homing is over.
TEST(HomingSwitches, ASecondLimitEndsItWithoutHome) {
  expect_all({
      {"no switch",
       {.home = {}},
       // 200 pulses: 205 ms; then 400 the other way: 405 ms.
       {.legs = {run_leg(0, kOn, 0), run_leg(205, kBack, 200), stand_leg(610, -200)},
        .end = 611,
        .found = false},
       -200},
      {"no switch, from the limit ahead",
       {.start = 200, .home = {}},
       {.legs = {run_leg(0, kBack, 200), stand_leg(405, -200)}, .end = 406, .found = false},
       -200},
      {"no switch, from the limit behind",
       {.start = -200, .home = {}},
       {.legs = {run_leg(0, kOn, -200), run_leg(405, kBack, 200), stand_leg(810, -200)},
        .end = 811,
        .found = false},
       -200},
      {"the home input is not assigned",
       {.home_assigned = false},
       {.legs = {run_leg(0, kOn, 0), run_leg(205, kBack, 200), stand_leg(610, -200)},
        .end = 611,
        .found = false},
       -200},
      {"the switch is beyond the limit ahead",
       {.home = world::PulseSpan{203, 210}},
       {.legs = {run_leg(0, kOn, 0), run_leg(205, kBack, 200), stand_leg(610, -200)},
        .end = 611,
        .found = false},
       -200},
      {"the switch is beyond the limit behind",
       {.home = world::PulseSpan{-210, -201}},
       {.legs = {run_leg(0, kOn, 0), run_leg(205, kBack, 200), stand_leg(610, -200)},
        .end = 611,
        .found = false},
       -200},
      // Off the switch at -196, after 396 pulses: 401 ms, at 606; it would stop at -201, but the limit comes
      // after 400, when u - u^2 / 20 >= 4: in the 6th ms.
      {"the limit behind is too near the switch to turn before it",
       {.home = world::PulseSpan{-195, -190}},
       {.legs = {run_leg(0, kOn, 0), run_leg(205, kBack, 200), slow_leg(606, kBack, 200, 396),
                 stand_leg(612, -200)},
        .end = 613,
        .found = false},
       -200},
      // Leaving the switch, 5 pulses: 10 ms.
      {"from a switch that covers the limit behind",
       {.start = -195, .home = world::PulseSpan{-210, -190}},
       {.legs = {run_leg(0, kBack, -195), stand_leg(10, -200)}, .end = 11, .found = false},
       -200},
  });
}

TEST(HomingSwitches, ASwitchAtTheLimitAheadIsFound) {
  expect_all({
      // 195 pulses: 200 ms. It stops on the limit's first pulse, at 200.
      {"5 pulses before the limit",
       {.home = world::PulseSpan{195, 210}},
       {.legs = {run_leg(0, kOn, 0), slow_leg(200, kOn, 0, 195), back_leg(210, 200, 5)}, .end = 230},
       195},
      // 197: 202 ms; the limit 3 on, u - u^2 / 20 >= 3 in the 4th ms; it stops there.
      {"3 pulses before the limit",
       {.home = world::PulseSpan{197, 210}},
       {.legs = {run_leg(0, kOn, 0), slow_leg(202, kOn, 0, 197), back_leg(206, 200, 3)}, .end = 226},
       197},
      // Both are seen in the 206th ms, and there is no way back to go.
      {"at the limit's own pulse",
       {.home = world::PulseSpan{200, 210}},
       {.legs = {run_leg(0, kOn, 0), stand_leg(205, 200)}, .end = 206},
       200},
      {"from beyond it, on the limit and off the switch",
       {.start = 215, .home = world::PulseSpan{195, 210}},
       // 21 pulses to 194: 26 ms; to 189; 6 pulses: 11 ms; then 5 on to the limit's first pulse.
       {.legs = {run_leg(0, kBack, 215), slow_leg(26, kBack, 215, 21), run_leg(36, kOn, 189),
                 slow_leg(47, kOn, 189, 6), back_leg(57, 200, 5)},
        .end = 77},
       195},
      {"from both at once",
       {.start = 205, .home = world::PulseSpan{196, 210}},
       // 10 pulses to 195: 15 ms; to 190; 6 pulses: 11 ms; 4 on to the limit: in the 6th ms.
       {.legs = {run_leg(0, kBack, 205), slow_leg(15, kBack, 205, 10), run_leg(25, kOn, 190),
                 slow_leg(36, kOn, 190, 6), back_leg(42, 200, 4)},
        .end = 62},
       196},
  });
}

TEST(HomingSwitches, ASwitchOfOnePulseIsFoundFromBothSides) {
  expect_all({
      {"before",
       {.home = world::PulseSpan{100, 100}},
       {.legs = {run_leg(0, kOn, 0), slow_leg(105, kOn, 0, 100), back_leg(115, 105, 5)}, .end = 135},
       100},
      {"beyond",
       {.start = 150, .home = world::PulseSpan{100, 100}},
       {.legs = {run_leg(0, kOn, 150), run_leg(55, kBack, 200), slow_leg(161, kBack, 200, 101),
                 run_leg(171, kOn, 94), slow_leg(182, kOn, 94, 6), back_leg(192, 105, 5)},
        .end = 212},
       100},
  });
}

// 10 pulses per tick: of ten neighbouring pulses a tick ends on one, and only there the inputs are looked at.
TEST(HomingSwitches, ANarrowSwitchIsFoundOnlyIfATickEndsOnIt) {
  for (std::int64_t offset = 0; offset < 10; ++offset) {
    for (std::int64_t width = 1; width <= 10; ++width) {
      // From -offset, ticks at full speed end on ..., 1000 + last_digit, ...
      const std::int64_t last_digit = offset == 0 ? 10 : 10 - offset;
      const bool found = last_digit <= width;
      HomingAxis axis{
          .start = -offset, .home = world::PulseSpan{1001, 1000 + width}, .behind = -2000, .ahead = 2000};
      axis.speed_rpm = 200;
      axis.time_10ms = 10;
      for (const HomingAxis& build : every_build_of(axis)) {
        SCOPED_TRACE(text_of(build) + ", " + std::to_string(width) + " wide");
        HomingSimple2 machine({build});
        machine.go_home();
        const Tick took = machine.milliseconds_to_end();
        EXPECT_EQ(machine.homed(), found);
        if (found) {
          // 10 (t - 50) = 1000 + last_digit + offset = 1010: 151 ms; 100 to stop, 200 back.
          EXPECT_EQ(took, 451);
          EXPECT_EQ(machine.place(), 1000 + last_digit);
          EXPECT_EQ(machine.coordinate(build.axis), 0);
        } else {
          // The limits are overrun by what a tick brings at most: up to 2000 + last_digit after 50 + 201 ms,
          // then 4010 pulses down in 50 + 401. From 0 on it stops on the limits' first pulses.
          EXPECT_EQ(took, offset == 0 ? 250 + 450 + 1 : 251 + 451 + 1);
          EXPECT_EQ(machine.place(), offset == 0 ? -2000 : -2010 + last_digit);
        }
      }
    }
  }
}

TEST(HomingSwitches, WithBothLimitsOnItEndsBeforeItBegins) {
  for (const HomingAxis& build : every_build_of({.behind = {}, .ahead = {}})) {
    HomingSimple2 machine({build});
    machine.input(build.ahead_input(), true);
    machine.input(build.behind_input(), true);
    machine.step();
    machine.go_home();
    machine.step_by(100);
    EXPECT_FALSE(machine.is_moving());
    EXPECT_FALSE(machine.homing());
    EXPECT_FALSE(machine.homed());
    EXPECT_EQ(machine.place(), 0);
  }
}

// The edge that counts is out of reach behind the limit.
TEST(HomingSwitches, OnASwitchOverTheLimitBehindItEndsBeforeItBegins) {
  for (const HomingAxis& build : every_build_of({.start = -205, .home = world::PulseSpan{-210, -190}})) {
    HomingSimple2 machine({build});
    machine.go_home();
    machine.step_by(100);
    EXPECT_FALSE(machine.is_moving());
    EXPECT_FALSE(machine.homing());
    EXPECT_FALSE(machine.homed());
    EXPECT_EQ(machine.place(), -205);
  }
}

TEST(HomingSwitches, LimitsPressedByHandCountAsReached) {
  // At 25 after 30 ms it turns, and at 25 - 65 after another 70 it gives up.
  const HomingCourse course{
      .legs = {run_leg(0, kOn, 0), run_leg(30, kBack, 25), stand_leg(100, -40)}, .end = 101, .found = false};
  for (const HomingAxis& build : every_build_of({.behind = {}, .ahead = {}})) {
    HomingSimple2 machine({build});
    machine.go_home();
    const Tick begin = machine.now() + 1;
    for (Tick ms = 0; ms <= 200; ++ms) {
      machine.step();
      ASSERT_EQ(machine.now(), begin + ms);
      ASSERT_EQ(machine.place(), course.place_at(ms)) << ms;
      ASSERT_EQ(machine.homing(), ms < 101) << ms;
      ASSERT_FALSE(machine.homed());
      if (ms == 30) machine.input(build.ahead_input(), true);
      if (ms == 50) machine.input(build.ahead_input(), false);
      if (ms == 100) machine.input(build.behind_input(), true);
    }
  }
}

TEST(HomingSwitches, ALimitOnTheSideItComesFromIsNoMatter) {
  // Held on all the way: the search in the direction does not meet it, nor does the way back begin on it.
  const HomingCourse course{.legs = {run_leg(0, kOn, 0), slow_leg(105, kOn, 0, 100), back_leg(115, 105, 5)},
                            .end = 135};
  for (const HomingAxis& build : every_build_of({.behind = {}, .ahead = {}})) {
    HomingSimple2 machine({build});
    machine.input(build.behind_input(), true);
    machine.step();
    machine.go_home();
    for (Tick ms = 0; ms <= 110; ++ms) {
      machine.step();
      ASSERT_EQ(machine.place(), course.place_at(ms)) << ms;
      ASSERT_TRUE(machine.homing());
    }
  }
}

TEST(HomingSwitches, WithoutAnyItRunsOnUntilStop) {
  // Against the machine's end the motor loses steps, of which the controller knows nothing.
  HomingAxis blind{.home_assigned = false, .limits_assigned = false};
  for (const HomingAxis& build : every_build_of(blind)) {
    HomingSimple2 machine({build});
    machine.go_home();
    machine.step_by(10'001);
    EXPECT_TRUE(machine.homing());
    EXPECT_TRUE(machine.is_moving());
    EXPECT_EQ(machine.place(), 10'000 - 5);
    machine.set(machine.name(build.axis, "STOP"), 1);
    EXPECT_FALSE(machine.homing());
    EXPECT_FALSE(machine.is_moving());
    machine.step_by(100);
    EXPECT_EQ(machine.place(), 10'000 - 5);
    EXPECT_FALSE(machine.homed());
  }
}

TEST(HomingSwitches, AgainstTheMachinesEndStepsAreLostAndItContinues) {
  world::PlantSetup plant;
  plant.travel = world::PulseSpan{-50, 300};
  ReadySimple2 machine({.plant = {{0, plant}}});
  machine.set("Aaxis_Resoultion", 3000);
  machine.set("Aaxis_Home_Speed", 20);
  machine.set("Axis_GoHome_DIR", 1);
  machine.set("DIN4_Aaxis_Home", 1);
  machine.set("Aaxis_GoHome", 1);
  machine.run(1001);
  EXPECT_EQ(machine.world().plant(0, 0).position_pulses(), 300);
  EXPECT_EQ(machine.world().plant(0, 0).lost_pulses(), 695);
  EXPECT_EQ(machine.coordinate('A'), 995);
  EXPECT_TRUE(machine.bit("STATUS.6"));
}

TEST(HomingSwitches, WithLimitReactionNoneItPassesThem) {
  Given given;
  given.choices["limit_reaction"] = "none";
  for (const HomingAxis& build : every_build_of({.home = world::PulseSpan{300, 320}})) {
    SCOPED_TRACE(text_of(build));
    HomingSimple2 machine({build}, given);
    machine.go_home();
    const HomingCourse course{.legs = {run_leg(0, kOn, 0), slow_leg(305, kOn, 0, 300), back_leg(315, 305, 5)},
                              .end = 335};
    ASSERT_NO_FATAL_FAILURE(expect_courses(machine, {course}));
  }
}

}  // namespace homing_switches_test
}  // namespace understudy::emulator::models::simple2_r3
