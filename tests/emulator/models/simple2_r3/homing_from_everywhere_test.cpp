// Homing from every place: before, on and beyond the switch, and from each limit, whole courses by the
// millisecond and the pulse.
//
// At one pulse a millisecond and ramps of 10 ms, a run from standstill has gone s(t) = t^2 / 20 pulses after
// t ms up to 10, then t - 5; slowing down from there takes another 10 ms and 5 pulses, and the way back over
// those 5 pulses two whole ramps, 20 ms. A switch is seen when a tick begins, which is the moment at which
// the tick before left the axis there.
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/models/simple2_r3/homing_machine.h"

namespace understudy::emulator::models::simple2_r3 {
namespace homing_from_everywhere_test {

constexpr int kOn = +1;  // along the direction of GoHome_DIR
constexpr int kBack = -1;

struct Case {
  const char* name;
  std::int64_t start;
  HomingCourse course;
  std::int64_t ends_on = 100;
};

// clang-format off
const std::vector<Case> kStarts{
    {"before the switch", 0,
     {.legs = {run_leg(0, kOn, 0),                     // the edge at 100 after t - 5 = 100: 105 ms
               slow_leg(105, kOn, 0, 100),             // to 105
               back_leg(115, 105, 5)},                 // 20 ms
      .end = 135}},
    {"the last pulse before the switch", 99,
     {.legs = {run_leg(0, kOn, 99),                    // 1 pulse: t^2 / 20 >= 1 in the 5th ms, at 1.25 and
               slow_leg(5, kOn, 99, 1.25, 0.5),        // half the speed: 2.5 more, so 3 whole ones, to 102
               back_leg(15, 102, 2)},
      .end = 35}},
    {"the switch's first pulse", 100,
     {.legs = {run_leg(0, kBack, 100),                 // off at 99, 5 ms and 1.25 pulses on
               slow_leg(5, kBack, 100, 1.25, 0.5),     // to 97
               run_leg(15, kOn, 97),                   // 3 pulses: in the 8th ms, at 3.2 and 0.8 of the speed
               slow_leg(23, kOn, 97, 3.2, 0.8),        // 4 more: 7 whole ones, to 104
               back_leg(33, 104, 4)},
      .end = 53}},
    {"on the switch", 110,
     {.legs = {run_leg(0, kBack, 110),                 // off at 99, 11 pulses: 16 ms
               slow_leg(16, kBack, 110, 11),           // to 94
               run_leg(26, kOn, 94),                   // 6 pulses: 11 ms
               slow_leg(37, kOn, 94, 6),               // to 105
               back_leg(47, 105, 5)},
      .end = 67}},
    {"the switch's last pulse", 120,
     {.legs = {run_leg(0, kBack, 120),                 // 21 pulses: 26 ms
               slow_leg(26, kBack, 120, 21),
               run_leg(36, kOn, 94), slow_leg(47, kOn, 94, 6), back_leg(57, 105, 5)},
      .end = 77}},
    {"the first pulse beyond the switch", 121,
     {.legs = {run_leg(0, kOn, 121),                   // the limit at 200, 79 pulses: 84 ms
               run_leg(84, kBack, 200),                // past the switch, off at 99, 101 pulses: 106 ms
               slow_leg(190, kBack, 200, 101),         // to 94
               run_leg(200, kOn, 94), slow_leg(211, kOn, 94, 6), back_leg(221, 105, 5)},
      .end = 241}},
    {"between the switch and the limit ahead", 150,
     {.legs = {run_leg(0, kOn, 150),                   // 50 pulses: 55 ms
               run_leg(55, kBack, 200), slow_leg(161, kBack, 200, 101),
               run_leg(171, kOn, 94), slow_leg(182, kOn, 94, 6), back_leg(192, 105, 5)},
      .end = 212}},
    {"two pulses before the limit ahead", 198,
     {.legs = {run_leg(0, kOn, 198),                   // 2 pulses: in the 7th ms, at 2.45
               run_leg(7, kBack, 200), slow_leg(113, kBack, 200, 101),
               run_leg(123, kOn, 94), slow_leg(134, kOn, 94, 6), back_leg(144, 105, 5)},
      .end = 164}},
    {"on the limit ahead", 200,
     {.legs = {run_leg(0, kBack, 200),                 // not one pulse on
               slow_leg(106, kBack, 200, 101),
               run_leg(116, kOn, 94), slow_leg(127, kOn, 94, 6), back_leg(137, 105, 5)},
      .end = 157}},
    {"deep in the limit ahead", 230,
     {.legs = {run_leg(0, kBack, 230),                 // 131 pulses to 99: 136 ms
               slow_leg(136, kBack, 230, 131),
               run_leg(146, kOn, 94), slow_leg(157, kOn, 94, 6), back_leg(167, 105, 5)},
      .end = 187}},
    {"between the limit behind and the switch", -150,
     {.legs = {run_leg(0, kOn, -150), slow_leg(255, kOn, -150, 250), back_leg(265, 105, 5)},
      .end = 285}},
    {"on the limit behind", -200,
     {.legs = {run_leg(0, kOn, -200), slow_leg(305, kOn, -200, 300), back_leg(315, 105, 5)},
      .end = 335}},
    {"deep in the limit behind", -230,
     {.legs = {run_leg(0, kOn, -230), slow_leg(335, kOn, -230, 330), back_leg(345, 105, 5)},
      .end = 365}},
};
// clang-format on

TEST(HomingFromEverywhere, EndsOnTheEdgeMetInItsDirectionFromEveryPlace) {
  for (const Case& row : kStarts) {
    for (const HomingAxis& build : every_build_of({.start = row.start})) {
      SCOPED_TRACE(std::string(row.name) + ", " + text_of(build));
      HomingSimple2 machine({build});
      ASSERT_EQ(machine.place(), row.start);
      machine.go_home();
      ASSERT_NO_FATAL_FAILURE(expect_courses(machine, {row.course}));
      EXPECT_EQ(machine.place(), row.ends_on);
    }
  }
}

TEST(HomingFromEverywhere, IsTheSameWhenManyTicksAreSkippedAtOnce) {
  for (const Case& row : kStarts) {
    for (const HomingAxis& build : every_build_of({.start = row.start})) {
      if (build.reversed) continue;  // its switches are wired from outside, tick by tick
      SCOPED_TRACE(std::string(row.name) + ", " + text_of(build));
      HomingSimple2 stepped({build});
      HomingSimple2 leaping({build});
      stepped.world().set_bulk_ticks(false);
      stepped.go_home();
      leaping.go_home();
      stepped.run(1000);
      leaping.run(1000);
      EXPECT_TRUE(same_state(stepped.device(), leaping.device()));
      EXPECT_EQ(leaping.place(), row.ends_on);
    }
  }
}

TEST(HomingFromEverywhere, TakesItsSpeedAndRampsFromItsParameters) {
  struct Paced {
    const char* name;
    HomingAxis machine;
    HomingCourse course;
    std::int64_t ends_on;
  };
  const auto machine = [](Value resolution, Value rpm, Value time_10ms, world::PulseSpan home) {
    HomingAxis a{.home = home, .behind = -20'000, .ahead = 20'000};
    a.resolution = resolution;
    a.speed_rpm = rpm;
    a.time_10ms = time_10ms;
    return a;
  };
  const std::vector<Paced> table{
      // 10 pulses a ms, ramps of 100 ms and 500 pulses: s = 10 (t - 50).
      {"an edge that a tick ends on",
       machine(3000, 200, 10, {1000, 1200}),
       {.legs = {run_leg(0, kOn, 0), slow_leg(150, kOn, 0, 1000, 10), back_leg(250, 1500, 500)},
        .end = 450,
        .pace = {10, 100}},
       1000},
      {"an edge within a tick is noted where that tick ends",
       machine(3000, 200, 10, {1003, 1200}),
       {.legs = {run_leg(0, kOn, 0), slow_leg(151, kOn, 0, 1010, 10), back_leg(251, 1510, 500)},
        .end = 451,
        .pace = {10, 100}},
       1010},
      // 200 RPM at 3200: 32/3 pulses a ms; 50 ms and 266 2/3 pulses of ramp: s = 32/3 (t - 25), which passes
      // 1000 in the 119th ms, at 1002 2/3; it stops 266 2/3 on, at 1269 1/3.
      {"the speed of appendix A's example",
       machine(3200, 200, 5, {1000, 1200}),
       {.legs = {run_leg(0, kOn, 0), slow_leg(119, kOn, 0, 1002 + 2 / 3.0, 32 / 3.0),
                 back_leg(169, 1269, 267)},
        .end = 269,
        .pace = {32 / 3.0, 50}},
       1002},
      // 100 kHz at most: 100 pulses a ms; 100 ms and 5000 pulses of ramp.
      {"a speed above the pulse limit",
       machine(3000, 32768, 10, {10'000, 10'100}),
       {.legs = {run_leg(0, kOn, 0), slow_leg(150, kOn, 0, 10'000, 100), back_leg(250, 15'000, 5000)},
        .end = 450,
        .pace = {100, 100}},
       10'000},
      {"a time of 0 counts as 1",
       machine(3000, 20, 0, {100, 120}),
       {.legs = {run_leg(0, kOn, 0), slow_leg(105, kOn, 0, 100), back_leg(115, 105, 5)}, .end = 135},
       100},
      // 3 s of ramp: s = t^2 / 6000 reaches 100 in the 775th ms, at 100.104, and 0.25833 of the speed;
      // from there 3000 ms and 387.5 pulses: 487.604.
      {"the edge during a long acceleration",
       machine(3000, 20, 300, {100, 120}),
       {.legs = {run_leg(0, kOn, 0), slow_leg(775, kOn, 0, 775.0 * 775 / 6000, 775 / 3000.0),
                 back_leg(3775, 487, 387)},
        .end = 9775,
        .pace = {1, 3000}},
       100},
  };
  for (const Paced& row : table) {
    for (const HomingAxis& build : every_build_of(row.machine)) {
      SCOPED_TRACE(std::string(row.name) + ", " + text_of(build));
      HomingSimple2 homing({build});
      homing.go_home();
      ASSERT_NO_FATAL_FAILURE(expect_courses(homing, {row.course}));
      EXPECT_EQ(homing.place(), row.ends_on);
    }
  }
}

TEST(HomingFromEverywhere, FromEveryPulseItEndsOnThatEdgeWithinTheLimits) {
  for (std::int64_t start = -205; start <= 205; ++start) {
    for (const char axis : {'A', 'B'}) {
      for (const int direction : {+1, -1}) {
        const HomingAxis build{
            .axis = axis, .direction = direction, .reversed = start % 2 != 0, .start = start};
        SCOPED_TRACE(text_of(build));
        HomingSimple2 machine({build});
        machine.go_home();
        const std::int64_t highest = std::max<std::int64_t>(start, 200);
        const std::int64_t lowest = std::min<std::int64_t>(start, -200);
        std::int64_t last = start;
        std::int64_t edge = 0;  // where the switch last came on
        std::int64_t edge_way = 0;
        const auto on = [](std::int64_t place) { return place >= 100 && place <= 120; };
        for (int ms = 0; machine.is_moving(); ++ms) {
          ASSERT_LT(ms, 700);
          ASSERT_TRUE(machine.homing());
          ASSERT_FALSE(machine.homed());
          machine.step();
          const std::int64_t place = machine.place();
          ASSERT_LE(place, highest);
          ASSERT_GE(place, lowest);
          ASSERT_LE(std::abs(place - last), 1);
          if (on(place) && !on(last)) {
            edge = place;
            edge_way = place - last;
          }
          last = place;
        }
        EXPECT_FALSE(machine.homing());
        EXPECT_TRUE(machine.homed());
        EXPECT_EQ(machine.place(), 100);
        EXPECT_EQ(edge, 100);
        EXPECT_EQ(edge_way, +1);
        EXPECT_EQ(machine.coordinate(axis), 0);
        EXPECT_EQ(machine.coordinate(axis == 'A' ? 'B' : 'A'), 0);
      }
    }
  }
}

TEST(HomingFromEverywhere, BothAxesAtOnceEachTakeTheirOwn) {
  for (const int direction : {+1, -1}) {
    HomingAxis slow{.axis = 'A', .direction = direction, .start = 150};
    HomingAxis fast{.axis = 'B',
                    .direction = -direction,
                    .home = world::PulseSpan{1000, 1200},
                    .behind = -2000,
                    .ahead = 2000};
    fast.speed_rpm = 200;
    fast.time_10ms = 10;
    HomingSimple2 machine({slow, fast});
    machine.set("ALL_GoHome", 1);
    EXPECT_EQ(machine.get("ALL_GoHome"), 0);
    const HomingCourse of_a{
        .legs = {run_leg(0, kOn, 150), run_leg(55, kBack, 200), slow_leg(161, kBack, 200, 101),
                 run_leg(171, kOn, 94), slow_leg(182, kOn, 94, 6), back_leg(192, 105, 5)},
        .end = 212};
    const HomingCourse of_b{
        .legs = {run_leg(0, kOn, 0), slow_leg(150, kOn, 0, 1000, 10), back_leg(250, 1500, 500)},
        .end = 450,
        .pace = {10, 100}};
    ASSERT_NO_FATAL_FAILURE(expect_courses(machine, {of_a, of_b}));
  }
}

}  // namespace homing_from_everywhere_test
}  // namespace understudy::emulator::models::simple2_r3
