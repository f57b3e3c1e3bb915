#include "motion/profile.h"

#include <gtest/gtest.h>

namespace understudy::motion {
namespace {

/// 1 s up to 100 pulses/s, 2 s there, 0.5 s down: 50 + 200 + 25 pulses.
Profile trapezoid() {
  Profile profile;
  profile.append(1, 0, 100, 0);
  profile.append(2, 100, 0, 0);
  profile.append(0.5, 100, -200, 0);
  profile.distance_pulses = 275;
  return profile;
}

TEST(Profile, ADefaultMadeProfileIsNoMove) {
  const Profile none;
  EXPECT_EQ(none.end_tick(), 0);
  EXPECT_EQ(none.pulses_at(0), 0);
  EXPECT_EQ(none.pulses_at(5), 0);
  EXPECT_EQ(none.sample(1).position_pulses, 0);
  EXPECT_EQ(none.sample(1).speed_pps, 0);
}

TEST(Profile, EachSegmentBeginsWhereTheLastOneEnded) {
  const Profile profile = trapezoid();
  ASSERT_EQ(profile.segment_count, 3);
  EXPECT_DOUBLE_EQ(profile.segments[0].position_pulses, 0);
  EXPECT_DOUBLE_EQ(profile.segments[1].position_pulses, 50);
  EXPECT_DOUBLE_EQ(profile.segments[2].position_pulses, 250);
  EXPECT_DOUBLE_EQ(profile.duration_s, 3.5);
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
  for (const auto& [t, position, speed, acceleration] : cases) {
    const Sample sample = profile.sample(t);
    EXPECT_NEAR(sample.position_pulses, position, 1e-12) << t;
    EXPECT_NEAR(sample.speed_pps, speed, 1e-12) << t;
    EXPECT_NEAR(sample.acceleration_pps2, acceleration, 1e-12) << t;
  }
}

TEST(Profile, JerkIsTheThirdDerivative) {
  Profile profile;
  profile.append(2, 0, 0, 6);  // s = t^3, v = 3 t^2, a = 6 t
  profile.append(2, 12, 12, -6);
  profile.distance_pulses = 48;
  EXPECT_NEAR(profile.sample(0.5).position_pulses, 0.125, 1e-15);
  EXPECT_NEAR(profile.sample(0.5).speed_pps, 0.75, 1e-15);
  EXPECT_NEAR(profile.sample(0.5).acceleration_pps2, 3, 1e-15);
  // 8 + 12 + 6 - 1
  EXPECT_NEAR(profile.sample(3).position_pulses, 25, 1e-12);
  EXPECT_NEAR(profile.sample(3).speed_pps, 21, 1e-12);
}

TEST(Profile, BeforeItIsTheBeginningAndAfterItTheEnd) {
  const Profile profile = trapezoid();
  EXPECT_EQ(profile.sample(-1).position_pulses, 0);
  EXPECT_EQ(profile.sample(3.5).position_pulses, 275);
  EXPECT_EQ(profile.sample(3.5).speed_pps, 0);
  EXPECT_EQ(profile.sample(1e9).position_pulses, 275);
  EXPECT_EQ(profile.pulses_at(-1), 0);
  EXPECT_EQ(profile.pulses_at(0), 0);
  EXPECT_EQ(profile.pulses_at(3499), 274);
  EXPECT_EQ(profile.pulses_at(3500), 275);
  EXPECT_EQ(profile.pulses_at(INT64_MAX), 275);
}

TEST(Profile, EndsInTheFirstTickThatIsNotEarlier) {
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
    profile.distance_pulses = 1;
    EXPECT_EQ(profile.end_tick(), end) << duration_s;
    EXPECT_EQ(profile.pulses_at(end), 1) << duration_s;
  }
}

TEST(Profile, NeverSendsMoreThanItsDistance) {
  Profile profile;
  profile.append(1, 1000, 0, 0);  // the segments go farther than the move
  profile.distance_pulses = 10;
  EXPECT_EQ(profile.pulses_at(5), 5);
  EXPECT_EQ(profile.pulses_at(500), 10);
}

}  // namespace
}  // namespace understudy::motion
