// A different target during motion: by hand.
#include <gtest/gtest.h>

#include <vector>

#include "tests/motion/move_checks.h"

namespace understudy::motion {
namespace change_target_test {

/// From rest to 100 u/s in 1 s and 50 u, and down in 0.5 s and 25 u.
SpeedLaw slopes() {
  return {.top_speed_u_s = 100, .up = RampLaw::by_slope(100), .down = RampLaw::by_slope(200)};
}
SpeedLaw from_start_speed() {
  SpeedLaw law = slopes();
  law.start_speed_u_s = 10;
  law.down = RampLaw::by_slope(100);  // 49.5 u and 0.9 s from the top speed
  return law;
}

struct Row {
  const char* what;
  Sample now;
  double target, duration_s;
};

void expect_rows(const SpeedLaw& law, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    SCOPED_TRACE(row.what);
    const Profile profile = change_target(row.now, row.target, law);
    EXPECT_NEAR(profile.duration_s, row.duration_s, 1e-9);
    EXPECT_EQ(profile.sample(profile.duration_s).position_u, row.target);
    EXPECT_EQ(profile.sample(1e6).speed_u_s, 0);
    if (profile.segment_count == 0) continue;
    EXPECT_EQ(profile.sample(0).position_u, row.now.position_u);
    const Fault gap = gap_in(profile, 1000);
    EXPECT_FALSE(gap) << *gap;
    const Fault differs = differs_from_integral(profile, row.target, 1000);
    EXPECT_FALSE(differs) << *differs;
  }
}

double triangle_s(double distance) { return std::sqrt(2 * distance * (1.0 / 100 + 1.0 / 200)); }

TEST(ChangeTarget, IsMetFromAnywhereOnATrapezoid) {
  const Sample cruising{.position_u = 150, .speed_u_s = 100};
  const Sample rising{.position_u = 12.5, .speed_u_s = 50, .acceleration_u_s2 = 100};
  const Sample falling{.position_u = 268.75, .speed_u_s = 50, .acceleration_u_s2 = -200};
  const Sample resting{.position_u = 100};
  const double peak = std::sqrt(20'000.0 / 3);  // (p^2 - 2500) / 200 + p^2 / 400 = 37.5
  expect_rows(slopes(), {
                            {"cruising, farther", cruising, 375, 2.5},
                            {"cruising, as it was", cruising, 275, 1.5},
                            {"cruising, just to be reached", cruising, 175, 0.5},
                            {"cruising, too near", cruising, 170, 0.5 + triangle_s(5)},
                            {"cruising, here", cruising, 150, 0.5 + triangle_s(25)},
                            {"cruising, back to the beginning", cruising, 0, 0.5 + 2.5},
                            {"cruising, behind the beginning", cruising, -100, 0.5 + 3.5},
                            {"rising, as it was", rising, 275, 3},
                            {"rising, to a lower peak", rising, 50, (peak - 50) / 100 + peak / 200},
                            {"rising, just to be reached", rising, 18.75, 0.25},
                            {"rising, too near", rising, 18, 0.25 + triangle_s(0.75)},
                            {"falling, as it was", falling, 275, 0.25},
                            {"falling, too near", falling, 274, 0.25 + triangle_s(1)},
                            {"falling, farther", falling, 375, 0.5 + 0.5 + (106.25 - 37.5 - 25) / 100},
                            {"resting, ahead", resting, 300, 1 + 1.25 + 0.5},
                            {"resting, behind", resting, 60, triangle_s(40)},
                            {"resting, here", resting, 100, 0},
                        });
}

TEST(ChangeTarget, ALoweredTopSpeedIsGoneDownToOnTheWay) {
  SpeedLaw slower = slopes();
  slower.top_speed_u_s = 50;
  // Down to 50 in 0.25 s and 18.75 u, then on, then 6.25 u down.
  expect_rows(slower, {{"cruising", {.position_u = 0, .speed_u_s = 100}, 125, 0.25 + 2 + 0.25},
                       {"just to be reached", {.position_u = 0, .speed_u_s = 100}, 25, 0.5},
                       {"back at the lowered speed",
                        {.position_u = 0, .speed_u_s = 100},
                        -50,
                        0.5 + 0.5 + 0.25 + (75 - 12.5 - 6.25) / 50}});
}

TEST(ChangeTarget, SCurvesContinueWithTheAccelerationTheyHave) {
  const SpeedLaw soft{.top_speed_u_s = 100, .up = RampLaw::by_jerk(100), .down = RampLaw::by_jerk(100)};
  const double up_u = 50.0 / 3;  // in the first second, to 50 u/s and 100 u/s^2
  const Sample rising{.position_u = up_u, .speed_u_s = 50, .acceleration_u_s2 = 100};
  const Sample falling{.position_u = 400 - up_u, .speed_u_s = 50, .acceleration_u_s2 = -100};
  expect_rows(soft, {
                        {"rising, as it was", rising, 400, 5},
                        {"rising, farther", rising, 500, 6},
                        {"rising, just to be reached", rising, 200, 3},
                        {"rising, too near", rising, 172, 3 + 4 * std::cbrt(0.14)},
                        {"falling, as it was", falling, 400, 1},
                        {"falling, too near", falling, 372, 1 + 4 * std::cbrt(0.14)},
                    });
}

TEST(ChangeTarget, AStartSpeedIsStoppedFromAndTurnedRoundAt) {
  const Sample cruising{.position_u = 0, .speed_u_s = 100};
  const Sample creeping{.position_u = 0, .speed_u_s = 5};
  expect_rows(from_start_speed(), {
                                      {"ahead", cruising, 149.5, 1 + 0.9},
                                      {"just to be reached", cruising, 49.5, 0.9},
                                      {"turning round", cruising, -49.5, 0.9 + 0.9 + 0.9},
                                      {"below the start speed, ahead", creeping, 99, 1.8},
                                      {"below the start speed, behind", creeping, -99, 1.8},
                                  });
  const Profile back = change_target(cruising, -49.5, from_start_speed());
  EXPECT_NEAR(back.sample(0.9 - 1e-9).speed_u_s, 10, 1e-6);
  EXPECT_NEAR(back.sample(0.9 + 1e-9).speed_u_s, -10, 1e-6);
}

TEST(ChangeTarget, WhatIsLeftByAnOffsetIsCrept) {
  SpeedLaw law = from_start_speed();
  law.slow_down_offset_u = 8;
  const Sample cruising{.position_u = 0, .speed_u_s = 100};
  const Sample falling{.position_u = 0, .speed_u_s = 20, .acceleration_u_s2 = -100};  // 1.5 u to go, 0.1 s
  expect_rows(law, {
                       {"ahead", cruising, 157.5, 1 + 0.9 + 0.8},
                       {"slowing down already", falling, 9.5, 0.1 + 0.8},
                       {"slowing down, less left", falling, 5.5, 0.1 + 0.4},
                       {"turning round", falling, -6.5, 0.1 + 0.8},
                   });
}

TEST(ChangeTarget, ARampReckonedTooShortIsCutOffOnTheTarget) {
  SpeedLaw law = from_start_speed();
  law.slow_down_reckoned_by = law.down;
  law.down = RampLaw::by_slope(50);  // takes 99 u, of which 49.5 are planned for
  const Sample cruising{.position_u = 0, .speed_u_s = 100};
  expect_rows(
      law, {
               {"ahead", cruising, 149.5, 1 + 2 - std::sqrt(2.02)},
               {"nearer than the whole ramp", cruising, 59.5, 0.1 + 2 - std::sqrt(2.02)},
               {"nearer than reckoned: stops, and comes back", cruising, 0, 1.8 + plan(99, law).duration_s},
           });
  EXPECT_NEAR(change_target(cruising, 59.5, law).end_speed_u_s, std::sqrt(5050.0), 1e-6);
}

TEST(ChangeTarget, ATargetBehindIsReachedEvenIfTheMoveWouldBeCutOff) {
  SpeedLaw law = from_start_speed();
  law.slow_down_offset_u = -8;
  const Sample slow{.position_u = 3, .speed_u_s = 5};
  const Profile profile = change_target(slow, 1, law);
  EXPECT_EQ(profile.sample(0).position_u, 3);
  EXPECT_EQ(profile.end_position_u, 1);
  EXPECT_LT(profile.sample(profile.duration_s / 2).speed_u_s, 0);
}

}  // namespace change_target_test
}  // namespace understudy::motion
