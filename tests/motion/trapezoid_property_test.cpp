// Random moves compared with exact arithmetic. A failure prints the move as code.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace trapezoid_property_test {

constexpr std::int64_t kLongestMs = 1'000'000'000;  // eleven days

/// How early a pulse can be sent: a few rounding errors of doubles as large as the distance.
int pulse_slack_billionths(std::int64_t distance_pulses) {
  return 1 + static_cast<int>(distance_pulses / 200'000);
}

testing::AssertionResult bad(const RegisterMove& move, const std::string& what) {
  return testing::AssertionFailure() << "seed " << seed() << ": " << move.code() << "  // " << what;
}

testing::AssertionResult ends_when_and_where_it_must(const RegisterMove& move, const Profile& profile) {
  const Ratio total = move.total_ms();
  const Tick end = end_tick(profile);
  // Later than that by 1 ns at most counts as on the tick.
  const bool on_time = end == total.ceil() || end == total.plus_millionths(-1).ceil();
  if (!on_time) return bad(move, "ends at tick " + std::to_string(end));
  for (const Tick t : {end, end + 1, end + 1'000'000}) {
    if (pulses_at(profile, t) != move.distance_pulses)
      return bad(move, "is off target at " + std::to_string(t));
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult is_where_it_must_be(const RegisterMove& move, const Profile& profile, Tick t) {
  const std::int64_t pulses = pulses_at(profile, t);
  const Ratio exact = t >= move.total_ms().ceil() ? Ratio{move.distance_pulses, 1} : move.position(t);
  const std::int64_t min = exact.floor();
  const std::int64_t max = std::min(
      exact.plus_billionths(pulse_slack_billionths(move.distance_pulses)).floor(), move.distance_pulses);
  if (pulses < min || pulses > max) {
    return bad(move, "pulses_at(" + std::to_string(t) + ") is " + std::to_string(pulses) + ", not " +
                         std::to_string(min));
  }
  if (pulses_at(profile, t + 1) < pulses) return bad(move, "goes back after tick " + std::to_string(t));
  const double speed = profile.sample(static_cast<double>(t) / 1000.0).speed_u_s;
  const double limit = move.limit_pps() * (1 + 1e-12);
  if (speed > limit || speed < -1e-9 * limit) return bad(move, "speed at " + std::to_string(t) + " ms");
  return testing::AssertionSuccess();
}

TEST(TrapezoidProperty, EveryMoveMatchesExactArithmeticAndEndsOnItsTick) {
  RecordProperty("seed", std::to_string(seed()));
  std::cout << "seed " << seed() << "\n";
  const int moves = random_cases(250'000);
  RandomMoves random(seed());
  int triangles = 0;
  for (int i = 0; i < moves; ++i) {
    const RegisterMove move = random.next(kLongestMs);
    const Profile profile = move.plan();
    triangles += move.reaches_limit() ? 0 : 1;
    ASSERT_TRUE(ends_when_and_where_it_must(move, profile));
    const Tick end = end_tick(profile);
    const Tick a = move.acceleration_ms();
    const Tick d = move.deceleration_ms();
    for (const Tick t : {Tick{0}, Tick{1}, a - 1, a, a + 1, end - d - 1, end - d, end - d + 1, end - 1,
                         random.between(0, end), random.between(0, end), random.between(0, a),
                         std::max<Tick>(0, end - random.between(0, d))}) {
      ASSERT_TRUE(is_where_it_must_be(move, profile, std::clamp<Tick>(t, 0, end)));
    }
  }
  // The mix is as intended.
  EXPECT_GT(triangles, moves / 10);
  EXPECT_LT(triangles, moves * 9 / 10);
}

TEST(TrapezoidProperty, ShortMovesNeverReverseNorExceedTheLimitPerTick) {
  RandomMoves random(seed() + 1);
  for (int i = 0; i < 400; ++i) {
    const RegisterMove move = random.next(20'000);
    const Profile profile = move.plan();
    const std::int64_t max_per_tick = move.limit().ceil() + 1;  // a partial pulse before, one after
    std::int64_t before = 0;
    for (Tick t = 1; t <= end_tick(profile); ++t) {
      const std::int64_t pulses = pulses_at(profile, t);
      ASSERT_GE(pulses, before) << "seed " << seed() + 1 << ": " << move.code() << " tick " << t;
      ASSERT_LE(pulses - before, max_per_tick)
          << "seed " << seed() + 1 << ": " << move.code() << " tick " << t;
      before = pulses;
    }
    ASSERT_EQ(before, move.distance_pulses) << "seed " << seed() + 1 << ": " << move.code();
  }
}

TEST(TrapezoidProperty, SpeedIntegratesToPositionAndAccelerationToSpeed) {
  RandomMoves random(seed() + 2);
  for (int i = 0; i < 500; ++i) {
    const RegisterMove move = random.next(10'000'000);
    const Profile profile = move.plan();
    const double a = static_cast<double>(move.acceleration_ms()) / 1000.0;
    const double d = static_cast<double>(move.deceleration_ms()) / 1000.0;
    const double total = move.total_ms().value() / 1000.0;
    const double distance = static_cast<double>(move.distance_pulses);
    const double top = move.top().value() * 1000.0;
    double position = 0;
    double speed = 0;
    double from = 0;
    for (const double to : {a, std::max(a, total - d), total}) {
      constexpr int kSteps = 64;  // midpoint rule, exact for what is linear in time
      const double step = (to - from) / kSteps;
      for (int n = 0; n < kSteps && step > 0; ++n) {
        const Sample middle = profile.sample(from + (n + 0.5) * step);
        ASSERT_NEAR(middle.position_u,
                    position + speed * step / 2 + middle.acceleration_u_s2 * step * step / 8,
                    1e-9 * distance + 1e-9)
            << "seed " << seed() + 2 << ": " << move.code() << " at " << from + (n + 0.5) * step << " s";
        position += middle.speed_u_s * step;
        speed += middle.acceleration_u_s2 * step;
      }
      from = to;
    }
    ASSERT_NEAR(position, distance, 1e-9 * distance) << "seed " << seed() + 2 << ": " << move.code();
    ASSERT_NEAR(speed, 0, 1e-9 * top) << "seed " << seed() + 2 << ": " << move.code();
  }
}

}  // namespace trapezoid_property_test
}  // namespace understudy::motion
