#include "motion/pulse_drive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/motion/random_laws.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace pulse_drive_test {

constexpr RegisterMove kManualExample{32'000, 200, 3200, 5, 5};

std::int64_t run(PulseDrive& drive, Tick first, Tick last) {
  std::int64_t sent = 0;
  for (Tick t = first; t <= last; ++t) sent += drive.step(t);
  return sent;
}

/// A constant speed without end, from `position_u`.
Profile cruise(double position_u, double speed_u_s) {
  Profile profile = Profile::from(position_u);
  profile.append(INFINITY, speed_u_s, 0, 0);
  return profile;
}

/// From standstill at a constant acceleration, for a second.
Profile rise(double acceleration_u_s2) {
  Profile profile;
  profile.append(1, 0, acceleration_u_s2, 0);
  return profile;
}

TEST(PulseDrive, AtRestSendsNothingAndAsksForNothing) {
  PulseDrive drive;
  EXPECT_FALSE(drive.moving());
  EXPECT_EQ(drive.step(1), 0);
  EXPECT_EQ(drive.next_active_tick(1), kNoTick);
}

TEST(PulseDrive, StartsInItsFirstTickAndReachesTheEndInTheLast) {
  PulseDrive drive;
  drive.start(kManualExample.plan(), +1, 100);
  EXPECT_TRUE(drive.moving());
  EXPECT_EQ(drive.step(100), 0);
  EXPECT_EQ(run(drive, 101, 200), 800);  // s(100 ms)
  EXPECT_EQ(run(drive, 201, 3149), 31'999 - 800);
  EXPECT_TRUE(drive.moving());
  EXPECT_EQ(drive.step(3150), 1);
  EXPECT_FALSE(drive.moving());
  EXPECT_EQ(run(drive, 3151, 3300), 0);
}

TEST(PulseDrive, ANegativeMoveIsTheMirrorImage) {
  PulseDrive up;
  PulseDrive down;
  up.start(kManualExample.plan(), +1, 1);
  down.start(kManualExample.plan(), -1, 1);
  for (Tick t = 1; t <= 3051; ++t) {
    ASSERT_EQ(up.step(t), -down.step(t)) << t;
    ASSERT_EQ(up.moving(), down.moving()) << t;
  }
  EXPECT_FALSE(down.moving());
}

TEST(PulseDrive, SkippedTicksSendTheirPulsesTogether) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(300); ++i) {
    const RegisterMove move = random.next(5000);
    PulseDrive each;
    PulseDrive some;
    const Tick first = random.between(0, 1'000'000'000);
    each.start(move.plan(), -1, first);
    some.start(move.plan(), -1, first);
    std::int64_t sent_each = 0;
    std::int64_t sent_some = 0;
    Tick t = first;
    while (each.moving() || some.moving()) {
      const Tick next = t + random.between(1, 200);
      for (; t < next; ++t) sent_each += each.step(t);
      sent_some += some.step(t - 1);
      ASSERT_EQ(sent_some, sent_each) << "seed " << seed() << ": " << move.code() << " tick " << t;
      ASSERT_EQ(some, each) << "seed " << seed() << ": " << move.code() << " tick " << t;
    }
    ASSERT_EQ(sent_each, -move.distance_pulses) << "seed " << seed() << ": " << move.code();
  }
}

TEST(PulseDrive, TicksThatItDoesNotAskForSendNothing) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(100); ++i) {
    const RegisterMove move = random.next(3000);
    PulseDrive each;
    each.start(move.plan(), +1, 50);
    for (Tick t = 1; t < 100'000 && each.moving(); ++t) {
      const Tick next = each.next_active_tick(t - 1);
      ASSERT_GE(next, t) << move.code();
      const std::int64_t sent = each.step(t);
      if (next > t) {
        ASSERT_EQ(sent, 0) << "seed " << seed() << ": " << move.code() << " tick " << t;
        ASSERT_TRUE(each.moving()) << "seed " << seed() << ": " << move.code() << " tick " << t;
      }
    }
    ASSERT_FALSE(each.moving()) << "seed " << seed() << ": " << move.code();
    ASSERT_EQ(each.next_active_tick(100'000), kNoTick);
  }
}

TEST(PulseDrive, AHangingMoveSendsNothingAndLastsUntilItIsStopped) {
  PulseDrive drive;
  drive.move_at_zero_speed(-1);
  EXPECT_TRUE(drive.moving());
  EXPECT_EQ(drive.direction, -1);
  EXPECT_EQ(run(drive, 1, 100'000), 0);
  EXPECT_TRUE(drive.moving());
  EXPECT_EQ(drive.next_active_tick(5), kNoTick);
  drive.stop();
  EXPECT_FALSE(drive.moving());
}

TEST(PulseDrive, AfterStopThereIsNoPulse) {
  PulseDrive drive;
  drive.start(kManualExample.plan(), +1, 0);
  EXPECT_EQ(run(drive, 0, 1525), 16'000);
  drive.stop();
  EXPECT_FALSE(drive.moving());
  EXPECT_EQ(run(drive, 1526, 4000), 0);
}

TEST(PulseDrive, ANewMoveBeginsFromStandstill) {
  PulseDrive drive;
  drive.start(kManualExample.plan(), +1, 0);
  run(drive, 0, 1525);
  drive.start(kManualExample.plan(), -1, 1526);
  EXPECT_EQ(drive.step(1526), 0);
  EXPECT_EQ(run(drive, 1527, 1526 + 100), -800);
  EXPECT_EQ(run(drive, 1627, 1526 + 3050), -31'200);
  EXPECT_FALSE(drive.moving());
}

TEST(PulseDrive, AMoveOfNoDistanceEndsTheOneThatRuns) {
  PulseDrive drive;
  drive.start(kManualExample.plan(), +1, 0);
  run(drive, 0, 1000);
  drive.start(Profile{}, +1, 1001);
  EXPECT_FALSE(drive.moving());
  EXPECT_EQ(run(drive, 1001, 4000), 0);
  drive.move_at_zero_speed(+1);
  drive.start(Profile{}, +1, 4001);
  EXPECT_FALSE(drive.moving());
}

TEST(PulseDrive, ANewMoveEndsAHangingOneAndTheOtherWayRound) {
  PulseDrive drive;
  drive.move_at_zero_speed(+1);
  drive.start(kManualExample.plan(), +1, 10);
  EXPECT_EQ(run(drive, 10, 110), 800);
  drive.move_at_zero_speed(+1);
  EXPECT_TRUE(drive.moving());
  EXPECT_EQ(run(drive, 111, 4000), 0);
}

TEST(PulseDrive, OnceAtRestNothingOfTheMoveIsLeft) {
  PulseDrive drive;
  drive.start(kManualExample.plan(), +1, 0);
  run(drive, 0, 3050);
  PulseDrive stopped;
  stopped.start(kManualExample.plan(), +1, 0);
  run(stopped, 0, 70);
  stopped.stop();
  EXPECT_EQ(drive, stopped);
}

TEST(PulseDrive, SendsAtEachTickTheWholePulsesOfItsProfile) {
  RandomLaws laws(seed());
  for (int i = 0; i < random_cases(300); ++i) {
    const double top = laws.usual_number();
    const SpeedLaw law{.start_speed_u_s = laws.start_speed(top),
                       .top_speed_u_s = top,
                       .up = laws.any_ramp(top, false),
                       .down = laws.any_ramp(top, false)};
    const auto pulses = static_cast<std::int64_t>(laws.of_any_size(1, 1e6));
    const Profile profile = plan(static_cast<double>(pulses), law);
    const double after_s = laws.below(2) == 0 ? 0 : laws.between(0, 0.000'999);
    const auto report = [&](Tick t) {
      return "seed " + std::to_string(seed()) + ": " + code(law) + " over " + std::to_string(pulses) +
             " after " + code(after_s) + " tick " + std::to_string(t);
    };
    PulseDrive drive;
    drive.start(profile, +1, Instant{.tick = 7, .after_s = after_s});
    std::int64_t sent = 0;
    // Rounding errors of time and position: more if it is fast, far or late.
    const auto last = static_cast<Tick>(std::min(profile.duration_s, 20.0) * kTicksPerSecond);
    for (Tick t = 8; t <= 7 + last; ++t) {
      const std::int64_t now = drive.step(t);
      ASSERT_GE(now, 0) << report(t);
      sent += now;
      const double t_s = static_cast<double>(t - 7) / kTicksPerSecond - after_s;
      const double place = profile.sample(t_s).position_u;
      const double slack = 1e-9 + 1e-9 * place + 2e-9 * profile.sample(t_s).speed_u_s;
      ASSERT_GE(static_cast<double>(sent), std::floor(place - slack)) << report(t);
      ASSERT_LE(static_cast<double>(sent), place + slack) << report(t);
    }
  }
}

TEST(PulseDrive, EndsOnItsDistanceWhereverInATickItBegan) {
  RandomLaws laws(seed());
  for (int i = 0; i < random_cases(300); ++i) {
    const SpeedLaw law{.top_speed_u_s = 1e5, .up = laws.any_ramp(1e5, false), .down = laws.slope(false)};
    const auto pulses = static_cast<std::int64_t>(laws.of_any_size(1, 1e4));
    PulseDrive drive;
    drive.start(plan(static_cast<double>(pulses), law), -1, {.tick = 0, .after_s = laws.between(0, 0.001)});
    std::int64_t sent = 0;
    Tick t = 1;
    for (; t < 1'000'000 && drive.moving(); ++t) sent += drive.step(t);
    ASSERT_EQ(sent, -pulses) << "seed " << seed() << ": " << code(law);
  }
}

TEST(PulseDrive, BeginningWithinATickItIsThatMuchLater) {
  PulseDrive drive;
  drive.start(cruise(0, 1'000'000), +1, Instant{.tick = 10, .after_s = 0.000'250});
  EXPECT_EQ(drive.step(11), 750);
  EXPECT_EQ(drive.step(12), 1000);
  EXPECT_EQ(drive.beginning(), (Instant{.tick = 10, .after_s = 0.000'250}));
}

TEST(PulseDrive, AnotherProfileNeitherLosesNorRepeatsAPulse) {
  RandomLaws laws(seed());
  for (int i = 0; i < random_cases(300); ++i) {
    const double speed = laws.of_any_size(1, 4e6);
    PulseDrive plain;
    PulseDrive changed;
    plain.start(cruise(0, speed), +1, 0);
    changed.start(cruise(0, speed), +1, 0);
    std::int64_t sent = 0;
    std::int64_t sent_plain = 0;
    for (Tick t = 0; t < 200; ++t) {
      const std::int64_t now = changed.step(t);
      ASSERT_GE(now, 0) << "seed " << seed() << ": " << code(speed) << " tick " << t;
      sent += now;
      sent_plain += plain.step(t);
      ASSERT_LE(std::abs(sent - sent_plain), 1) << "seed " << seed() << ": " << code(speed) << " tick " << t;
      if (laws.below(3) == 0) {
        const Instant at{.tick = t, .after_s = laws.below(2) == 0 ? 0 : laws.between(0, 0.000'999)};
        changed.continue_with(cruise(changed.sample(at).position_u, speed), at);
      }
    }
    ASSERT_EQ(sent, changed.sent_pulses);
  }
}

TEST(PulseDrive, ReportsTheTimeOfAPulseToAPicosecond) {
  for (const double acceleration : {1e4, 1e5, 3.7e6}) {
    for (const double after_s : {0.0, 0.000'123'456}) {
      PulseDrive drive;
      drive.start(rise(acceleration), +1, Instant{.tick = 5, .after_s = after_s});
      for (Tick t = 6; t < 400; ++t) {
        const std::int64_t before = drive.sent_pulses;
        drive.step(t);
        const std::int64_t pulse = before + (drive.sent_pulses - before + 1) / 2;
        if (pulse == before) continue;
        const Instant at = drive.time_of_pulse(pulse, {.tick = t - 1}, {.tick = t});
        const long double exact_s =
            std::sqrt(2.0L * static_cast<long double>(pulse) / acceleration) + after_s;
        const long double is_s = static_cast<long double>(at.tick - 5) / 1000 + at.after_s;
        ASSERT_NEAR(static_cast<double>(is_s - exact_s), 0, 1e-12) << acceleration << ": pulse " << pulse;
        ASSERT_GE(drive.pulses_at_moment(at), pulse);
        ASSERT_GE(at.after_s, 0);
        ASSERT_LT(at.after_s, 0.001);
      }
    }
  }
}

TEST(PulseDrive, TheTimeOfAPulseOfAConstantSpeedIsItsShareOfTheTick) {
  PulseDrive drive;
  drive.start(cruise(0, 4'000'000), +1, 0);
  drive.step(0);
  for (std::int64_t pulse = 1; pulse <= 4000; ++pulse) {
    const Instant at = drive.time_of_pulse(pulse, {.tick = 0}, {.tick = 1});
    const double exact_s = static_cast<double>(pulse) / 4e6;
    ASSERT_NEAR(static_cast<double>(at.tick) / 1000 + at.after_s, exact_s, 1e-12) << pulse;
  }
}

TEST(PulseDrive, SamplesAreOfTheMomentAndAtRestOfThePlace) {
  PulseDrive drive;
  drive.start(rise(2000), +1, 0);
  run(drive, 0, 100);
  const Sample now = drive.sample({.tick = 100});
  EXPECT_NEAR(now.position_u, 10, 1e-9);
  EXPECT_NEAR(now.speed_u_s, 200, 1e-9);
  EXPECT_NEAR(now.acceleration_u_s2, 2000, 1e-9);
  const Sample later = drive.sample({.tick = 100, .after_s = 0.000'5});
  EXPECT_NEAR(later.speed_u_s, 201, 1e-9);
  drive.stop();
  EXPECT_EQ(drive.sample({.tick = 100}).speed_u_s, 0);
}

TEST(PulseDrive, AnUncountableSpeedStaysAtTheGreatestNumber) {
  PulseDrive drive;
  drive.start(cruise(0, 1e300), +1, 0);
  EXPECT_EQ(drive.pulses_at(1), 9'000'000'000'000'000'000);
  EXPECT_EQ(drive.pulses_at(1'000'000), 9'000'000'000'000'000'000);
}

}  // namespace pulse_drive_test
}  // namespace understudy::motion
