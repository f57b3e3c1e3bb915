#include "tests/motion/homing_super40nc_bench.h"

// The 13 modes of SUPER-40NC. The ends of legs are calculated by hand: at 500 rpm it stops v^2 / 2a = 833
// pulses after an edge; at 20 rpm, which stops at once, on it.
namespace understudy::motion {
namespace homing_super40nc_test {

/// The sequence of a mode from before the DOG, with three EZ and an offset of -7000.
struct ModeCase {
  int mode;
  bool by_limit;
  Trace search;  // up to the switch
  Trace from_there;
  std::int64_t reference;
};

// clang-format off
const std::vector<ModeCase> kModes = {
    //           row way stood at
    { 0, false, {{1, +1, 50'833}}, {{2, -1, 43'833}}, 50'000},
    { 1, false, {{1, +1, 50'833}}, {{2, -1, 49'999}, {3, +1, 50'000}, {4, -1, 43'000}}, 50'000},
    { 2, false, {{1, +1, kRunsOn}}, {{2, +1, 60'000}, {3, -1, 53'000}}, 60'000},
    { 3, false, {{1, +1, kRunsOn}}, {{2, +1, 60'833}, {3, -1, 53'833}}, 60'000},
    { 4, false, {{1, +1, 50'833}}, {{2, -1, 40'000}, {3, -1, 33'000}}, 40'000},
    { 5, false, {{1, +1, 50'833}}, {{2, -1, 39'167}, {3, -1, 32'167}}, 40'000},
    { 6, true,  {{0, +1, 81'833}}, {{1, -1, 80'999}, {2, -1, 73'999}}, 80'999},
    { 7, true,  {{0, +1, 81'833}}, {{1, -1, 72'000}, {2, -1, 65'000}}, 72'000},
    { 8, true,  {{0, +1, 81'833}}, {{1, -1, 71'167}, {2, -1, 64'167}}, 72'000},
    { 9, false, {{1, +1, 50'833}}, {{2, -1, 50'000}, {3, -1, 43'000}}, 50'000},
    {10, false, {{1, +1, kRunsOn}}, {{2, +1, 60'833}, {3, -1, 60'000}, {4, -1, 53'000}}, 60'000},
    {11, false, {{1, +1, 50'833}}, {{2, -1, 39'167}, {3, +1, 40'000}, {4, -1, 33'000}}, 40'000},
    {12, true,  {{0, +1, 81'833}}, {{1, -1, 71'167}, {2, +1, 72'000}, {3, -1, 65'000}}, 72'000},
};

enum class Outcome { home, runs_into_limit, refused };

/// Where it starts, and what that changes.
struct Place {
  const char* name;
  std::int64_t start;
  Trace before_dog_search;    // DOG modes: leaving the DOG
  Outcome dog_modes;
  bool limit_modes_search;    // false: the limit is already on
};

const std::vector<Place> kPlaces = {
    {"before the DOG", 0, {}, Outcome::home, true},
    {"on the near limit", -20'500, {}, Outcome::home, true},
    {"on the DOG, 6 x 999 away from it", 55'000,
     {{0, -1, 54'001}, {0, -1, 53'002}, {0, -1, 52'003}, {0, -1, 51'004}, {0, -1, 50'005}, {0, -1, 49'006}},
     Outcome::home, true},
    {"between DOG and far limit", 70'000, {}, Outcome::runs_into_limit, true},
    {"on the far limit", 82'000, {}, Outcome::refused, false},
};
// clang-format on

Trace operator+(Trace first, const Trace& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

struct Expected {
  Trace trace{};
  Ending ending{};
  bool refused = false;
};

Expected expected(const ModeCase& mode, const Place& place) {
  if (mode.by_limit) {
    return {.trace = (place.limit_modes_search ? mode.search : Trace{}) + mode.from_there};
  }
  switch (place.dog_modes) {
    case Outcome::home: break;
    case Outcome::runs_into_limit:
      return {.trace = {{1, +1, 81'000}}, .ending = {.by = Cause::limit_plus, .in_row = 1}};
    case Outcome::refused: return {.refused = true};
  }
  return {.trace = place.before_dog_search + mode.search + mode.from_there};
}

TEST(HomingSuper40nc, EveryModeFromEveryPlaceInBothDirections) {
  for (const ModeCase& mode : kModes) {
    for (const Place& place : kPlaces) {
      for (const bool turned : {false, true}) {
        SCOPED_TRACE("mode " + std::to_string(mode.mode) + ", " + place.name + (turned ? ", mirrored" : ""));
        Super40ncHoming how = super40nc_factory(mode.mode);
        how.index_count = 3;
        how.leave_pulses = 999;
        how.offset_pulses = -7000;
        const Environment environment = super40nc_machine();
        Expected wanted = expected(mode, place);
        if (turned) {
          how = mirrored(how);
          wanted.trace = mirrored(wanted.trace);
          wanted.ending.by = mirrored(wanted.ending.by);
        }
        HomingBench bench(turned ? mirrored(environment) : environment, turned ? -place.start : place.start);
        const Cause refused = bench.home(super40nc_homing(how));
        if (wanted.refused) {
          EXPECT_EQ(refused, turned ? Cause::limit_minus : Cause::limit_plus);
          EXPECT_FALSE(bench.axis.moving());
          continue;
        }
        ASSERT_EQ(refused, Cause::none);
        ASSERT_TRUE(bench.run());
        EXPECT_EQ(bench.trace, wanted.trace);
        expect_ended(bench, wanted.ending);
        if (wanted.ending.by == Cause::arrived) {
          EXPECT_TRUE(bench.axis.homing.reference_known);
          EXPECT_EQ(bench.axis.homing.reference_pulses, turned ? -mode.reference : mode.reference);
        }
        EXPECT_EQ(super40nc_homes_by_limit(mode.mode), mode.by_limit);
      }
    }
  }
}

TEST(HomingSuper40nc, TheFirstExampleEnds200000BehindTheThirdIndex) {
  Super40ncHoming how = super40nc_factory(4);
  how.index_count = 2 + 1;  // X31 = 2
  how.offset_pulses = -200'000;
  Environment environment;
  environment.add(Signal::home, 50'000, 52'000);
  environment.index_period = 4000;
  HomingBench bench(environment, 0);
  ASSERT_EQ(bench.home(super40nc_homing(how)), Cause::none);
  ASSERT_TRUE(bench.run());
  EXPECT_EQ(bench.trace, (Trace{{1, +1, 50'833}, {2, -1, 40'000}, {3, -1, -160'000}}));
  EXPECT_EQ(bench.axis.homing.reference_pulses, 40'000);
  EXPECT_EQ(bench.pulses_out, -160'000);
  expect_ended(bench, {});
}

TEST(HomingSuper40nc, TheManualsSecondExampleEndsOnTheEdge) {
  Super40ncHoming how = super40nc_factory(1);
  how.direction = -1;
  Environment environment;
  environment.add(Signal::home, -10'000, -5000);
  HomingBench bench(environment, 0);
  ASSERT_EQ(bench.home(super40nc_homing(how)), Cause::none);
  ASSERT_TRUE(bench.run());
  EXPECT_EQ(bench.trace, (Trace{{1, -1, -5833}, {2, +1, -4999}, {3, -1, -5000}}));
  EXPECT_EQ(bench.axis.travel_pulses, -5000);
  expect_ended(bench, {});
}

TEST(HomingSuper40nc, TakesTheTimeOfItsLegs) {
  const auto ramped = [](double pulses, double speed) { return time_to_reach_s(pulses, speed, kSlope); };
  const double brake_s = kFastPps / kSlope;
  struct Timed {
    int mode;
    double seconds;
  };
  const std::vector<Timed> table = {
      {0, ramped(50'000, kFastPps) + brake_s},
      {1, ramped(50'000, kFastPps) + brake_s + ramped(834, kCreepPps) + ramped(1, kCreepPps)},
      // Down to 20 rpm, (v^2 - w^2) / 2a = 832 pulses on the way, and on to the third EZ.
      {2, ramped(50'000, kFastPps) + (kFastPps - kCreepPps) / kSlope +
              (10'000 - brake_pulses(kFastPps, kSlope) + brake_pulses(kCreepPps, kSlope)) / kCreepPps},
      {3, ramped(60'000, kFastPps) + brake_s},
      {4, ramped(50'000, kFastPps) + brake_s + ramped(10'833, kCreepPps)},
      {5, ramped(50'000, kFastPps) + brake_s + ramped(10'833, kFastPps) + brake_s},
      {6, ramped(81'000, kFastPps) + brake_s + ramped(834, kCreepPps)},
      {9, ramped(50'000, kFastPps) + brake_s + time_of_move_s(833, kFastPps, kSlope)},
  };
  for (const Timed& row : table) {
    SCOPED_TRACE("mode " + std::to_string(row.mode));
    Super40ncHoming how = super40nc_factory(row.mode);
    how.index_count = 3;
    HomingBench bench(super40nc_machine(), 0);
    const Tick begun = bench.now + 1;
    ASSERT_EQ(bench.home(super40nc_homing(how)), Cause::none);
    ASSERT_TRUE(bench.run());
    // Each leg that ends with its profile ends on a tick: up to one tick later.
    EXPECT_NEAR(static_cast<double>(bench.now - begun), row.seconds * 1000, 3.0);
  }
}

TEST(HomingSuper40nc, TheStartSpeedShortensTheBrakingDistance) {
  Super40ncHoming how = super40nc_factory(0);
  how.fast = slope_law(kFastPps, kSlope, 10'000);
  HomingBench bench(super40nc_machine(), 0);
  ASSERT_EQ(bench.home(super40nc_homing(how)), Cause::none);
  ASSERT_TRUE(bench.run());
  // (33333^2 - 10000^2) / 2a = 758.3
  EXPECT_EQ(bench.trace, (Trace{{1, +1, 50'758}}));
}

TEST(HomingSuper40nc, TheLimitCanStopAtOnceAsTheChipWould) {
  for (const auto& [mode, last] : std::vector<std::pair<int, std::int64_t>>{{6, 80'999}, {7, 80'000}}) {
    Super40ncHoming how = super40nc_factory(mode);
    how.limit_stops_at_once = true;
    HomingBench bench(super40nc_machine(), 0);
    ASSERT_EQ(bench.home(super40nc_homing(how)), Cause::none);
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.trace, (Trace{{0, +1, 81'000}, {1, -1, last}}));
  }
}

TEST(HomingSuper40nc, ALimitThatStopsDoesNotDisturbModesThatSeekIt) {
  for (const Reaction reaction : {Reaction::stop_at_once, Reaction::slow_down, Reaction::ignore}) {
    HomingBench bench(super40nc_machine(), 0);
    bench.axis.set({.at_limit_plus = reaction});
    ASSERT_EQ(bench.home(super40nc_homing(super40nc_factory(6))), Cause::none);
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.trace, (Trace{{0, +1, 81'833}, {1, -1, 80'999}}));
  }
}

TEST(HomingSuper40nc, AnIndexAtTheReversalOrOnTheDogsEdgeIsNotCounted) {
  // Mode 2, DOG and EZ at the same pulse: the next EZ is the first.
  Environment environment;
  environment.add(Signal::home, 48'000, 60'000);
  environment.index_period = 4000;
  HomingBench on_edge(environment, 0);
  ASSERT_EQ(on_edge.home(super40nc_homing(super40nc_factory(2))), Cause::none);
  ASSERT_TRUE(on_edge.run());
  EXPECT_EQ(on_edge.trace, (Trace{{1, +1, kRunsOn}, {2, +1, 52'000}}));

  // Mode 4, on EZ when it reverses: 833 behind the edge.
  environment = Environment{};
  environment.add(Signal::home, 50'000, 60'000);
  environment.index_period = 4000;
  environment.index_at = 50'833;
  HomingBench at_reversal(environment, 0);
  ASSERT_EQ(at_reversal.home(super40nc_homing(super40nc_factory(4))), Cause::none);
  ASSERT_TRUE(at_reversal.run());
  EXPECT_EQ(at_reversal.trace, (Trace{{1, +1, 50'833}, {2, -1, 46'833}}));
}

TEST(HomingSuper40nc, AWideIndexIsMetAtItsEdgeOnEitherSide) {
  Environment environment = super40nc_machine();
  environment.index_width = 10;
  HomingBench up(environment, 0);
  ASSERT_EQ(up.home(super40nc_homing(super40nc_factory(2))), Cause::none);
  ASSERT_TRUE(up.run());
  EXPECT_EQ(up.axis.travel_pulses, 52'000);
  HomingBench down(environment, 0);
  ASSERT_EQ(down.home(super40nc_homing(super40nc_factory(4))), Cause::none);
  ASSERT_TRUE(down.run());
  EXPECT_EQ(down.axis.travel_pulses, 48'009);
}

TEST(HomingSuper40nc, ALeaveDistanceOfZeroActsAsOne) {
  Super40ncHoming how = super40nc_factory(0);
  how.leave_pulses = 0;
  HomingBench bench(super40nc_machine(), 50'002);
  ASSERT_EQ(bench.home(super40nc_homing(how)), Cause::none);
  ASSERT_TRUE(bench.run());
  // One pulse to the DOG: decelerates from sqrt(2a) over one pulse more.
  EXPECT_EQ(bench.trace, (Trace{{0, -1, 50'001}, {0, -1, 50'000}, {0, -1, 49'999}, {1, +1, 50'001}}));
}

TEST(HomingSuper40nc, ThereAreThirteenModes) {
  EXPECT_THROW(super40nc_homing(super40nc_factory(13)), BadMotion);
  EXPECT_THROW(super40nc_homing(super40nc_factory(-1)), BadMotion);
}

}  // namespace homing_super40nc_test
}  // namespace understudy::motion
