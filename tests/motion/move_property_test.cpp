// A million moves of each family compared with an independent implementation of the laws (move_oracle.h), in
// closed form. A failure prints the move as code. Under sanitizers it tries a tenth of them.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/motion/move_checks.h"
#include "tests/motion/random_laws.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace move_property_test {

constexpr Long kDurationTolerance = 1e-9L;  // relative

/// The sum of the two ramps to `peak`.
Long ramps_u(const SpeedLaw& law, Long peak) {
  const Long start = oracle::start_of(law);
  return oracle::ramp_distance(law.up, start, peak) + oracle::ramp_distance(law.down, start, peak);
}

/// The only correct peak: both ramps fit, and a higher one would not. Ramps only grow with their peak, so
/// this decides it without solving anything.
Fault wrong_peak(const Profile& profile, double distance, const SpeedLaw& law) {
  const Long start = oracle::start_of(law);
  const Long peak = greatest_speed(profile);
  const Long room = law.when_short == Short::keep_half ? distance / 2.0L : distance;
  // A peak is a double: it may be off by some rounding errors.
  const Long lower = start + std::max<Long>(0, (peak - start) * (1 - 1e-12L) - 1e-15L * peak);
  const Long higher = start + (peak - start) * (1 + 1e-12L) + 1e-15L * peak;
  if (lower > start && ramps_u(law, lower) > room) return "peak " + text(peak) + " is too high";
  if (peak < law.top_speed_u_s && ramps_u(law, higher) < room) return "peak " + text(peak) + " is too low";
  const Long duration_s = oracle::shape_of(law.up, peak - start).duration_s() +
                          oracle::shape_of(law.down, peak - start).duration_s() +
                          (distance - ramps_u(law, peak)) / peak;
  // If no ramp fits except one of a rounding error, the sum above counts it in full: no ramp is correct, too.
  const bool no_ramp =
      std::abs(profile.duration_s - distance / peak) <= kDurationTolerance * profile.duration_s;
  if (std::abs(profile.duration_s - duration_s) > kDurationTolerance * duration_s && !no_ramp) {
    return "takes " + text(profile.duration_s) + " s, not " + text(duration_s);
  }
  return {};
}

template <class Next>
void every_move_keeps_its_law(const Next& next, std::uint64_t salt) {
  const std::uint64_t from = seed() + salt;
  std::cout << "seed " << from << "\n";
  RandomLaws random(from);
  int reached = 0;
  int moves = random_cases(1'000'000);
  for (int i = 0; i < moves; ++i) {
    const SpeedLaw law = next(random);
    const double distance = random.distance(static_cast<double>(ramps_u(law, law.top_speed_u_s)));
    Fault fault;
    try {
      const Profile profile = plan(distance, law);
      if (distance == 0) {
        if (profile != Profile{}) fault = "distance 0 is a move";
        continue;
      }
      reached += greatest_speed(profile) >= law.top_speed_u_s ? 1 : 0;
      fault = off_target(profile, distance);
      if (!fault) fault = gap_in(profile, distance);
      if (!fault) fault = beyond_limits(profile, law, true);
      if (!fault) fault = wrong_peak(profile, distance, law);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    ASSERT_FALSE(fault) << "seed " << from << ": " << code(law) << " plan(" << code(distance) << ", law); // "
                        << *fault;
  }
  // The mix is as intended: triangles and trapezoids.
  EXPECT_GT(reached, moves / 5);
  EXPECT_LT(reached, moves * 4 / 5);
}

double from_start(const SpeedLaw& law) { return law.top_speed_u_s - law.start_speed_u_s; }

SpeedLaw with_speeds(RandomLaws& random) {
  SpeedLaw law{.top_speed_u_s = random.number()};
  law.start_speed_u_s = random.start_speed(law.top_speed_u_s);
  return law;
}

TEST(MoveProperty, AMillionTrapezoidsBySlopes) {
  every_move_keeps_its_law(
      [](RandomLaws& random) {
        SpeedLaw law = with_speeds(random);
        law.up = random.slope();
        law.down = random.below(4) == 0 ? law.up : random.slope();
        return law;
      },
      10);
}

TEST(MoveProperty, AMillionTrapezoidsByTimes) {
  every_move_keeps_its_law(
      [](RandomLaws& random) {
        SpeedLaw law = with_speeds(random);
        law.up = random.time();
        law.down = random.below(4) == 0 ? law.up : random.time();
        return law;
      },
      11);
}

TEST(MoveProperty, AMillionSCurvesByJerk) {
  every_move_keeps_its_law(
      [](RandomLaws& random) {
        SpeedLaw law = with_speeds(random);
        law.up = random.jerk(from_start(law));
        law.down = random.below(4) == 0 ? law.up : random.jerk(from_start(law));
        return law;
      },
      12);
}

TEST(MoveProperty, AMillionSCurvesBySections) {
  every_move_keeps_its_law(
      [](RandomLaws& random) {
        SpeedLaw law = with_speeds(random);
        law.up = random.sections(from_start(law));
        law.down = random.below(4) == 0 ? law.up : random.sections(from_start(law));
        return law;
      },
      13);
}

TEST(MoveProperty, AMillionMovesWithDifferentRampLaws) {
  every_move_keeps_its_law(
      [](RandomLaws& random) {
        SpeedLaw law = with_speeds(random);
        law.up = random.any_ramp(from_start(law));
        law.down = random.any_ramp(from_start(law));
        return law;
      },
      14);
}

TEST(MoveProperty, AMillionMovesThatKeepHalf) {
  every_move_keeps_its_law(
      [](RandomLaws& random) {
        SpeedLaw law = with_speeds(random);
        law.when_short = Short::keep_half;
        law.up = random.any_ramp(from_start(law));
        law.down = random.below(2) == 0 ? law.up : random.any_ramp(from_start(law));
        return law;
      },
      15);
}

}  // namespace move_property_test
}  // namespace understudy::motion
