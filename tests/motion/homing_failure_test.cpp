#include "tests/motion/homing_super40nc_bench.h"

// Events that end a homing without home.
namespace understudy::motion {
namespace homing_failure_test {

struct Journey {
  std::string name;
  HomingProgram program;
  std::int64_t start;
};

/// Every mode, and sequences of the other controllers that pass most of their rows, on super40nc_machine().
std::vector<Journey> journeys() {
  std::vector<Journey> all;
  for (int mode = 0; mode <= 12; ++mode) {
    Super40ncHoming how = super40nc_factory(mode);
    how.leave_pulses = 999;
    how.offset_pulses = -7000;
    all.push_back({"mode " + std::to_string(mode), super40nc_homing(how), 55'000});
  }
  const SpeedLaw drive = slope_law(kFastPps, kSlope);
  const SpeedLaw home = slope_law(5000, kSlope);
  all.push_back(
      {"RS-M8194H",
       rsm8194h_homing({.directions = {+1, +1, -1, +1}, .drive = drive, .home = home, .offset_pulses = 3500}),
       30'000});
  all.push_back({"Simple2-R3", simple2_homing({.direction = +1, .speed = drive}), 70'000});
  all.push_back({"SLIM", slim_homing({.direction = +1, .jog = drive}), 0});
  return all;
}

struct Interruption {
  const char* name;
  Cause by;
  std::function<void(HomingBench&)> does;
  bool at_once = true;
};

void expect_given_up(const Journey& journey, const Interruption& interruption, Tick after,
                     Reaction reaction) {
  HomingBench bench(super40nc_machine(), journey.start);
  bench.axis.set({.at_alarm = reaction, .at_emergency = reaction});
  ASSERT_EQ(bench.home(journey.program), Cause::none);
  bench.run_ticks(after);
  ASSERT_TRUE(bench.axis.homing.active());
  const int row = bench.axis.homing.phase;
  const std::int64_t travel = bench.axis.travel_pulses;
  interruption.does(bench);
  bench.step();
  if (interruption.at_once) {
    EXPECT_FALSE(bench.axis.moving());
    EXPECT_EQ(bench.axis.travel_pulses, travel);
  }
  ASSERT_TRUE(bench.run(bench.now + 60));  // 50 ms from full speed
  // Never further than it takes to stop.
  EXPECT_LE(std::abs(bench.axis.travel_pulses - travel), 834);
  expect_ended(bench, {.by = interruption.by, .in_row = row});
  const Axis ended = bench.axis;
  bench.run_ticks(100);
  EXPECT_EQ(bench.axis.travel_pulses, ended.travel_pulses);
  EXPECT_FALSE(bench.axis.moving());
}

/// Ticks spread over a sequence, at which it will be interrupted: every row is hit, and its deceleration,
/// too.
std::vector<Tick> moments(const Journey& journey) {
  HomingBench bench(super40nc_machine(), journey.start);
  EXPECT_EQ(bench.home(journey.program), Cause::none);
  std::vector<Tick> ticks;
  int row = -1;
  bool met = false;
  const Tick begun = bench.now;
  while (bench.axis.homing.active()) {
    const Tick after = bench.now - begun;
    if (row != bench.axis.homing.phase || met != bench.axis.homing.met || after % 997 == 0) {
      for (const Tick later : {0, 3, 20}) ticks.push_back(after + later);
    }
    row = bench.axis.homing.phase;
    met = bench.axis.homing.met;
    bench.step();
  }
  const Tick length = bench.now - begun;
  std::erase_if(ticks, [&](Tick t) { return t >= length - 1; });
  EXPECT_GT(ticks.size(), 5U);
  return ticks;
}

TEST(HomingFailure, WhateverIsToStopTheAxisEndsItInEveryRow) {
  const std::vector<Interruption> table = {
      {"stop command", Cause::stopped, [](HomingBench& b) { b.axis.stop(); }},
      {"slowing stop command", Cause::stopped, [](HomingBench& b) { b.axis.slow_down(b.now); }, false},
      {"servo off", Cause::servo_off, [](HomingBench& b) { b.axis.switch_servo(false); }},
      {"alarm", Cause::alarm, [](HomingBench& b) { b.environment.set_steady(Signal::alarm, true); }},
      {"emergency", Cause::emergency,
       [](HomingBench& b) { b.environment.set_steady(Signal::emergency, true); }},
  };
  const std::vector<Interruption> slowly = {
      {"slowing alarm", Cause::alarm, [](HomingBench& b) { b.environment.set_steady(Signal::alarm, true); },
       false},
      {"short slowing alarm", Cause::alarm,
       [](HomingBench& b) {
         b.environment.set_steady(Signal::alarm, true);
         b.step();
         b.environment.set_steady(Signal::alarm, false);
       },
       false},
  };
  for (const Journey& journey : journeys()) {
    for (const Tick after : moments(journey)) {
      for (const Interruption& interruption : table) {
        SCOPED_TRACE(journey.name + ", " + interruption.name + " after " + std::to_string(after));
        expect_given_up(journey, interruption, after, Reaction::stop_at_once);
      }
      for (const Interruption& interruption : slowly) {
        SCOPED_TRACE(journey.name + ", " + interruption.name + " after " + std::to_string(after));
        expect_given_up(journey, interruption, after, Reaction::slow_down);
      }
    }
  }
}

TEST(HomingFailure, ASoftLimitEndsItOnePulseBeyondInEveryRow) {
  for (const Journey& journey : journeys()) {
    // Rows start where moments() finds them; 3 ticks later the row is in progress.
    for (const Tick after : moments(journey)) {
      SCOPED_TRACE(journey.name + " after " + std::to_string(after));
      HomingBench bench(super40nc_machine(), journey.start);
      ASSERT_EQ(bench.home(journey.program), Cause::none);
      bench.run_ticks(after);
      HomingBench free = bench;
      free.step();
      // Only if the next tick continues for two pulses or more in one direction.
      const std::int64_t gone = free.axis.travel_pulses - bench.axis.travel_pulses;
      if (std::abs(gone) < 2 || free.axis.homing.phase != bench.axis.homing.phase) continue;
      const int row = bench.axis.homing.phase;
      const int direction = gone > 0 ? +1 : -1;
      const std::int64_t last = bench.axis.travel_pulses + direction;
      AxisSettings settings;
      (direction > 0 ? settings.soft_limit_plus : settings.soft_limit_minus) = last;
      bench.axis.set(settings);
      bench.step();
      EXPECT_EQ(bench.axis.travel_pulses, last + direction);
      expect_ended(bench,
                   {.by = direction > 0 ? Cause::soft_limit_plus : Cause::soft_limit_minus, .in_row = row});
    }
  }
}

TEST(HomingFailure, ADogPassedWhileBrakingFailsIfItMustBeFoundAgain) {
  struct Row {
    int mode;
    Trace trace;
    Cause by;
  };
  // A plate of 800 pulses, where 833 are needed. Modes 0 and 9 do not check again; 2, 3 and 10 do not stop.
  const std::vector<Row> table = {
      {0, {{1, +1, 50'833}}, Cause::arrived},
      {1, {{1, +1, 50'833}}, Cause::homing_failed},
      {2, {{1, +1, kRunsOn}, {2, +1, 52'000}}, Cause::arrived},
      {3, {{1, +1, kRunsOn}, {2, +1, 52'833}}, Cause::arrived},
      {4, {{1, +1, 50'833}}, Cause::homing_failed},
      {5, {{1, +1, 50'833}}, Cause::homing_failed},
      {9, {{1, +1, 50'833}, {2, -1, 50'000}}, Cause::arrived},
      {10, {{1, +1, kRunsOn}, {2, +1, 52'833}, {3, -1, 52'000}}, Cause::arrived},
      {11, {{1, +1, 50'833}}, Cause::homing_failed},
  };
  for (const Row& row : table) {
    for (const bool turned : {false, true}) {
      SCOPED_TRACE("mode " + std::to_string(row.mode) + (turned ? ", mirrored" : ""));
      Environment environment = super40nc_machine();
      move_zone(environment, kDogZone, 50'000, 50'799);
      const Super40ncHoming how = super40nc_factory(row.mode);
      HomingBench bench(turned ? mirrored(environment) : environment, 0);
      ASSERT_EQ(bench.home(super40nc_homing(turned ? mirrored(how) : how)), Cause::none);
      ASSERT_TRUE(bench.run());
      EXPECT_EQ(bench.trace, turned ? mirrored(row.trace) : row.trace);
      expect_ended(bench, {.by = row.by});
    }
  }
}

TEST(HomingFailure, ALimitThatIsPassedWhileBrakingFails) {
  for (const int mode : {6, 7, 8, 12}) {
    Environment environment = super40nc_machine();
    move_zone(environment, kLimitZone, 81'000, 81'500);
    HomingBench bench(environment, 0);
    ASSERT_EQ(bench.home(super40nc_homing(super40nc_factory(mode))), Cause::none);
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.trace, (Trace{{0, +1, 81'833}}));
    expect_ended(bench, {.by = Cause::homing_failed, .in_row = 0});
  }
}

TEST(HomingFailure, ALimitAheadEndsADogModeInEveryRowItCanBeMetIn) {
  struct Row {
    const char* name;
    int mode;
    std::int64_t start;
    Signal limit;
    std::int64_t edge;
    int in_row;
  };
  const std::vector<Row> table = {
      {"leaving the DOG", 0, 50'500, Signal::limit_minus, 50'100, 0},
      {"before the DOG", 0, 0, Signal::limit_plus, 40'000, 1},
      {"braking on the DOG", 1, 0, Signal::limit_plus, 50'300, 1},
      {"counting EZ ahead", 3, 0, Signal::limit_plus, 51'000, 2},
      {"counting EZ behind", 4, 0, Signal::limit_minus, 49'000, 2},
      {"offset", 0, 0, Signal::limit_minus, 45'000, 2},
  };
  for (const Row& row : table) {
    SCOPED_TRACE(row.name);
    Environment environment = super40nc_machine();
    const bool plus = row.limit == Signal::limit_plus;
    Super40ncHoming how = super40nc_factory(row.mode);
    how.leave_pulses = 999;
    how.offset_pulses = -7000;
    HomingBench bench(environment, row.start);
    ASSERT_EQ(bench.home(super40nc_homing(how)), Cause::none);
    ASSERT_TRUE(bench.run_until_row(row.in_row));
    if (plus) move_zone(bench.environment, kLimitZone, row.edge, kFar);
    if (!plus) move_zone(bench.environment, 0, -kFar, row.edge);
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.axis.travel_pulses, row.edge);
    expect_ended(bench, {.by = plus ? Cause::limit_plus : Cause::limit_minus, .in_row = row.in_row});
  }
}

TEST(HomingFailure, WithoutALimitMode6RunsUntilStopped) {
  Environment environment = super40nc_machine();
  move_zone(environment, kLimitZone, 1, 0);
  HomingBench bench(environment, 0);
  ASSERT_EQ(bench.home(super40nc_homing(super40nc_factory(6))), Cause::none);
  EXPECT_FALSE(bench.run(60'000));
  EXPECT_GT(bench.axis.travel_pulses, 1'900'000);
  bench.axis.stop();
  bench.step();
  expect_ended(bench, {.by = Cause::stopped, .in_row = 0});
}

/// From behind the DOG, through the limit ahead, if that is chosen: the end is the same as from before it.
TEST(HomingFailure, MayTurnRoundAtTheLimitAndPassTheDog) {
  for (int mode = 0; mode <= 12; ++mode) {
    if (super40nc_homes_by_limit(mode)) continue;
    for (const bool turned : {false, true}) {
      SCOPED_TRACE("mode " + std::to_string(mode) + (turned ? ", mirrored" : ""));
      Super40ncHoming how = super40nc_factory(mode);
      how.offset_pulses = 700;
      how.turns_at_limit = true;
      const Environment environment = super40nc_machine();
      std::int64_t ends[2];
      for (const bool is_behind : {false, true}) {
        const std::int64_t start = is_behind ? 70'000 : 0;
        HomingBench bench(turned ? mirrored(environment) : environment, turned ? -start : start);
        ASSERT_EQ(bench.home(super40nc_homing(turned ? mirrored(how) : how)), Cause::none);
        ASSERT_TRUE(bench.run());
        expect_ended(bench, {});
        ends[is_behind ? 1 : 0] = bench.axis.travel_pulses;
      }
      EXPECT_EQ(ends[0], ends[1]);
      how.turns_at_limit = false;
      HomingBench fails(turned ? mirrored(environment) : environment, turned ? -70'000 : 70'000);
      ASSERT_EQ(fails.home(super40nc_homing(turned ? mirrored(how) : how)), Cause::none);
      ASSERT_TRUE(fails.run());
      EXPECT_NE(fails.axis.homing.ended_by, Cause::arrived);
    }
  }
}

TEST(HomingFailure, ADogThatNeverEndsIsLeftStepByStepUntilTheLimit) {
  Environment environment = super40nc_machine();
  environment.set_steady(Signal::home, true);
  HomingBench bench(environment, 0);
  ASSERT_EQ(bench.home(super40nc_homing(super40nc_factory(1))), Cause::none);
  ASSERT_TRUE(bench.run());
  EXPECT_EQ(bench.axis.travel_pulses, -20'000);
  expect_ended(bench, {.by = Cause::limit_minus, .in_row = 0});
}

TEST(HomingFailure, IsRefusedAsAnyMotionIsAndThenChangesNothing) {
  struct Row {
    const char* name;
    std::function<void(HomingBench&)> prepare;
    Cause refused;
  };
  const std::vector<Row> table = {
      {"servo off", [](HomingBench& b) { b.axis.switch_servo(false); }, Cause::servo_off},
      {"alarm", [](HomingBench& b) { b.environment.set_steady(Signal::alarm, true); }, Cause::alarm},
      {"emergency", [](HomingBench& b) { b.environment.set_steady(Signal::emergency, true); },
       Cause::emergency},
      {"soft limit", [](HomingBench& b) { b.axis.set({.soft_limit_plus = 0}); }, Cause::soft_limit_plus},
  };
  for (const Row& row : table) {
    SCOPED_TRACE(row.name);
    HomingBench bench(super40nc_machine(), 0);
    row.prepare(bench);
    bench.step();
    const Axis before = bench.axis;
    EXPECT_EQ(bench.home(super40nc_homing(super40nc_factory(6))), row.refused);
    EXPECT_EQ(bench.axis, before);
    EXPECT_EQ(bench.home(rsm8194h_homing({.directions = {+1, 0, 0, 0},
                                          .drive = slope_law(kFastPps, kSlope),
                                          .home = slope_law(kFastPps, kSlope)})),
              row.refused);
    EXPECT_EQ(bench.axis, before);
  }
}

TEST(HomingFailure, AMotionOfAnotherKindTakesItsPlace) {
  const SpeedLaw law = slope_law(kFastPps, kSlope);
  const std::vector<std::function<Cause(Axis&, Tick)>> table = {
      [&](Axis& axis, Tick now) { return axis.move(100, law, now); },
      [&](Axis& axis, Tick) { return axis.move_at_zero_speed(+1); },
      [&](Axis& axis, Tick) { return axis.follow(Follower{}); },
      [&](Axis& axis, Tick) { return axis.take_part(); },
      [&](Axis& axis, Tick now) { return axis.run(+1, law, now); },
  };
  for (const auto& command : table) {
    HomingBench bench(super40nc_machine(), 0);
    ASSERT_EQ(bench.home(super40nc_homing(super40nc_factory(1))), Cause::none);
    bench.run_ticks(500);
    EXPECT_EQ(command(bench.axis, bench.now), Cause::none);
    EXPECT_FALSE(bench.axis.homing.active());
    EXPECT_TRUE(bench.axis.moving());
    bench.run_ticks(200);
    EXPECT_EQ(bench.seen & bit(Event::homed), 0);
  }
  HomingBench refused(super40nc_machine(), 81'500);
  ASSERT_EQ(refused.home(super40nc_homing(super40nc_factory(7))), Cause::none);
  refused.run_ticks(5);
  EXPECT_EQ(refused.axis.move(+1, law, refused.now), Cause::limit_plus);
  EXPECT_TRUE(refused.axis.homing.active());
  EXPECT_EQ(refused.axis.move(0, law, refused.now), Cause::none);
  EXPECT_FALSE(refused.axis.moving());
}

TEST(HomingFailure, TablesThatCannotBeRunAreRefused) {
  const SpeedLaw law = slope_law(kFastPps, kSlope);
  const std::vector<std::pair<const char*, HomingPhase>> rows = {
      {"next", {.next = 5}},
      {"if_limit", {.if_limit = HomingPhase::kAwait}},
      {"if_gone", {.if_gone = 3}},
      {"if_already", {.if_already = 2}},
      {"count", {.count = 0, .if_already = HomingPhase::kAwait}},
      {"counted at once", {.count = 2}},
      {"way", {.direction = 0}},
      {"speed", {.speed = 2}},
      {"no such law", {.speed = 1}},
      {"nothing again and again", {.does = HomingPhase::Does::go, .again_while = bit(Signal::home)}},
  };
  for (const auto& [name, row] : rows) {
    HomingProgram program{.speeds = {law}};
    program.add(row);
    HomingBench bench(Environment{}, 0);
    const Axis before = bench.axis;
    EXPECT_THROW(bench.home(program), BadMotion) << name;
    EXPECT_EQ(bench.axis, before) << name;
  }
  HomingProgram full;
  for (std::size_t i = 0; i < HomingProgram::kMaxPhases; ++i) full.add({});
  EXPECT_THROW(full.add({}), BadMotion);
}

TEST(HomingFailure, ATableThatGoesRoundWithoutMovingFails) {
  HomingProgram program{.speeds = {slope_law(kFastPps, kSlope)}};
  program.add({.until_on = false, .next = 0});
  HomingBench bench(Environment{}, 0);
  EXPECT_EQ(bench.home(program), Cause::homing_failed);
  EXPECT_FALSE(bench.axis.moving());
}

}  // namespace homing_failure_test
}  // namespace understudy::motion
