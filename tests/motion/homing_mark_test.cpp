// SUPER-40NC's MRK: past the target at the creep speed, which differs from the start speed, and on to a mark.
// Compared with closed forms, and from every position.
#include <gtest/gtest.h>

#include "tests/motion/homing_super40nc_bench.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace homing_mark_test {

/// 500 rpm and 20 rpm, the factory values, from a start speed of 1 rpm.
Super40ncMark mark(std::int64_t distance, std::int64_t search) {
  const double start = 1 * 4000 / 60.0;
  return {.distance_pulses = distance,
          .search_pulses = search,
          .fast = slope_law(kFastPps, kSlope, start),
          .creep = slope_law(kCreepPps, kSlope, start)};
}

Environment eye_at(std::int64_t from, std::int64_t to, Signal signal = Signal::limit_plus) {
  Environment environment;
  environment.add(signal, from, to);
  return environment;
}

TEST(HomingMark, APassingMoveIsAtItsTargetAtTheCreepSpeed) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(2000); ++i) {
    const auto start = static_cast<double>(random.of_any_size(1, 3'000));
    const auto top = static_cast<double>(random.of_any_size(100, 500'000));
    const auto creep = static_cast<double>(random.of_any_size(10, 20'000));
    const auto slope = static_cast<double>(random.of_any_size(1'000, 4'000'000));
    const auto distance = static_cast<double>(random.of_any_size(1, 1'000'000));
    const Profile profile = plan_passing(distance, creep, slope_law(top, slope, start));
    ASSERT_TRUE(profile.endless());
    const Segment& last = profile.segments[static_cast<std::size_t>(profile.segment_count - 1)];
    ASSERT_DOUBLE_EQ(last.speed_u_s, creep);
    const double from = std::min(start, top);
    const double floor = std::max(creep, from);
    const double shortest = std::max(0.0, floor * floor - from * from) / (2 * slope);
    if (top <= creep || distance < shortest * (1 - 1e-9)) {
      // The creep speed from the start, along its ramp.
      const double rise = std::max(0.0, creep * creep - start * start) / (2 * slope);
      ASSERT_NEAR(last.position_u, rise, 1e-6 + rise * 1e-9) << i;
      continue;
    }
    if (distance < shortest * (1 + 1e-9)) continue;
    ASSERT_NEAR(last.position_u, distance, 1e-6) << i;
    // The time: up to the peak, down to the creep speed, and the rest at the top.
    const double peak = std::min(top, std::sqrt((2 * slope * distance + from * from + floor * floor) / 2));
    const double ramps = (2 * peak * peak - from * from - floor * floor) / (2 * slope);
    const double time_s = (2 * peak - from - floor) / slope + (distance - ramps) / peak;
    ASSERT_NEAR(last.begin_s, time_s, 1e-9 + 1e-6 * time_s) << i;
  }
}

TEST(HomingMark, RunsThroughItsTargetAndStopsOnTheMark) {
  HomingBench bench(eye_at(5'300, 5'400), 0);
  bench.home(super40nc_mark(mark(5'000, 500)));
  // 833 pulses of ramp, minus those of 20 rpm: at the creep speed from 5000 on.
  Tick passed = 0;
  while (bench.axis.homing.active()) {
    bench.step();
    if (passed == 0 && bench.axis.travel_pulses >= 5'000) passed = bench.now;
    if (bench.axis.travel_pulses > 5'000 && bench.axis.moving()) {
      ASSERT_NEAR(bench.axis.sample(bench.now).speed_u_s, kCreepPps, 1e-6) << bench.now;
    }
  }
  expect_ended(bench, {});
  EXPECT_EQ(bench.axis.travel_pulses, 5'300);
  EXPECT_TRUE(bench.axis.homing.reference_known);
  EXPECT_EQ(bench.axis.homing.reference_pulses, 5'300);
  EXPECT_NEAR(static_cast<double>(bench.now - passed), 300 / kCreepPps * 1000, 1.5);
  EXPECT_EQ(bench.trace, (Trace{{.row = 0, .direction = 1, .stood_at = kRunsOn},
                                {.row = 1, .direction = 1, .stood_at = 5'300}}));
}

TEST(HomingMark, WithoutAMarkItEndsExactlyAtTheEndOfItsSearch) {
  for (const std::int64_t search : {1, 2, 499, 500}) {
    HomingBench bench(Environment{}, -700);
    bench.home(super40nc_mark(mark(5'000, search)));
    ASSERT_TRUE(bench.run());
    expect_ended(bench, {});
    EXPECT_EQ(bench.axis.travel_pulses, 4'300 + search);
    EXPECT_FALSE(bench.axis.homing.reference_known);
  }
}

TEST(HomingMark, OnlyWhatIsSeenFromTheTargetOnCounts) {
  // A mark passed before the target, even one at the start, is not a mark, and not a limit either.
  for (const auto& [from, to] : {std::pair{-10, 30}, std::pair{1'000, 1'200}, std::pair{4'990, 4'999}}) {
    HomingBench bench(eye_at(from, to), 0);
    EXPECT_EQ(bench.home(super40nc_mark(mark(5'000, 100))), Cause::none);
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.axis.travel_pulses, 5'100) << from;
  }
  // One that is on at the target stops it at once.
  for (const auto& [from, to] : {std::pair{4'000, 5'000}, std::pair{5'000, 5'000}, std::pair{-10, 9'000}}) {
    HomingBench bench(eye_at(from, to), 0);
    bench.home(super40nc_mark(mark(5'000, 100)));
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.axis.travel_pulses, 5'000) << from;
    EXPECT_EQ(bench.axis.homing.reference_pulses, 5'000);
  }
}

/// One that is on at the target has to come on again, if that is required.
TEST(HomingMark, MayDemandAnEdge) {
  struct Row {
    std::int64_t from, to, end;
  };
  for (const auto& [from, to, end] :
       {Row{4'000, 5'050, 5'100}, Row{-10, 9'000, 5'100}, Row{5'020, 5'050, 5'020}}) {
    HomingBench bench(eye_at(from, to), 0);
    Super40ncMark how = mark(5'000, 100);
    how.needs_edge = true;
    bench.home(super40nc_mark(how));
    ASSERT_TRUE(bench.run());
    EXPECT_EQ(bench.axis.travel_pulses, end) << from;
  }
}

TEST(HomingMark, TheOtherLimitIsALimit) {
  HomingBench bench(eye_at(-kFar, -2'000, Signal::limit_minus), 0);
  bench.home(super40nc_mark(mark(-5'000, 500)));
  ASSERT_TRUE(bench.run());
  expect_ended(bench, {.by = Cause::limit_minus, .in_row = 0});
  EXPECT_EQ(bench.axis.travel_pulses, -2'000);
}

TEST(HomingMark, AgainstTheTravelItStopsAndTurns) {
  HomingBench bench(eye_at(4'700, 4'800, Signal::limit_minus), 0);
  bench.home(super40nc_mark(mark(5'000, -500)));
  ASSERT_TRUE(bench.run());
  expect_ended(bench, {});
  EXPECT_EQ(bench.axis.travel_pulses, 4'800);
  EXPECT_EQ(bench.trace, (Trace{{.row = 0, .direction = 1, .stood_at = 5'000},
                                {.row = 1, .direction = -1, .stood_at = 4'800}}));
}

TEST(HomingMark, FromEveryPlaceEndsOnTheSamePulse) {
  // The same by single pulses: the first one from the target on at which the mark is on, or the end.
  RandomMoves random(seed() + 2);
  for (int i = 0; i < random_cases(400); ++i) {
    const int direction = random.between(0, 1) == 0 ? -1 : +1;
    const std::int64_t start = random.between(-3'000, 3'000);
    const std::int64_t distance = direction * random.of_any_size(1, 20'000);
    const std::int64_t search = random.of_any_size(1, 800);
    const std::int64_t from = start + distance + random.between(-300, 900) * direction;
    const std::int64_t other = from + direction * random.between(0, 200);
    const Signal eye = direction < 0 ? Signal::limit_minus : Signal::limit_plus;
    HomingBench bench(eye_at(std::min(from, other), std::max(from, other), eye), start);
    Super40ncMark how = mark(distance, direction * search);
    how.fast.top_speed_u_s = static_cast<double>(random.of_any_size(100, 400'000));
    how.creep.top_speed_u_s = static_cast<double>(random.of_any_size(100, 30'000));
    how.creep.start_speed_u_s = how.fast.start_speed_u_s = static_cast<double>(random.of_any_size(1, 5'000));
    bench.axis.settings.backlash_pulses = random.between(0, 20);
    bench.axis.settings.backlash_speed_pps = 1'000;
    bench.home(super40nc_mark(how));
    ASSERT_TRUE(bench.run(4'000'000));
    std::int64_t wanted = start + distance;
    while (wanted != start + distance + direction * search && (bench.environment.at(wanted) & bit(eye)) == 0)
      wanted += direction;
    ASSERT_EQ(bench.axis.travel_pulses, wanted) << "seed " << seed() << " case " << i;
  }
}

TEST(HomingMark, ASearchOfNothingIsRefused) {
  EXPECT_THROW(super40nc_mark(mark(100, 0)), BadMotion);
  HomingProgram program{.speeds = {slope_law(1000, 1e6)}};
  program.add({.within_pulses = -1});
  EXPECT_THROW(check(program), BadMotion);
}

}  // namespace homing_mark_test
}  // namespace understudy::motion
