#include "motion/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "motion/bisection.h"
#include "motion/pulse_drive.h"

namespace understudy::motion {
namespace profile_test {

constexpr double kForEver = std::numeric_limits<double>::infinity();

/// 1 s up to 100 u/s, 2 s there, 0.5 s down: 50 + 200 + 25 u.
Profile trapezoid() {
  Profile profile;
  profile.append(1, 0, 100, 0);
  profile.append(2, 100, 0, 0);
  profile.append(0.5, 100, -200, 0);
  return profile;
}

TEST(Profile, ADefaultMadeProfileIsNoMove) {
  const Profile none;
  EXPECT_EQ(none.duration_s, 0);
  EXPECT_EQ(none.end_position_u, 0);
  EXPECT_FALSE(none.endless());
  for (const double t_s : {-1.0, 0.0, 1.0}) {
    EXPECT_EQ(none.sample(t_s).position_u, 0);
    EXPECT_EQ(none.sample(t_s).speed_u_s, 0);
    EXPECT_EQ(none.sample(t_s).acceleration_u_s2, 0);
  }
}

TEST(Profile, EachSegmentBeginsWhereTheLastOneEnded) {
  const Profile profile = trapezoid();
  ASSERT_EQ(profile.segment_count, 3);
  EXPECT_DOUBLE_EQ(profile.segments[0].position_u, 0);
  EXPECT_DOUBLE_EQ(profile.segments[1].position_u, 50);
  EXPECT_DOUBLE_EQ(profile.segments[2].position_u, 250);
  EXPECT_DOUBLE_EQ(profile.segments[0].begin_s, 0);
  EXPECT_DOUBLE_EQ(profile.segments[1].begin_s, 1);
  EXPECT_DOUBLE_EQ(profile.segments[2].begin_s, 3);
  EXPECT_DOUBLE_EQ(profile.duration_s, 3.5);
  EXPECT_DOUBLE_EQ(profile.end_position_u, 275);
  EXPECT_DOUBLE_EQ(profile.end_speed_u_s, 0);
}

TEST(Profile, ASegmentOfNoDurationIsLeftOut) {
  Profile profile;
  profile.append(1, 0, 100, 0);
  profile.append(0, 100, 0, 0);
  profile.append(-1e-17, 100, 0, 0);  // what rounding makes of 0
  profile.append(1, 100, -100, 0);
  EXPECT_EQ(profile.segment_count, 2);
  EXPECT_DOUBLE_EQ(profile.duration_s, 2);
}

TEST(Profile, IsSampledInAnyOrderByElementaryKinematics) {
  struct Case {
    double t_s, position, speed, acceleration;
  };
  const std::vector<Case> cases = {{3.25, 268.75, 50, -200}, {0, 0, 0, 100},     {0.5, 12.5, 50, 100},
                                   {1, 50, 100, 0},          {2.5, 200, 100, 0}, {3, 250, 100, -200},
                                   {0.1, 0.5, 10, 100}};
  const Profile profile = trapezoid();
  for (const auto& [t_s, position, speed, acceleration] : cases) {
    const Sample sample = profile.sample(t_s);
    EXPECT_NEAR(sample.position_u, position, 1e-12) << t_s;
    EXPECT_NEAR(sample.speed_u_s, speed, 1e-12) << t_s;
    EXPECT_NEAR(sample.acceleration_u_s2, acceleration, 1e-12) << t_s;
  }
}

TEST(Profile, JerkIsTheThirdDerivative) {
  Profile profile;
  profile.append(2, 0, 0, 6);  // s = t^3, v = 3 t^2, a = 6 t
  profile.append(2, 12, 12, -6);
  EXPECT_NEAR(profile.sample(0.5).position_u, 0.125, 1e-15);
  EXPECT_NEAR(profile.sample(0.5).speed_u_s, 0.75, 1e-15);
  EXPECT_NEAR(profile.sample(0.5).acceleration_u_s2, 3, 1e-15);
  // 8 + 12 + 6 - 1
  EXPECT_NEAR(profile.sample(3).position_u, 25, 1e-12);
  EXPECT_NEAR(profile.sample(3).speed_u_s, 21, 1e-12);
  EXPECT_NEAR(profile.end_position_u, 48, 1e-12);
  EXPECT_NEAR(profile.end_speed_u_s, 24, 1e-12);
}

TEST(Profile, BeforeItIsTheBeginningAndAfterItTheEndAtRest) {
  Profile profile = Profile::from(1000);
  profile.append(1, 10, 0, 0);
  for (const double t_s : {-1.0, -1e-300, 0.0}) {
    EXPECT_EQ(profile.sample(t_s).position_u, 1000);
    EXPECT_EQ(profile.sample(t_s).speed_u_s, 10);
  }
  for (const double t_s : {1.0, 1e9}) {
    EXPECT_EQ(profile.sample(t_s).position_u, 1010);
    EXPECT_EQ(profile.sample(t_s).speed_u_s, 0);
  }
  EXPECT_EQ(profile.end_speed_u_s, 10) << "ends abruptly";
}

TEST(Profile, ItsEndIsWhatWasDeclaredNotWhatTheSegmentsSumUpTo) {
  Profile profile;
  for (int i = 0; i < 10; ++i) profile.append(0.1, 1, 0, 0);
  EXPECT_NE(profile.end_position_u, 1.0) << "0.1 ten times";
  profile.end_exactly_at(1);
  EXPECT_EQ(profile.sample(profile.duration_s).position_u, 1.0);
}

TEST(Profile, AnInfiniteSegmentNeverEnds) {
  Profile profile;
  profile.append(1, 0, 100, 0);
  profile.append(kForEver, 100, 0, 0);
  EXPECT_TRUE(profile.endless());
  EXPECT_FALSE(trapezoid().endless());
  EXPECT_DOUBLE_EQ(profile.sample(1e6).position_u, 50 + 100 * (1e6 - 1));
  EXPECT_DOUBLE_EQ(profile.sample(1e6).speed_u_s, 100);
  EXPECT_DOUBLE_EQ(profile.end_speed_u_s, 100);
}

TEST(Profile, IsCutWhereItFirstReachesAPosition) {
  struct Case {
    double position, duration_s, end_speed;
    std::int32_t segments;
  };
  const std::vector<Case> cases = {{12.5, 0.5, 50, 1}, {150, 2, 100, 2},        {268.75, 3.25, 50, 3},
                                   {50, 1, 100, 1},    {275 - 1e-6, 3.5, 0, 3}, {275, 3.5, 0, 3},
                                   {300, 3.5, 0, 3}};
  for (const auto& [position, duration_s, end_speed, segments] : cases) {
    Profile profile = trapezoid();
    profile.cut_at(position);
    EXPECT_NEAR(profile.duration_s, duration_s, 2e-4) << position;
    EXPECT_NEAR(profile.end_speed_u_s, end_speed, 0.03) << position;
    EXPECT_EQ(profile.segment_count, segments) << position;
    EXPECT_EQ(profile.end_position_u, std::min(position, 275.0));
    EXPECT_EQ(profile.sample(profile.duration_s).position_u, profile.end_position_u);
  }
}

TEST(Profile, CutAtItsBeginningNothingIsLeft) {
  Profile profile;
  profile.append(1, 0, 100, 0);
  profile.cut_at(0);
  Profile nothing;
  EXPECT_EQ(profile, nothing);
}

TEST(Profile, AnEndlessOneIsCutToo) {
  for (const auto& [position, duration_s] : {std::pair{12.5, 0.5}, {50.0, 1.0}, {1050.0, 11.0}}) {
    Profile profile;
    profile.append(1, 0, 100, 0);
    profile.append(kForEver, 100, 0, 0);
    profile.cut_at(position);
    EXPECT_FALSE(profile.endless());
    EXPECT_NEAR(profile.duration_s, duration_s, 1e-12) << position;
    EXPECT_EQ(profile.sample(1e9).position_u, position);
  }
}

TEST(Profile, TheMomentOfAPositionIsFoundToTheLastBit) {
  const Profile profile = trapezoid();
  for (const double position : {1e-30, 1e-9, 1.0, 12.5, 49.999, 50.0, 51.0, 100.0, 249.0, 260.0, 274.999}) {
    const double t_s = time_of(profile, position, 0, profile.duration_s);
    EXPECT_GE(profile.sample(t_s).position_u, position);
    EXPECT_LT(profile.sample(std::nextafter(t_s, 0)).position_u, position) << position;
  }
  EXPECT_EQ(time_of(profile, 0, 0, 3.5), 0);
  EXPECT_EQ(time_of(profile, -5, 1, 3), 1) << "already there";
  EXPECT_EQ(time_of(profile, 400, 0.5, 3), 3) << "not reached";
  EXPECT_NEAR(time_of(profile, 12.5, -1, 3), 0.5, 1e-15) << "from before the start";
}

TEST(Profile, TheMomentOfAPositionIsFoundOnAWayDownToo) {
  Profile back = Profile::from(100);
  back.append(10, -10, 0, 0);
  EXPECT_DOUBLE_EQ(time_of(back, 75, 0, 10), 2.5);
  EXPECT_EQ(time_of(back, 100, 0, 10), 0);
}

TEST(Profile, DurationsWithinRoundingOfATickEndOnThatTick) {
  struct Case {
    double duration_s;
    Tick end;
  };
  // Sums of decimal fractions must not cost a tick; anything beyond a nanosecond does.
  for (const auto& [duration_s, end] : std::vector<Case>{{3.05, 3050},
                                                         {0.05 + 2.95 + 0.05, 3050},
                                                         {0.1 + 0.2, 300},
                                                         {3.0500000000000003, 3050},
                                                         {3.0500005, 3051},
                                                         {3.0499995, 3050},
                                                         {0.0001, 1},
                                                         {1, 1000}}) {
    Profile profile;
    profile.append(duration_s, 10, 0, 0);
    profile.end_exactly_at(10 * duration_s);
    PulseDrive drive;
    drive.start(profile, +1, 0);
    EXPECT_FALSE(drive.over_at(end - 1)) << duration_s;
    EXPECT_TRUE(drive.over_at(end)) << duration_s;
  }
}

TEST(Profile, BisectionFindsNeighbouringDoublesIn64Steps) {
  for (const double place : {5e-324, 1e-300, 1e-9, 1.0, 0.1, 3e12, 1e300}) {
    int steps = 0;
    const Turnover found = turnover(0, 1.7e308, [&](double x) {
      ++steps;
      return x >= place;
    });
    EXPECT_EQ(found.after, place);
    EXPECT_EQ(found.before, std::nextafter(place, 0));
    EXPECT_LE(steps, 64) << place;
  }
  EXPECT_EQ(turnover(-0.0, 1, [](double) { return true; }).before, 0);
}

}  // namespace profile_test
}  // namespace understudy::motion
