#include <random>

#include "tests/motion/homing_super40nc_bench.h"

// Homing as a value, with backlash, on random machines.
namespace understudy::motion {
namespace homing_value_test {

Super40ncHoming thorough(int mode) {
  Super40ncHoming how = super40nc_factory(mode);
  how.index_count = 2;
  how.offset_pulses = -7000;
  return how;
}

TEST(HomingValue, ACopyContinuesAsTheOriginal) {
  for (int mode = 0; mode <= 12; ++mode) {
    SCOPED_TRACE(mode);
    HomingBench original(super40nc_machine(), 0);
    ASSERT_EQ(original.home(super40nc_homing(thorough(mode))), Cause::none);
    std::vector<HomingBench> copies;
    while (original.axis.homing.active()) {
      if (original.now % 211 == 0) copies.push_back(original);
      original.step();
    }
    ASSERT_GT(copies.size(), 5U);
    for (HomingBench& copy : copies) {
      ASSERT_TRUE(copy.run());
      EXPECT_EQ(copy.axis, original.axis);
      EXPECT_EQ(copy.now, original.now);
      EXPECT_EQ(copy.trace, original.trace);
    }
  }
}

TEST(HomingValue, IsTheSameEveryTime) {
  for (int mode = 0; mode <= 12; ++mode) {
    HomingBench first(super40nc_machine(), 0);
    HomingBench second(super40nc_machine(), 0);
    ASSERT_EQ(first.home(super40nc_homing(thorough(mode))), Cause::none);
    ASSERT_EQ(second.home(super40nc_homing(thorough(mode))), Cause::none);
    while (first.axis.homing.active()) {
      first.step();
      second.step();
      ASSERT_EQ(first.axis, second.axis);
    }
  }
}

TEST(HomingValue, CanBeDoneAgainFromWhereItEnded) {
  HomingBench bench(super40nc_machine(), 0);
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(bench.home(super40nc_homing(thorough(4))), Cause::none);
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.axis.homing.reference_pulses, 44'000);
    EXPECT_EQ(bench.axis.travel_pulses, 37'000);
    bench.run_ticks(10);
  }
}

TEST(HomingValue, BacklashIsTakenUpAtEachReversalAndMovesNoEdge) {
  // 0.2 ms, less than a tick; 40 ms.
  for (const double backlash_pps : {200'000.0, 1000.0}) {
    HomingBench bench(super40nc_machine(), 0);
    bench.axis.set({.backlash_pulses = 40, .backlash_speed_pps = backlash_pps});
    ASSERT_EQ(bench.home(super40nc_homing(thorough(1))), Cause::none);
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.trace, (Trace{{1, +1, 50'833}, {2, -1, 49'999}, {3, +1, 50'000}, {4, -1, 43'000}}));
    EXPECT_EQ(bench.axis.backlash_sent, -40 + 40 - 40);
    EXPECT_EQ(bench.pulses_out, 43'000 - 40);
  }
}

TEST(HomingValue, BacklashTakesItsTimeWithinTheTick) {
  const auto duration = [](std::int64_t pulses) {
    HomingBench bench(super40nc_machine(), 0);
    bench.axis.set({.backlash_pulses = pulses, .backlash_speed_pps = 4000});
    const Tick begun = bench.now;
    EXPECT_EQ(bench.home(super40nc_homing(thorough(1))), Cause::none);
    EXPECT_TRUE(bench.run());
    return bench.now - begun;
  };
  // Three reversals of 41 pulses at 4 pulses per tick.
  EXPECT_NEAR(static_cast<double>(duration(41) - duration(0)), 3 * 10.25, 2.0);
}

TEST(HomingValue, BacklashThatTakesNoTimeLeavesTheMotionAsItIs) {
  // Reverses at edges, within ticks, at 20 pulses per tick from the start: a lost tick would show.
  const SpeedLaw law = slope_law(20'000, kSlope, 20'000);
  const HomingProgram program = rsm8194h_homing({.directions = {0, +1, -1, 0}, .drive = law, .home = law});
  Environment environment = super40nc_machine();
  move_zone(environment, kDogZone, 50'013, 60'000);
  environment.index_at = 7;
  HomingBench plain(environment, 55'007);
  HomingBench slack(environment, 55'007);
  slack.axis.set({.backlash_pulses = 40, .backlash_speed_pps = 1e9});
  ASSERT_EQ(plain.home(program), Cause::none);
  ASSERT_EQ(slack.home(program), Cause::none);
  while (plain.axis.homing.active()) {
    plain.step();
    slack.step();
    ASSERT_NEAR(static_cast<double>(plain.axis.travel_pulses - slack.axis.travel_pulses), 0, 1) << plain.now;
  }
  EXPECT_EQ(plain.axis.travel_pulses, 48'007);
  EXPECT_EQ(slack.axis.travel_pulses, 48'007);
}

TEST(HomingValue, ASignalThatIsThereAlreadyMarksThePlace) {
  HomingProgram program{.speeds = {slope_law(kFastPps, kSlope)}};
  program.add({.until = Signal::home, .marks = true});
  program.add({.does = HomingPhase::Does::go, .distance_pulses = 3000});
  program.add({.does = HomingPhase::Does::go_back});
  program.add({.does = HomingPhase::Does::go, .distance_pulses = -100});
  HomingBench bench(super40nc_machine(), 55'000);
  ASSERT_EQ(bench.home(program), Cause::none);
  ASSERT_TRUE(bench.run());
  EXPECT_EQ(bench.trace, (Trace{{1, +1, 58'000}, {2, -1, 55'000}, {3, -1, 54'900}}));
}

TEST(HomingValue, BeginsOnceAndEndsOnceHoweverManyRowsItPasses) {
  HomingBench bench(super40nc_machine(), 0);
  ASSERT_EQ(bench.home(super40nc_homing(thorough(1))), Cause::none);
  int started = 0;
  int ended = 0;
  Events last = 0;
  while (bench.axis.homing.active()) {
    bench.step();
    EXPECT_TRUE(bench.axis.moving() || !bench.axis.homing.active());
    started += (bench.axis.events & bit(Event::started)) != 0 ? 1 : 0;
    ended += (bench.axis.events & bit(Event::ended)) != 0 ? 1 : 0;
    last = bench.axis.events;
  }
  EXPECT_EQ(started, 1);
  EXPECT_EQ(ended, 1);
  EXPECT_EQ(last, bit(Event::ended) | bit(Event::homed));
}

TEST(HomingValue, AReturnThatCannotBePlannedFailsWithoutThrowing) {
  // Decelerating 2000 pulses before the end, the last of which leaves nothing to creep.
  Super40ncHoming how = super40nc_factory(9);
  how.fast.slow_down_at_u = 2000;
  HomingBench bench(super40nc_machine(), 0);
  ASSERT_EQ(bench.home(super40nc_homing(how)), Cause::none);
  ASSERT_TRUE(bench.run());
  EXPECT_EQ(bench.trace, (Trace{{1, +1, 50'833}}));
  expect_ended(bench, {.by = Cause::homing_failed, .in_row = 2});
}

TEST(HomingValue, ALawThatNoDoubleHoldsIsRefusedAndChangesNothing) {
  HomingBench bench(super40nc_machine(), 0);
  ASSERT_EQ(bench.home(super40nc_homing(thorough(0))), Cause::none);
  bench.run_ticks(100);
  const Axis before = bench.axis;
  const HomingProgram program = slim_homing({.direction = -1, .jog = slope_law(kFastPps, 1e-310)});
  EXPECT_THROW(bench.axis.home(program, bench.now), BadMotion);
  EXPECT_EQ(bench.axis, before);
}

TEST(HomingValue, MovesOfATableWaitForInPosition) {
  HomingBench bench(super40nc_machine(), 0);
  bench.axis.set({.waits_for_in_position = true});
  ASSERT_EQ(bench.home(super40nc_homing(thorough(0))), Cause::none);
  EXPECT_FALSE(bench.run(10'000));
  EXPECT_EQ(bench.axis.travel_pulses, 43'833);
  bench.environment.set_steady(Signal::in_position, true);
  ASSERT_TRUE(bench.run(10'002));
  expect_ended(bench, {.by = Cause::arrived, .in_row = 2});
}

TEST(HomingValue, ChangesOfSpeedAndDistanceLeaveItAsItIs) {
  HomingBench plain(super40nc_machine(), 0);
  HomingBench disturbed(super40nc_machine(), 0);
  for (HomingBench* bench : {&plain, &disturbed}) {
    ASSERT_EQ(bench->home(super40nc_homing(thorough(9))), Cause::none);
  }
  while (plain.axis.homing.active()) {
    disturbed.axis.change_speed(slope_law(123, kSlope), disturbed.now);
    disturbed.axis.change_distance(17, true, disturbed.now);
    plain.step();
    disturbed.step();
    ASSERT_EQ(plain.axis, disturbed.axis);
  }
}

TEST(HomingValue, StartsInTheMidstOfAnotherMotion) {
  HomingBench bench(super40nc_machine(), 0);
  ASSERT_EQ(bench.axis.run(-1, slope_law(kFastPps, kSlope), bench.now), Cause::none);
  bench.run_ticks(100);
  ASSERT_EQ(bench.home(super40nc_homing(thorough(1))), Cause::none);
  ASSERT_TRUE(bench.run());
  EXPECT_EQ(bench.axis.travel_pulses, 43'000);
}

/// A machine with random switches at random places.
Environment random_machine(std::mt19937_64& random) {
  const auto between = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  Environment environment;
  environment.add(Signal::limit_minus, -kFar, between(-3000, 0));
  environment.add(Signal::limit_plus, between(0, 3000), kFar);
  for (const Signal signal : {Signal::home, Signal::near_home, Signal::home, Signal::limit_plus}) {
    const std::int64_t from = between(-2500, 2500);
    environment.add(signal, from, from + between(-1, 500));
  }
  environment.index_period = between(0, 3) == 0 ? 0 : between(1, 700);
  environment.index_width = between(1, 20);
  environment.index_at = between(-700, 700);
  return environment;
}

HomingProgram random_program(std::mt19937_64& random) {
  const auto between = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  const SpeedLaw fast = slope_law(between(1000, 200'000), between(1000, 1'000'000), between(0, 500));
  const SpeedLaw slow = slope_law(between(100, 3000), between(1000, 1'000'000), between(0, 500));
  const int direction = between(0, 1) == 0 ? -1 : +1;
  switch (between(0, 3)) {
    case 0:
      return super40nc_homing({.mode = between(0, 12),
                               .direction = direction,
                               .fast = fast,
                               .creep = slow,
                               .index_count = between(1, 4),
                               .leave_pulses = between(0, 99),
                               .offset_pulses = between(-300, 300)});
    case 1:
      return rsm8194h_homing({.directions = {between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)},
                              .drive = fast,
                              .home = slow,
                              .offset_pulses = between(0, 300),
                              .limit_is_home = between(0, 3) == 0});
    case 2: return simple2_homing({.direction = direction, .speed = fast});
    default: return slim_homing({.direction = direction, .jog = slow});
  }
}

TEST(HomingValue, RandomMachinesNeverHangItNorLoseAPulse) {
  int found = 0;
  int failed = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto between = [&](int low, int high) {
      return std::uniform_int_distribution<int>(low, high)(random);
    };
    const std::int64_t start = between(-3200, 3200);
    HomingBench bench(random_machine(random), start);
    const auto reaction = [&] { return between(0, 1) == 0 ? Reaction::stop_at_once : Reaction::slow_down; };
    bench.axis.set({.at_limit_plus = reaction(),
                    .at_limit_minus = reaction(),
                    .backlash_pulses = between(0, 2) == 0 ? between(1, 30) : 0,
                    .backlash_speed_pps = static_cast<double>(between(500, 300'000))});
    const HomingProgram program = random_program(random);
    if (bench.home(program) != Cause::none) {
      ++failed;
      continue;
    }
    // The environment may change at any time; each step checks that no pulse is lost.
    while (bench.axis.homing.active() && bench.now < 40'000) {
      bench.step();
      if (between(0, 4000) == 0) {
        bench.environment = random_machine(random);
        bench.environment.version = static_cast<std::uint32_t>(bench.now);
      }
    }
    ASSERT_FALSE(HasFatalFailure());
    EXPECT_EQ(bench.pulses_out, bench.axis.travel_pulses - start + bench.axis.backlash_sent);
    if (bench.axis.homing.active()) continue;
    EXPECT_FALSE(bench.axis.moving());
    (bench.axis.homing.ended_by == Cause::arrived ? found : failed) += 1;
  }
  EXPECT_GT(found, 800);
  EXPECT_GT(failed, 300);
}

}  // namespace homing_value_test
}  // namespace understudy::motion
