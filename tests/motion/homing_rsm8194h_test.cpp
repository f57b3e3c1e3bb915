#include "tests/motion/homing_bench.h"

// RS-M8194H's four steps, each in its own direction. At V = 20000 pps and 200000 pps/s it stops 1000 pulses
// after an edge; steps 2 and 3 stop at once, on it.
//
//   LMT-             NHOME           HOME           LMT+
//   ═══╗           ╔═══════╗        ╔════╗        ╔═════
//    -20000   0   30000  45000   50000  51000    80000       Z at every 4000
namespace understudy::motion {
namespace homing_rsm8194h_test {

constexpr double kDrivePps = 20'000;
constexpr double kHomePps = 2000;
constexpr double kSlope = 200'000;

Rsm8194hHoming steps(std::array<int, 4> directions, std::int64_t offset = 0) {
  return {.directions = directions,
          .drive = slope_law(kDrivePps, kSlope),
          .home = slope_law(kHomePps, kSlope),
          .offset_pulses = offset};
}

Rsm8194hHoming mirrored(Rsm8194hHoming how) {
  for (int& direction : how.directions) direction = -direction;
  return how;
}

Environment machine() {
  Environment environment;
  environment.add(Signal::limit_minus, -kFar, -20'000);
  environment.add(Signal::near_home, 30'000, 45'000);
  environment.add(Signal::home, 50'000, 51'000);
  environment.add(Signal::limit_plus, 80'000, kFar);
  environment.index_period = 4000;
  return environment;
}

struct Case {
  const char* name;
  Rsm8194hHoming how;
  std::int64_t start;
  Trace trace;
  Ending ending{};
  std::int64_t reference = 0;
  Cause refused = Cause::none;
};

void expect(const Case& wanted, const Environment& environment) {
  for (const bool turned : {false, true}) {
    SCOPED_TRACE(std::string(wanted.name) + (turned ? ", mirrored" : ""));
    HomingBench bench(turned ? motion::mirrored(environment) : environment,
                      turned ? -wanted.start : wanted.start);
    const Cause refused = bench.home(rsm8194h_homing(turned ? mirrored(wanted.how) : wanted.how));
    ASSERT_EQ(refused, turned ? motion::mirrored(wanted.refused) : wanted.refused);
    if (refused != Cause::none) {
      EXPECT_FALSE(bench.axis.moving());
      continue;
    }
    bench.step();  // a homing without steps has ended by now
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.trace, turned ? motion::mirrored(wanted.trace) : wanted.trace);
    expect_ended(bench, {.by = turned ? motion::mirrored(wanted.ending.by) : wanted.ending.by,
                         .in_row = wanted.ending.in_row});
    if (wanted.ending.by == Cause::arrived) {
      EXPECT_EQ(bench.axis.homing.reference_pulses, turned ? -wanted.reference : wanted.reference);
    }
  }
}

Rsm8194hHoming by_limit(std::array<int, 4> directions) {
  Rsm8194hHoming how = steps(directions);
  how.limit_is_home = true;
  return how;
}

TEST(HomingRsm8194h, EveryStepFromEveryPlace) {
  // With step 1: rows 0 step 1; 1 step 2, 2 leaving HOME (a), 3 back from the limit (b, c); 4 step 3; 5
  // step 4. Rows of skipped steps are missing. clang-format off
  const std::vector<Case> table = {
      {"all four",
       steps({+1, +1, -1, +1}, 3500),
       0,
       {{0, +1, 31'000}, {1, +1, 50'000}, {4, -1, 48'000}, {5, +1, 51'500}},
       {},
       48'000},
      {"the manual's directions",
       steps({-1, -1, +1, +1}, 3500),
       60'000,
       {{0, -1, 44'000},
        {1, -1, -20'000},
        {3, +1, kRunsOn},
        {2, +1, 51'001},
        {1, -1, 51'000},
        {4, +1, 52'000},
        {5, +1, 55'500}},
       {},
       52'000},
      {"NHOME on at the start: step 1 is over", steps({+1, +1, 0, 0}), 40'000, {{1, +1, 50'000}}, {}, 50'000},
      {"NHOME never: the limit ends step 1",
       steps({+1, -1, 0, 0}),
       60'000,
       {{0, +1, 80'000}, {1, -1, 51'000}},
       {},
       51'000},
      {"... and is on when step 2 begins (b)",
       steps({+1, +1, 0, 0}),
       60'000,
       {{0, +1, 80'000}, {3, -1, kRunsOn}, {2, -1, 49'999}, {1, +1, 50'000}},
       {},
       50'000},
      {"step 1 on the limit ahead", steps({+1, -1, 0, 0}), 80'500, {{1, -1, 51'000}}, {}, 51'000},
      {"HOME from before", steps({0, +1, 0, 0}), 0, {{0, +1, 50'000}}, {}, 50'000},
      {"HOME from on it (a)", steps({0, +1, 0, 0}), 50'500, {{1, -1, 49'999}, {0, +1, 50'000}}, {}, 50'000},
      {"HOME from beyond (c)",
       steps({0, +1, 0, 0}),
       70'000,
       {{0, +1, 80'000}, {2, -1, kRunsOn}, {1, -1, 49'999}, {0, +1, 50'000}},
       {},
       50'000},
      {"HOME from the far limit (b)",
       steps({0, +1, 0, 0}),
       80'500,
       {{2, -1, kRunsOn}, {1, -1, 49'999}, {0, +1, 50'000}},
       {},
       50'000},
      {"HOME from the near limit", steps({0, +1, 0, 0}), -20'500, {{0, +1, 50'000}}, {}, 50'000},
      {"Z only", steps({0, 0, -1, 0}), 10'001, {{0, -1, 8000}}, {}, 8000},
      {"Z is on already", steps({0, 0, +1, 0}), 8000, {}, {}, 0, Cause::homing_failed},
      {"Z and the limit at the same pulse: Z counts",
       steps({0, 0, +1, 0}),
       78'000,
       {{0, +1, 80'000}},
       {},
       80'000},
      {"the offset only", steps({0, 0, 0, -1}, 2500), 100, {{0, -1, -2400}}, {}, -2400},
      {"an offset of nothing", steps({0, 0, 0, -1}, 0), 100, {}, {}, 100},
      {"nothing at all", steps({0, 0, 0, 0}), 100, {}, {}, 100},
      {"the limit as HOME", by_limit({0, -1, 0, 0}), 1000, {{0, -1, -20'000}}, {}, -20'000},
      {"... on it (a)", by_limit({0, -1, 0, 0}), -20'300, {{1, +1, -19'999}, {0, -1, -20'000}}, {}, -20'000},
  };
  // clang-format on
  for (const Case& wanted : table) expect(wanted, machine());
}

TEST(HomingRsm8194h, HomeThatIsNowhereEndsOnTheSecondLimit) {
  Environment environment;
  environment.add(Signal::limit_minus, -kFar, -20'000);
  environment.add(Signal::limit_plus, 80'000, kFar);
  expect({"no HOME",
          steps({0, +1, 0, 0}),
          0,
          {{0, +1, 80'000}, {2, -1, -20'000}},
          {.by = Cause::limit_minus, .in_row = 2}},
         environment);
  expect({"no Z", steps({0, 0, +1, 0}), 0, {{0, +1, 80'000}}, {.by = Cause::limit_plus, .in_row = 0}},
         environment);
  expect({"the offset leads into the limit",
          steps({0, 0, 0, +1}, 90'000),
          0,
          {{0, +1, 80'000}},
          {.by = Cause::limit_plus, .in_row = 0}},
         environment);
}

TEST(HomingRsm8194h, ZOnTheEdgeOfHomeIsOnWhenStep3BeginsAndFails) {
  Environment environment = machine();
  environment.index_at = 2000;  // 50000 is one
  expect(
      {"Z at HOME", steps({0, +1, +1, 0}), 0, {{0, +1, 50'000}}, {.by = Cause::homing_failed, .in_row = 3}},
      environment);
}

TEST(HomingRsm8194h, ALimitThatSlowsDownIsTurnedRoundBehind) {
  // Rule (c) with the limit's stop that the axis has: 2000^2 / 2a = 10 pulses further.
  HomingBench bench(machine(), 70'000);
  bench.axis.set({.at_limit_plus = Reaction::slow_down});
  ASSERT_EQ(bench.home(rsm8194h_homing(steps({0, +1, 0, 0}))), Cause::none);
  ASSERT_TRUE(bench.run());
  EXPECT_EQ(bench.trace, (Trace{{0, +1, 80'010}, {2, -1, kRunsOn}, {1, -1, 49'999}, {0, +1, 50'000}}));
}

TEST(HomingRsm8194h, ALimitInBrakingDistanceOfNearHomeStillEndsStep1) {
  Environment environment;
  environment.add(Signal::near_home, 30'000, 40'000);
  environment.add(Signal::home, 10'000, 11'000);
  environment.add(Signal::limit_plus, 30'400, kFar);
  expect({"limit 400 behind NHOME",
          steps({+1, -1, 0, 0}),
          20'000,
          {{0, +1, 30'400}, {1, -1, 11'000}},
          {},
          11'000},
         environment);
}

TEST(HomingRsm8194h, ShowsTheManualsStatesMeanwhile) {
  HomingBench bench(machine(), 70'000);
  ASSERT_EQ(bench.home(rsm8194h_homing(steps({+1, +1, -1, +1}, 3500))), Cause::none);
  std::vector<int> codes;
  while (bench.axis.homing.active()) {
    const int code = bench.axis.homing.row().code;
    if (codes.empty() || codes.back() != code) codes.push_back(code);
    bench.step();
  }
  EXPECT_EQ(codes, (std::vector<int>{3, 8, 12, 15, 20, 25}));
}

TEST(HomingRsm8194h, TakesTheTimeOfItsSteps) {
  HomingBench bench(machine(), 0);
  const Tick begun = bench.now + 1;
  ASSERT_EQ(bench.home(rsm8194h_homing(steps({+1, +1, -1, +1}, 3500))), Cause::none);
  ASSERT_TRUE(bench.run());
  const double seconds = time_to_reach_s(30'000, kDrivePps, kSlope) + kDrivePps / kSlope +
                         time_to_reach_s(19'000, kHomePps, kSlope) + time_to_reach_s(2000, kHomePps, kSlope) +
                         time_of_move_s(3500, kDrivePps, kSlope);
  EXPECT_NEAR(static_cast<double>(bench.now - begun), seconds * 1000, 3.0);
}

}  // namespace homing_rsm8194h_test
}  // namespace understudy::motion
