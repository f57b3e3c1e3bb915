#include "tests/motion/homing_super40nc_bench.h"

// Switches that move while the axis searches for them: the plant changes its environment between ticks.
namespace understudy::motion {
namespace homing_moving_edges_test {

struct Change {
  const char* name;
  int mode;
  int row;     // in which it happens,
  Tick after;  // this many ticks after the row has started
  std::size_t zone;
  std::int64_t from;
  std::int64_t to;
  Trace trace;
  Cause by = Cause::arrived;
};

TEST(HomingMovingEdges, TheEdgeCountsWhereItIsWhenItIsMet) {
  // clang-format off
  const std::vector<Change> table = {
      //                                   row ticks              from    to
      {"DOG goes on ahead",             0, 1,  800, kDogZone,     55'000, 60'000, {{1, +1, 55'833}}},
      {"DOG comes nearer",              0, 1,  800, kDogZone,     40'000, 60'000, {{1, +1, 40'833}}},
      {"DOG grows while braking",       1, 1, 1530, kDogZone,     49'000, 60'000,
       {{1, +1, 50'833}, {2, -1, 48'999}, {3, +1, 49'000}}},
      {"DOG shrinks while creeping off", 1, 2,  100, kDogZone,    50'400, 60'000,
       {{1, +1, 50'833}, {2, -1, 50'399}, {3, +1, 50'400}}},
      {"DOG gone while braking",        4, 1, 1530, kDogZone,     70'000, 71'000,
       {{1, +1, 50'833}}, Cause::homing_failed},
      {"DOG gone when on the way back", 4, 2,    5, kDogZone,     70'000, 71'000,
       {{1, +1, 50'833}, {2, -1, 48'000}}},
      {"DOG gone when counting EZ",     3, 2,    5, kDogZone,     70'000, 71'000,
       {{1, +1, kRunsOn}, {2, +1, 52'833}}},
      {"DOG back again over EZ's row",  4, 2,  100, kDogZone,     10'000, 60'000,
       {{1, +1, 50'833}, {2, -1, 48'000}}},
      {"limit goes on ahead",           6, 0,  800, kLimitZone,   91'000, kFar,
       {{0, +1, 91'833}, {1, -1, 90'999}}},
      {"limit follows the axis back",   6, 1,  100, kLimitZone,   80'000, kFar,
       {{0, +1, 81'833}, {1, -1, 79'999}}},
      {"marked edge moves afterwards",  9, 2,    5, kDogZone,     20'000, 60'000,
       {{1, +1, 50'833}, {2, -1, 50'000}}},
  };
  // clang-format on
  for (const Change& row : table) {
    for (const bool turned : {false, true}) {
      SCOPED_TRACE(std::string(row.name) + (turned ? ", mirrored" : ""));
      const Environment environment = super40nc_machine();
      const Super40ncHoming how = super40nc_factory(row.mode);
      HomingBench bench(turned ? mirrored(environment) : environment, 0);
      ASSERT_EQ(bench.home(super40nc_homing(turned ? mirrored(how) : how)), Cause::none);
      ASSERT_TRUE(bench.run_until_row(row.row));
      bench.run_ticks(row.after);
      ASSERT_EQ(bench.axis.homing.phase, row.row);
      move_zone(bench.environment, row.zone, turned ? -row.to : row.from, turned ? -row.from : row.to);
      ASSERT_TRUE(bench.run());
      EXPECT_EQ(bench.trace, turned ? mirrored(row.trace) : row.trace);
      expect_ended(bench, {.by = row.by});
    }
  }
}

TEST(HomingMovingEdges, APlateThatFallsOnTheAxisIsMetWhereTheAxisIs) {
  // 800 ms after its beginning: v (t - v / 2a).
  const double travelled = kFastPps * 0.8 - brake_pulses(kFastPps, kSlope);
  HomingBench bench(super40nc_machine(), 0);
  ASSERT_EQ(bench.home(super40nc_homing(super40nc_factory(9))), Cause::none);
  bench.run_ticks(801);
  const auto position = static_cast<std::int64_t>(travelled);
  ASSERT_EQ(bench.axis.travel_pulses, position);
  move_zone(bench.environment, kDogZone, 0, 100'000);
  ASSERT_TRUE(bench.run());
  const auto stood = static_cast<std::int64_t>(travelled + brake_pulses(kFastPps, kSlope) + 1e-6);
  EXPECT_EQ(bench.trace, (Trace{{1, +1, stood}, {2, -1, position}}));
  EXPECT_EQ(bench.axis.homing.reference_pulses, position);
}

TEST(HomingMovingEdges, AVanishingPlateStopsACreepingAxisAtTheTicksStart) {
  HomingBench bench(super40nc_machine(), 0);
  ASSERT_EQ(bench.home(super40nc_homing(super40nc_factory(1))), Cause::none);
  ASSERT_TRUE(bench.run_until_row(2));
  bench.run_ticks(200);
  const std::int64_t position = bench.axis.travel_pulses;
  EXPECT_GT(position, 50'500);
  move_zone(bench.environment, kDogZone, 70'000, 71'000);
  ASSERT_TRUE(bench.run());
  EXPECT_EQ(bench.trace, (Trace{{1, +1, 50'833}, {2, -1, position}, {3, +1, 70'000}}));
}

TEST(HomingMovingEdges, ABouncingSwitchIsMetOnce) {
  // On at 50000, off again for a while after 10 pulses, on again: still one DOG, and it stops behind it.
  Environment environment = super40nc_machine();
  move_zone(environment, kDogZone, 50'000, 50'010);
  environment.add(Signal::home, 50'020, 60'000);
  for (const auto& [mode, trace] : std::vector<std::pair<int, Trace>>{
           {0, {{1, +1, 50'833}}},
           {1, {{1, +1, 50'833}, {2, -1, 50'019}, {3, +1, 50'020}}},
           {3, {{1, +1, kRunsOn}, {2, +1, 52'833}}},
       }) {
    HomingBench bench(environment, 0);
    ASSERT_EQ(bench.home(super40nc_homing(super40nc_factory(mode))), Cause::none);
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.trace, trace) << mode;
  }
}

TEST(HomingMovingEdges, ASwitchThatComesOnBeforeTheFirstPulseIsMetThere) {
  HomingBench bench(super40nc_machine(), 0);
  ASSERT_EQ(bench.home(super40nc_homing(super40nc_factory(0))), Cause::none);
  bench.environment.set_steady(Signal::home, true);
  ASSERT_TRUE(bench.run());
  EXPECT_EQ(bench.axis.travel_pulses, 0);
  expect_ended(bench, {.by = Cause::arrived, .in_row = 2});
}

}  // namespace homing_moving_edges_test
}  // namespace understudy::motion
