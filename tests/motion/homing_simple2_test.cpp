#include "tests/motion/homing_bench.h"

// Simple2-R3 and SLIM. Simple2-R3's ramps take a fixed time, whatever the change of speed: 0.1 s at 10000
// pps, so it stops 500 pulses after an edge at full speed, and v / 20 after one at speed v.
//
//   limit-                     home                      limit+
//   ═══╗                      ╔════╗                    ╔═════
//    -80000        0       50000  50200               80000
namespace understudy::motion {
namespace homing_simple2_test {

constexpr double kPps = 10'000;
constexpr double kRampS = 0.1;

SpeedLaw by_times() {
  return {.top_speed_u_s = kPps, .up = RampLaw::by_time(kRampS), .down = RampLaw::by_time(kRampS)};
}

Environment machine() {
  Environment environment;
  environment.add(Signal::limit_minus, -kFar, -80'000);
  environment.add(Signal::home, 50'000, 50'200);
  environment.add(Signal::limit_plus, 80'000, kFar);
  return environment;
}

struct Case {
  const char* name;
  std::int64_t start;
  Trace trace;
  Ending ending{};
  std::int64_t reference = 50'000;
};

void expect(const Case& wanted, const Environment& environment) {
  for (const bool turned : {false, true}) {
    SCOPED_TRACE(std::string(wanted.name) + (turned ? ", mirrored" : ""));
    HomingBench bench(turned ? mirrored(environment) : environment, turned ? -wanted.start : wanted.start);
    ASSERT_EQ(bench.home(simple2_homing({.direction = turned ? -1 : +1, .speed = by_times()})), Cause::none);
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.trace, turned ? mirrored(wanted.trace) : wanted.trace);
    expect_ended(bench, {.by = turned ? mirrored(wanted.ending.by) : wanted.ending.by,
                         .in_row = wanted.ending.in_row});
    if (wanted.ending.by == Cause::arrived) {
      const std::int64_t reference = turned ? -wanted.reference : wanted.reference;
      EXPECT_EQ(bench.axis.homing.reference_pulses, reference);
      EXPECT_EQ(bench.axis.travel_pulses, reference);
    }
  }
}

TEST(HomingSimple2, EndsOnTheSameEdgeFromEveryPlace) {
  // Rows: 0 approach, 1 leaving the switch, 2 the other direction, 3 on past the switch, 4 approach, 5 to the
  // edge. On the switch: it leaves over 101 pulses, so at sqrt(2 a 101) = 4494 pps, and stops 224 after; then
  // returns over 225 pulses, at 6708 pps, and stops 335 after.
  const std::vector<Case> table = {
      {"before", 0, {{0, +1, 50'500}, {5, -1, 50'000}}},
      {"on it", 50'100, {{1, -1, 49'775}, {0, +1, 50'335}, {5, -1, 50'000}}},
      {"beyond",
       60'000,
       {{0, +1, 80'000}, {2, -1, kRunsOn}, {3, -1, 49'499}, {4, +1, 50'500}, {5, -1, 50'000}}},
      {"on the far limit", 80'500, {{2, -1, kRunsOn}, {3, -1, 49'499}, {4, +1, 50'500}, {5, -1, 50'000}}},
      {"on the near limit", -80'500, {{0, +1, 50'500}, {5, -1, 50'000}}},
  };
  for (const Case& wanted : table) expect(wanted, machine());
}

TEST(HomingSimple2, GivesUpOnTheSecondLimit) {
  Environment environment = machine();
  environment.zones[1].to = environment.zones[1].from - 1;  // no switch
  expect({"no switch", 0, {{0, +1, 80'000}, {2, -1, -80'000}}, {.by = Cause::limit_minus, .in_row = 2}},
         environment);
}

