// Moves by hand: numbers that anyone can check with a pencil.
#include <gtest/gtest.h>

#include <vector>

#include "tests/motion/move_checks.h"

namespace understudy::motion {
namespace move_table_test {

const RampLaw kSlope100 = RampLaw::by_slope(100);
const RampLaw kSlope200 = RampLaw::by_slope(200);
const RampLaw kSlope400 = RampLaw::by_slope(400);

SpeedLaw law(double start, double top, const RampLaw& up, const RampLaw& down,
             Short when_short = Short::lower_top) {
  return {.start_speed_u_s = start, .top_speed_u_s = top, .up = up, .down = down, .when_short = when_short};
}

struct Row {
  const char* what;
  SpeedLaw law;
  double distance_u, peak_u_s, rise_u, cruise_u, fall_u, duration_s;
};

/// The distance of the segments in which speed rises, stays or falls.
double distance_of(const Profile& profile, int sense) {
  double sum = 0;
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    const Segment& segment = profile.segments[static_cast<std::size_t>(i)];
    if (sense_of(segment) != sense) continue;
    const auto duration_s = static_cast<double>(segment_end_s(profile, i)) - segment.begin_s;
    sum += sample_segment(segment, duration_s).position_u - segment.position_u;
  }
  return sum;
}

void expect_rows(const std::vector<Row>& rows, bool whole_ramps = true) {
  for (const Row& row : rows) {
    SCOPED_TRACE(row.what);
    const Profile profile = plan(row.distance_u, row.law);
    EXPECT_NEAR(static_cast<double>(greatest_speed(profile)), row.peak_u_s, 1e-9 * row.peak_u_s);
    EXPECT_NEAR(distance_of(profile, +1), row.rise_u, 1e-9 * row.distance_u);
    EXPECT_NEAR(distance_of(profile, 0), row.cruise_u, 1e-9 * row.distance_u);
    EXPECT_NEAR(distance_of(profile, -1), row.fall_u, 1e-9 * row.distance_u);
    EXPECT_NEAR(profile.duration_s, row.duration_s, 1e-9 * row.duration_s);
    EXPECT_EQ(profile.end_speed_u_s, std::min(row.law.start_speed_u_s, row.law.top_speed_u_s));
    for (const Fault& fault : {off_target(profile, row.distance_u), gap_in(profile, row.distance_u),
                               beyond_limits(profile, row.law, whole_ramps),
                               differs_from_integral(profile, row.distance_u, row.distance_u)}) {
      EXPECT_FALSE(fault) << *fault;
    }
  }
}

TEST(MoveTable, TrapezoidsBySlopesCoverTheExpectedDistance) {
  expect_rows({
      {"from rest", law(0, 100, kSlope100, kSlope200), 275, 100, 50, 200, 25, 3.5},
      {"from a start speed", law(100, 500, kSlope400, RampLaw::by_slope(800)), 1450, 500, 300, 1000, 150,
       3.5},
      {"ramps that just fit", law(0, 100, kSlope100, kSlope200), 75, 100, 50, 0, 25, 1.5},
      {"a triangle", law(0, 1000, kSlope100, kSlope100), 400, 200, 200, 0, 200, 4},
      {"a lopsided triangle", law(0, 1000, kSlope100, RampLaw::by_slope(300)), 600, 300, 450, 0, 150, 4},
      {"a triangle on a start speed", law(100, 1000, kSlope200, kSlope400), 300, 300, 200, 0, 100, 1.5},
      {"one pulse", law(0, 1000, kSlope100, kSlope100), 1, 10, 0.5, 0, 0.5, 0.2},
      {"two pulses", law(0, 1000, kSlope400, kSlope100), 2, std::sqrt(320.0), 0.4, 0, 1.6,
       std::sqrt(320.0) / 80},
  });
}

TEST(MoveTable, TrapezoidsByTimesCoverHalfTheirTopSpeedInEachRamp) {
  const RampLaw one = RampLaw::by_time(1);
  const RampLaw three = RampLaw::by_time(3);
  expect_rows({
      {"from rest", law(0, 200, one, three), 1000, 200, 100, 600, 300, 7},
      {"ramps that just fit", law(0, 200, one, three), 400, 200, 100, 0, 300, 4},
      {"a triangle takes as long", law(0, 200, one, three), 200, 100, 50, 0, 150, 4},
      {"one pulse, too", law(0, 200, one, three), 1, 0.5, 0.25, 0, 0.75, 4},
      {"on a start speed", law(50, 150, one, one), 400, 150, 100, 200, 100, 2 + 200.0 / 150},
      {"a triangle on a start speed", law(50, 150, one, one), 160, 110, 80, 0, 80, 2},
      {"just no ramp", law(50, 150, one, one), 100, 50, 0, 100, 0, 2},
      {"too short for its ramps", law(50, 150, one, one), 60, 50, 0, 60, 0, 1.2},
  });
}

TEST(MoveTable, SCurvesByJerkTakeTwiceTheRootOfChangeOverJerk) {
  const RampLaw soft = RampLaw::by_jerk(100);  // 100 u/s in 2 s
  const RampLaw hard = RampLaw::by_jerk(400);  // 100 u/s in 1 s
  expect_rows({
      {"symmetric", law(0, 100, soft, soft), 400, 100, 100, 200, 100, 6},
      {"K and L", law(0, 100, soft, hard), 350, 100, 100, 200, 50, 5},
      {"on a start speed", law(50, 150, soft, hard), 450, 150, 200, 150, 100, 4},
      {"ramps that just fit", law(0, 100, soft, hard), 150, 100, 100, 0, 50, 3},
      {"a rounded triangle", law(0, 1000, soft, soft), 200, 100, 100, 0, 100, 4},
      {"a lopsided one", law(0, 1000, soft, hard), 150, 100, 100, 0, 50, 3},
      {"one on a start speed", law(50, 1000, soft, hard), 300, 150, 200, 0, 100, 3},
      {"one pulse", law(0, 1000, RampLaw::by_jerk(32), RampLaw::by_jerk(32)), 1, 2, 0.5, 0, 0.5, 1},
  });
}

TEST(MoveTable, SCurvesWithABoundGoStraightOnceTheyReachIt) {
  const RampLaw law50 = RampLaw::by_jerk(100, 50);  // the limit is reached at a change of 25 u/s
  expect_rows({
      {"long", law(0, 100, law50, law50), 450, 100, 125, 200, 125, 7},
      {"short, bound reached", law(0, 100, law50, law50), 75, 50, 37.5, 0, 37.5, 3},
      {"bound just reached", law(0, 100, law50, law50), 25, 25, 12.5, 0, 12.5, 2},
      {"bound not reached", law(0, 100, law50, law50), 16 * 0.8, 16, 6.4, 0, 6.4, 1.6},
      {"exactly the change as top", law(0, 25, law50, law50), 50, 25, 12.5, 25, 12.5, 3},
      {"up with, down without a bound", law(0, 100, law50, RampLaw::by_jerk(400)), 375, 100, 125, 200, 50,
       5.5},
  });
}

TEST(MoveTable, SCurvesBySectionsTakeTheirSectionsTwice) {
  const RampLaw ten = RampLaw::by_sections(100, 10);
  expect_rows({
      {"with straight parts", law(0, 100, ten, ten), 220, 100, 60, 100, 60, 3.4},
      {"without sections a slope", law(0, 100, RampLaw::by_sections(100, 0), kSlope200), 275, 100, 50, 200,
       25, 3.5},
      {"full S", law(0, 100, RampLaw::by_sections(100, 50), RampLaw::by_sections(200, 999)), 250, 100, 100,
       100, 50, 4},
      {"short, with straight parts", law(0, 100, ten, ten), 24, 40, 12, 0, 12, 1.2},
      {"short, just without", law(0, 100, ten, ten), 8, 20, 4, 0, 4, 0.8},
      {"short, full S", law(0, 100, ten, ten), 2, 10, 1, 0, 1, 0.4},
      {"on a start speed", law(100, 140, ten, ten), 200, 140, 72, 56, 72, 1.6},
  });
}

TEST(MoveTable, AtItsTopSpeedFromTheStartAMoveHasNoRamps) {
  for (const RampLaw& ramp : {kSlope100, RampLaw::by_time(1), RampLaw::by_jerk(100), RampLaw::by_jerk(100, 5),
                              RampLaw::by_sections(100, 5)}) {
    for (const Short when_short : {Short::lower_top, Short::keep_half, Short::cut_ramp}) {
      expect_rows({{"start == top", law(100, 100, ramp, ramp, when_short), 250, 100, 0, 250, 0, 2.5},
                   {"start > top", law(500, 100, ramp, ramp, when_short), 250, 100, 0, 250, 0, 2.5},
                   {"one pulse", law(100, 100, ramp, ramp, when_short), 1, 100, 0, 1, 0, 0.01}});
    }
  }
}

TEST(MoveTable, HalfTheDistanceIsKeptForConstantSpeed) {
  const Short half = Short::keep_half;
  const RampLaw soft = RampLaw::by_jerk(100);
  expect_rows({
      {"short", law(0, 1000, kSlope100, kSlope100, half), 800, 200, 200, 400, 200, 6},
      {"ramps just half", law(0, 200, kSlope100, kSlope100, half), 800, 200, 200, 400, 200, 6},
      {"long", law(0, 200, kSlope100, kSlope100, half), 1000, 200, 200, 600, 200, 7},
      {"ramps would fit, but take more than half", law(0, 200, kSlope100, kSlope200, half), 300,
       std::sqrt(2e4), 100, 150, 50, std::sqrt(2e4) * (0.015 + 150 / 2e4)},
      {"two pulses", law(0, 200, kSlope100, kSlope100, half), 2, 10, 0.5, 1, 0.5, 0.3},
      {"rounded", law(0, 1000, soft, soft, half), 400, 100, 100, 200, 100, 6},
      {"on a start speed", law(100, 900, kSlope200, kSlope400, half), 600, 300, 200, 300, 100, 2.5},
  });
}

TEST(MoveTable, ARampIsBrokenOffWhereSlowingDownMustBegin) {
  const Short cut = Short::cut_ramp;
  const RampLaw soft = RampLaw::by_jerk(100);
  const RampLaw full_s = RampLaw::by_sections(100, 50);
  const double third = 50.0 / 3;  // half way up 100 u/s at jerk 100: a second, 50 u/s, 16.667 u
  expect_rows(
      {
          {"a slope makes the same triangle", law(0, 1000, kSlope100, kSlope100, cut), 400, 200, 200, 0, 200,
           4},
          {"by time", law(0, 200, RampLaw::by_time(1), RampLaw::by_time(3), cut), 175, 100, 25, 0, 150, 3.5},
          {"by jerk", law(0, 100, soft, soft, cut), third + 25 * std::sqrt(2.0), 50, third, 0,
           25 * std::sqrt(2.0), 1 + std::sqrt(2.0)},
          {"by sections", law(0, 100, full_s, full_s, cut), third + 25, 50, third, 0, 25, 2},
          {"long enough", law(0, 100, soft, soft, cut), 400, 100, 100, 200, 100, 6},
          {"just long enough", law(0, 100, soft, soft, cut), 200, 100, 100, 0, 100, 4},
      },
      false);
}

TEST(MoveTable, WhereARoundedRampIsBrokenOffTheAccelerationJumps) {
  const RampLaw soft = RampLaw::by_jerk(100);
  const Profile profile = plan(50.0 / 3 + 25 * std::sqrt(2.0), law(0, 100, soft, soft, Short::cut_ramp));
  EXPECT_NEAR(profile.sample(1 - 1e-6).acceleration_u_s2, 100, 1e-3);
  EXPECT_NEAR(profile.sample(1 + 1e-6).acceleration_u_s2, 0, 1e-3);
}

TEST(MoveTable, NoDistanceIsNoMoveWhateverTheLaw) {
  for (const RampLaw& ramp :
       {kSlope100, RampLaw::by_time(1), RampLaw::by_jerk(100), RampLaw::by_sections(100, 5)}) {
    for (const Short when_short : {Short::lower_top, Short::keep_half, Short::cut_ramp}) {
      SpeedLaw any = law(10, 100, ramp, ramp, when_short);
      EXPECT_EQ(plan(0, any), Profile{});
      any.slow_down_at_u = 50;
      any.slow_down_offset_u = 8;
      EXPECT_EQ(plan(0, any), Profile{});
    }
  }
}

TEST(MoveTable, AnEndlessMoveRampsUpAndStaysThere) {
  const Profile profile = plan_endless(law(50, 150, RampLaw::by_jerk(100), kSlope100));
  EXPECT_TRUE(profile.endless());
  EXPECT_DOUBLE_EQ(profile.sample(0).speed_u_s, 50);
  EXPECT_NEAR(profile.sample(2).position_u, 200, 1e-9);
  EXPECT_NEAR(profile.sample(2).speed_u_s, 150, 1e-9);
  EXPECT_NEAR(profile.sample(1002).position_u, 200 + 150'000, 1e-6);
  EXPECT_FALSE(gap_in(profile, 1000));
  const Profile flat = plan_endless(law(150, 100, kSlope100, kSlope100));
  EXPECT_EQ(flat.segment_count, 1);
  EXPECT_DOUBLE_EQ(flat.sample(7).position_u, 700);
}

}  // namespace move_table_test
}  // namespace understudy::motion
