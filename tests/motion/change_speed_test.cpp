// A different speed, and a stop, during motion: by hand.
#include <gtest/gtest.h>

#include <vector>

#include "tests/motion/move_checks.h"

namespace understudy::motion {
namespace change_speed_test {

const RampLaw kUp = RampLaw::by_slope(100);
const RampLaw kDown = RampLaw::by_slope(200);
const RampLaw kSoft = RampLaw::by_jerk(100);  // 0 to 100 u/s in 2 s, half way with 100 u/s^2 after one

SpeedLaw law(double start, const RampLaw& up, const RampLaw& down) {
  return {.start_speed_u_s = start, .top_speed_u_s = 100, .up = up, .down = down};
}

struct Row {
  const char* what;
  SpeedLaw law;
  Sample now;
  double speed, change_s, change_u;  // until it keeps the new speed, or is at rest
};

Sample moving(double speed, double acceleration = 0) {
  return {.position_u = 1000, .speed_u_s = speed, .acceleration_u_s2 = acceleration};
}

TEST(ChangeSpeed, TakesARampToTheNewSpeedAndKeepsIt) {
  const double root = std::sqrt(2.0);
  for (const Row& row : std::vector<Row>{
           {"up", law(0, kUp, kDown), moving(100), 150, 0.5, 62.5},
           {"down", law(0, kUp, kDown), moving(100), 40, 0.3, 21},
           {"none", law(0, kUp, kDown), moving(70), 70, 0, 0},
           {"none but a rounding", law(0, RampLaw::by_time(5), kDown), moving(70), 70 * (1 + 1e-15), 0, 0},
           {"from rest", law(0, kUp, kDown), moving(0), 50, 0.5, 12.5},
           {"up while slowing down", law(0, kUp, kDown), moving(50, -200), 100, 0.5, 37.5},
           {"by time", law(0, RampLaw::by_time(2), kDown), moving(50), 60, 2, 110},
           {"from a standstill by a jump", law(20, kUp, kDown), moving(0), 120, 1, 70},
           {"from below the start speed", law(20, kUp, kDown), moving(10), 120, 1, 70},
           {"below the start speed", law(20, kUp, kDown), moving(100), 10, 0.4, 24},
           {"to the start speed", law(20, kUp, kDown), moving(100), 20, 0.4, 24},
           {"both below the start speed", law(20, kUp, kDown), moving(10), 15, 0, 0},
           {"by jerk from no acceleration", law(0, kSoft, kSoft), moving(0), 100, 2, 100},
           {"by jerk in the midst of it", law(0, kSoft, kSoft), moving(50, 100), 100, 1, 100 - 50.0 / 3},
           {"by jerk, passing it", law(0, kSoft, kSoft), moving(50, 100), 50, 1 + root,
            100 - 50.0 / 3 + 75 * root},
           {"by jerk, down and passing it", law(0, kSoft, kSoft), moving(100, -100), 100, 1 + root,
            50 + 50.0 / 3 + 75 * root},
       }) {
    SCOPED_TRACE(row.what);
    const Profile profile = change_speed(row.now, row.speed, row.law);
    EXPECT_TRUE(profile.endless());
    const Segment& last = profile.segments[static_cast<std::size_t>(profile.segment_count - 1)];
    EXPECT_NEAR(last.begin_s, row.change_s, 1e-9);
    EXPECT_NEAR(last.position_u, 1000 + row.change_u, 1e-9);
    EXPECT_EQ(last.speed_u_s, row.speed);
    EXPECT_EQ(profile.sample(1e6).speed_u_s, row.speed);
  }
}

TEST(ChangeSpeed, AJerkLawOvershootsUntilItsAccelerationFades) {
  for (const double acceleration : {1.0, 20.0, 60.0, 100.0}) {
    const Profile profile = change_speed(moving(50, acceleration), 30, law(0, kSoft, kSoft));
    const double bound = 50 + acceleration * acceleration / 200;
    EXPECT_NEAR(static_cast<double>(greatest_speed(profile)), bound, 1e-9);
    const Fault gap = gap_in(profile, 1000);
    EXPECT_FALSE(gap) << *gap;
    EXPECT_EQ(profile.sample(0).acceleration_u_s2, acceleration);
  }
}

TEST(ChangeSpeed, AnAccelerationTooHighForASofterLawDropsToItsLimit) {
  // From standstill jerk 100 reaches 100 u/s^2 at 50 u/s, and no more; so it continues to twice the speed at
  // most.
  const Profile profile = change_speed(moving(50, 1e6), 30, law(0, kSoft, kSoft));
  EXPECT_NEAR(static_cast<double>(greatest_speed(profile)), 100, 1e-6);
  EXPECT_NEAR(profile.sample(0).acceleration_u_s2, 100, 1e-6);
  EXPECT_EQ(profile.sample(0).speed_u_s, 50);
}

TEST(ChangeSpeed, ASectionLawPassesNoTopSpeed) {
  const SpeedLaw sections = law(0, RampLaw::by_sections(100, 50), kDown);
  const Profile profile = change_speed(moving(80, 100), 60, sections);
  EXPECT_NEAR(static_cast<double>(greatest_speed(profile)), 100, 1e-9);
}

TEST(SlowToStop, CoversTheDistanceOfItsRampAndEndsAtTheStartSpeed) {
  for (const Row& row : std::vector<Row>{
           {"from rest", law(0, kUp, kDown), moving(0), 0, 0, 0},
           {"by slope", law(0, kUp, kDown), moving(100), 0, 0.5, 25},
           {"by slope while speeding up", law(0, kUp, kDown), moving(100, 100), 0, 0.5, 25},
           {"by slope while slowing down", law(0, kUp, kDown), moving(50, -200), 0, 0.25, 6.25},
           {"to the start speed", law(20, kUp, kDown), moving(100), 20, 0.4, 24},
           {"from the start speed", law(20, kUp, kDown), moving(20), 0, 0, 0},
           {"from below it", law(20, kUp, kDown), moving(10), 0, 0, 0},
           {"by time", law(0, kUp, RampLaw::by_time(2)), moving(50), 0, 2, 50},
           {"by jerk", law(0, kSoft, kSoft), moving(100), 0, 2, 100},
           {"by jerk while speeding up", law(0, kSoft, kSoft), moving(50, 100), 0, 3, 200 - 50.0 / 3},
           {"by jerk half way down", law(0, kSoft, kSoft), moving(50, -100), 0, 1, 50.0 / 3},
           {"by jerk with a bound", law(0, kUp, RampLaw::by_jerk(100, 50)), moving(100), 0, 2.5, 125},
           {"by sections", law(0, kUp, RampLaw::by_sections(100, 10)), moving(100), 0, 1.2, 60},
       }) {
    SCOPED_TRACE(row.what);
    for (const Profile& profile : {slow_to_stop(row.now, row.law), change_speed(row.now, 0, row.law)}) {
      EXPECT_FALSE(profile.endless());
      EXPECT_NEAR(profile.duration_s, row.change_s, 1e-9);
      EXPECT_NEAR(profile.end_position_u, 1000 + row.change_u, 1e-9);
      EXPECT_EQ(profile.end_speed_u_s, row.speed);
      EXPECT_EQ(profile.sample(1e6).speed_u_s, 0);
      if (profile.segment_count == 0) continue;
      const Fault gap = gap_in(profile, 1000);
      EXPECT_FALSE(gap) << *gap;
      const Fault differs = differs_from_integral(profile, profile.end_position_u, 1000);
      EXPECT_FALSE(differs) << *differs;
    }
  }
}

}  // namespace change_speed_test
}  // namespace understudy::motion
