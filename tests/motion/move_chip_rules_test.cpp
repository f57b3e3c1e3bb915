// Cases in which chips start to decelerate at an unexpected position: by an offset (MCX314's AO), at a given
// position (PCL6045's PRDP), or for another ramp than the one that follows (SUPER-40NC). By hand.
#include <gtest/gtest.h>

#include <vector>

#include "motion/bad_motion.h"
#include "tests/motion/move_checks.h"

namespace understudy::motion {
namespace move_chip_rules_test {

/// From 10 u/s to 100 and back at 100 u/s^2: 49.5 u and 0.9 s in each direction.
SpeedLaw common() {
  return {.start_speed_u_s = 10,
          .top_speed_u_s = 100,
          .up = RampLaw::by_slope(100),
          .down = RampLaw::by_slope(100)};
}
SpeedLaw with_offset(double offset_u) {
  SpeedLaw law = common();
  law.slow_down_offset_u = offset_u;
  return law;
}
SpeedLaw slowed_at(double place_u, double offset_u = 0) {
  SpeedLaw law = with_offset(offset_u);
  law.slow_down_at_u = place_u;
  return law;
}
SpeedLaw reckoned(double slope, double reckoned_slope) {
  SpeedLaw law = common();
  law.down = RampLaw::by_slope(slope);
  law.slow_down_reckoned_by = RampLaw::by_slope(reckoned_slope);
  return law;
}

struct Row {
  const char* what;
  SpeedLaw law;
  double distance_u, duration_s, peak_u_s, end_u_s;
};

void expect_rows(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    SCOPED_TRACE(row.what);
    const Profile profile = plan(row.distance_u, row.law);
    EXPECT_NEAR(profile.duration_s, row.duration_s, 1e-8);
    EXPECT_NEAR(static_cast<double>(greatest_speed(profile)), row.peak_u_s, 1e-6);
    EXPECT_NEAR(profile.end_speed_u_s, row.end_u_s, 1e-6);
    for (const Fault& fault : {off_target(profile, row.distance_u), gap_in(profile, row.distance_u + 10),
                               beyond_limits(profile, row.law, false)}) {
      EXPECT_FALSE(fault) << *fault;
    }
  }
}

TEST(MoveChipRules, AnOffsetAboveZeroLeavesThatMuchToCreep) {
  expect_rows({
      {"AO 8", with_offset(8), 250, 0.9 + 1.43 + 0.9 + 0.8, 100, 10},
      {"AO 1", with_offset(1), 250, 0.9 + 1.50 + 0.9 + 0.1, 100, 10},
      {"no AO", with_offset(0), 250, 0.9 + 1.51 + 0.9, 100, 10},
      {"a triangle makes room for it", with_offset(8), 47, 2 * (std::sqrt(4000.0) - 10) / 100 + 0.8,
       std::sqrt(4000.0), 10},
      {"all of it is crept", with_offset(8), 8, 0.8, 10, 10},
      {"less than the offset", with_offset(8), 2, 0.2, 10, 10},
      {"one pulse", with_offset(8), 1, 0.1, 10, 10},
  });
}

// The triangle above: 39 u are left for both ramps, (v^2 - 100) / 100 = 39; each takes (v - 10) / 100.
TEST(MoveChipRules, ATriangleWithAnOffsetEndsByCreeping) {
  const Profile profile = plan(47, with_offset(8));
  const double ramp_s = (std::sqrt(4000.0) - 10) / 100;
  EXPECT_NEAR(profile.duration_s, 2 * ramp_s + 0.8, 1e-9);
  EXPECT_NEAR(profile.sample(2 * ramp_s).position_u, 39, 1e-9);
}

TEST(MoveChipRules, AnOffsetBelowZeroCutsTheMoveOff) {
  // 100 t - 50 t^2 = 41.5 at t = 1 - sqrt(0.17); the speed there is the root of 10^4 - 200 * 41.5.
  expect_rows({
      {"AO -8", with_offset(-8), 250, 0.9 + 1.59 + 1 - std::sqrt(0.17), 100, std::sqrt(1700.0)},
      {"more than the ramp: no slowing down", with_offset(-49.5), 250, 0.9 + 2.005, 100, 100},
      {"cut off while speeding up", with_offset(-1000), 22, (std::sqrt(4500.0) - 10) / 100, std::sqrt(4500.0),
       std::sqrt(4500.0)},
      {"one pulse", with_offset(-8), 1, (std::sqrt(300.0) - 10) / 100, std::sqrt(300.0), std::sqrt(300.0)},
  });
}

TEST(MoveChipRules, AFixedPlaceToSlowDownIsNotReckoned) {
  expect_rows({
      {"just right", slowed_at(49.5), 250, 0.9 + 1.51 + 0.9, 100, 10},
      {"late", slowed_at(30), 250, 0.9 + 1.705 + 1 - std::sqrt(0.4), 100, std::sqrt(4000.0)},
      {"early", slowed_at(80), 250, 0.9 + 1.205 + 0.9 + 3.05, 100, 10},
      {"never", slowed_at(0), 250, 0.9 + 2.005, 100, 100},
      {"at the beginning", slowed_at(250), 250, 25, 10, 10},
      {"before the beginning", slowed_at(1000), 250, 25, 10, 10},
      {"with an offset", slowed_at(41.5, 8), 250, 0.9 + 1.51 + 0.9, 100, 10},
      {"with an offset to nothing", slowed_at(49.5, -49.5), 250, 0.9 + 2.005, 100, 100},
      // Accelerating for 22 u, to the root of 100 + 200 * 22, and down again from there.
      {"reached while speeding up", slowed_at(22), 44, 2 * (std::sqrt(4500.0) - 10) / 100, std::sqrt(4500.0),
       10},
      {"one pulse", slowed_at(30), 1, 0.1, 10, 10},
  });
}

TEST(MoveChipRules, ATooShortRampIsCutOffAndATooLongOneEndsCreeping) {
  expect_rows({
      {"right", reckoned(100, 100), 250, 0.9 + 1.51 + 0.9, 100, 10},
      // 100 t - 25 t^2 = 49.5 at t = 2 - sqrt(2.02)
      {"too short", reckoned(50, 100), 250, 0.9 + 1.51 + 2 - std::sqrt(2.02), 100, std::sqrt(5050.0)},
      {"too long", reckoned(200, 100), 250, 0.9 + 1.51 + 0.45 + 2.475, 100, 10},
      // 99 u for both ramps, as planned: the top is just reached.
      {"too short, no cruise", reckoned(50, 100), 99, 0.9 + 2 - std::sqrt(2.02), 100, std::sqrt(5050.0)},
      {"too short, short", reckoned(50, 100), 39,
       (std::sqrt(4000.0) - 10) / 100 + (std::sqrt(4000.0) - std::sqrt(2050.0)) / 50, std::sqrt(4000.0),
       std::sqrt(2050.0)},
  });
}

TEST(MoveChipRules, ThereIsNoCreepingFromAStandstill) {
  SpeedLaw law = with_offset(8);
  law.start_speed_u_s = 0;
  SpeedLaw early = slowed_at(80);
  early.start_speed_u_s = 0;
  SpeedLaw too_long = reckoned(200, 100);
  too_long.start_speed_u_s = 0;
  for (const SpeedLaw& bad : {law, early, too_long}) {
    try {
      plan(250, bad);
      ADD_FAILURE() << "creeps at no speed";
    } catch (const BadMotion& error) {
      EXPECT_EQ(error.refusal(), Refusal::not_positive);
      EXPECT_NE(std::string(error.what()).find("start speed"), std::string::npos) << error.what();
    }
  }
}

TEST(MoveChipRules, FromAStandstillALateRampIsCutOffAllTheSame) {
  SpeedLaw law = slowed_at(18);
  law.start_speed_u_s = 0;
  const Profile profile = plan(250, law);  // 50 up, 182 along, 18 of the 50 down
  EXPECT_NEAR(profile.duration_s, 1 + 1.82 + 0.2, 1e-9);
  EXPECT_NEAR(profile.end_speed_u_s, 80, 1e-6);
}

}  // namespace move_chip_rules_test
}  // namespace understudy::motion