TEST(HomingSimple2, ALimitJustBehindTheEdgeDoesNoHarm) {
  Environment environment = machine();
  environment.zones[1] = {.signal = Signal::home, .from = 79'800, .to = kFar};
  expect({"limit 200 behind", 0, {{0, +1, 80'000}, {5, -1, 79'800}}, {}, 79'800}, environment);
}

TEST(HomingSimple2, ASwitchThatReachesBackToTheLimitCannotBeLeft) {
  Environment environment = machine();
  environment.zones[1] = {.signal = Signal::home, .from = -kFar, .to = 50'200};
  expect({"on without end", 0, {{1, -1, -80'000}}, {.by = Cause::limit_minus, .in_row = 1}}, environment);
}

TEST(HomingSimple2, ReturnsToTheEdgeAsItWasWhenNoted) {
  HomingBench bench(machine(), 0);
  ASSERT_EQ(bench.home(simple2_homing({.direction = +1, .speed = by_times()})), Cause::none);
  while (!bench.axis.homing.met) bench.step();
  bench.environment.zones[1].from = 50'150;
  ++bench.environment.version;
  ASSERT_TRUE(bench.run());
  EXPECT_EQ(bench.axis.travel_pulses, 50'000);
}

TEST(HomingSimple2, AtSpeed0ItHangsUntilStopped) {
  SpeedLaw still = by_times();
  still.top_speed_u_s = 0;
  HomingBench bench(machine(), 0);
  ASSERT_EQ(bench.home(simple2_homing({.direction = +1, .speed = still})), Cause::none);
  EXPECT_FALSE(bench.run(5000));
  EXPECT_TRUE(bench.axis.moving());
  EXPECT_EQ(bench.pulses_out, 0);
  bench.axis.stop();
  bench.step();
  expect_ended(bench, {.by = Cause::stopped, .in_row = 0});
}

TEST(HomingSimple2, TakesTheTimeOfItsLegs) {
  HomingBench bench(machine(), 0);
  const Tick begun = bench.now + 1;
  ASSERT_EQ(bench.home(simple2_homing({.direction = +1, .speed = by_times()})), Cause::none);
  ASSERT_TRUE(bench.run());
  // 49500 at full speed after 500 of acceleration; back over 500 in two ramps, at 5000 pps.
  EXPECT_NEAR(static_cast<double>(bench.now - begun), 100 + 4950 + 100 + 200, 3.0);
}

constexpr double kJogPps = 100.0 * 10'000 / 60;  // 100 rpm, 10000 pulses per revolution
constexpr double kJogSlope = 50'000;

TEST(HomingSlim, RunsUntilHorgAndSlowsDownThere) {
  struct Row {
    const char* name;
    int direction;
    std::int64_t start;
    Trace trace;
    std::int64_t reference;
  };
  Environment environment;
  environment.add(Signal::home, -6000, -5000);
  const auto behind = static_cast<std::int64_t>(brake_pulses(kJogPps, kJogSlope));
  ASSERT_EQ(behind, 2777);
  // From -4000 it has accelerated over only 1000 pulses, and needs as many to stop.
  const std::vector<Row> table = {
      {"before", -1, 20'000, {{0, -1, -5000 - behind}}, -5000},
      {"on it", -1, -5500, {}, -5500},
      {"near it", -1, -4000, {{0, -1, -6000}}, -5000},
      {"from the other side, VJ negative", +1, -26'000, {{0, +1, -6000 + behind}}, -6000},
  };
  for (const Row& row : table) {
    for (const bool turned : {false, true}) {
      SCOPED_TRACE(std::string(row.name) + (turned ? ", mirrored" : ""));
      HomingBench bench(turned ? mirrored(environment) : environment, turned ? -row.start : row.start);
      const int direction = turned ? -row.direction : row.direction;
      ASSERT_EQ(bench.home(slim_homing({.direction = direction, .jog = slope_law(kJogPps, kJogSlope)})),
                Cause::none);
      bench.step();
      ASSERT_TRUE(bench.run());
      EXPECT_EQ(bench.trace, turned ? mirrored(row.trace) : row.trace);
      EXPECT_EQ(bench.axis.homing.reference_pulses, turned ? -row.reference : row.reference);
      expect_ended(bench, {});
    }
  }
}

TEST(HomingSlim, WithoutHorgItRunsUntilStopped) {
  HomingBench bench(Environment{}, 0);
  ASSERT_EQ(bench.home(slim_homing({.direction = -1, .jog = slope_law(kJogPps, kJogSlope)})), Cause::none);
  EXPECT_FALSE(bench.run(10'000));
  bench.axis.slow_down(bench.now);
  EXPECT_TRUE(bench.run(11'000));
  expect_ended(bench, {.by = Cause::stopped, .in_row = 0});
}

}  // namespace homing_simple2_test
}  // namespace understudy::motion
