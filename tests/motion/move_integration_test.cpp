// Ten thousand moves of each family, integrated again from their jerk, and compared with an oracle that finds
// the peak by bisection (move_oracle.h). A failure prints the move as code; UNDERSTUDY_MOVES tries more.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/motion/move_checks.h"
#include "tests/motion/random_laws.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace move_integration_test {

Fault differs_from_oracle(const Profile& profile, double distance, const SpeedLaw& law) {
  const oracle::Expected expected = oracle::move_of(distance, law);
  Long tolerance_s = kLimitTolerance * expected.duration_s;
  Long tolerance_u_s = kLimitTolerance * expected.peak;
  if (law.start_speed_u_s > 0) {
    // The point at which a move is cut off, or starts to creep, is as exact as the position: to a billionth
    // or some rounding errors.
    const Long place_s = (1e-9L + 1e-13L * distance) / law.start_speed_u_s;
    const Long dv = expected.peak - oracle::start_of(law);
    tolerance_s += place_s;
    tolerance_u_s +=
        place_s * std::max(limits_of(law.up, dv).acceleration, limits_of(law.down, dv).acceleration);
  }
  if (std::abs(profile.duration_s - expected.duration_s) > tolerance_s) {
    return "takes " + text(profile.duration_s) + " s, not " + text(expected.duration_s);
  }
  const Long peak = greatest_speed(profile);
  if (std::abs(peak - expected.peak) > tolerance_u_s) {
    return "peak is " + text(peak) + ", not " + text(expected.peak);
  }
  if (std::abs(profile.end_speed_u_s - expected.end_speed) > tolerance_u_s) {
    return "ends with speed " + text(profile.end_speed_u_s) + ", not " + text(expected.end_speed);
  }
  return {};
}

double ramps_u(const SpeedLaw& law) {
  const Long start = oracle::start_of(law);
  return static_cast<double>(oracle::ramp_distance(law.up, start, law.top_speed_u_s) +
                             oracle::ramp_distance(law.down, start, law.top_speed_u_s));
}

template <class Next>
void every_move_is_the_integral_of_its_jerk(const Next& next, std::uint64_t salt, bool chip_rules = false) {
  const std::uint64_t from = seed() + salt;
  std::cout << "seed " << from << "\n";
  RandomLaws random(from);
  // The chips' rules have no other test in closed form: a million of each family, over its five kinds of
  // ramps.
  const int moves = random_cases(chip_rules ? 200'000 : 10'000);
  for (int i = 0; i < moves; ++i) {
    const SpeedLaw law = next(random);
    const double distance = random.distance(ramps_u(law));
    // By the chips' rules a remaining distance counts from a billionth on.
    if (distance == 0 || (chip_rules && (distance < 1e-3 || distance > 3e9))) continue;
    const Long scale_u = distance + (chip_rules ? 10 : 0);
    Fault fault;
    try {
      const Profile profile = plan(distance, law);
      fault = off_target(profile, distance);
      if (!fault) fault = gap_in(profile, scale_u);
      if (!fault) fault = beyond_limits(profile, law, !chip_rules);
      if (!fault) fault = differs_from_oracle(profile, distance, law);
      if (!fault) fault = differs_from_integral(profile, distance, scale_u);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    ASSERT_FALSE(fault) << "seed " << from << ": " << code(law) << " plan(" << code(distance) << ", law); // "
                        << *fault;
  }
}

/// Speeds and laws of the sizes that controllers use: creeping at 1e-12 u/s is not a move.
SpeedLaw usual_speeds(RandomLaws& random) {
  SpeedLaw law{.top_speed_u_s = random.usual_number()};
  law.start_speed_u_s = random.start_speed(law.top_speed_u_s);
  return law;
}
double from_start(const SpeedLaw& law) { return law.top_speed_u_s - law.start_speed_u_s; }

void set_ramps(SpeedLaw& law, int kind, RandomLaws& random) {
  const double dv = from_start(law);
  for (RampLaw* ramp : {&law.up, &law.down}) {
    switch (kind) {
      case 0: *ramp = random.slope(false); break;
      case 1: *ramp = random.time(); break;
      case 2: *ramp = random.jerk(dv, false); break;
      case 3: *ramp = random.sections(dv, false); break;
      default: *ramp = random.any_ramp(dv, false);
    }
  }
  if (random.below(4) == 0) law.down = law.up;
}

class MoveIntegration : public testing::TestWithParam<int> {};

constexpr std::array<const char*, 5> kFamilies{"Slopes", "Times", "Jerk", "Sections", "MixedLaws"};

INSTANTIATE_TEST_SUITE_P(Of, MoveIntegration, testing::Range(0, 5), [](const auto& family) {
  return kFamilies[static_cast<std::size_t>(family.param)];
});

TEST_P(MoveIntegration, LoweredTop) {
  every_move_is_the_integral_of_its_jerk(
      [](RandomLaws& random) {
        SpeedLaw law = usual_speeds(random);
        set_ramps(law, GetParam(), random);
        return law;
      },
      20);
}

TEST_P(MoveIntegration, HalfKept) {
  every_move_is_the_integral_of_its_jerk(
      [](RandomLaws& random) {
        SpeedLaw law = usual_speeds(random);
        law.when_short = Short::keep_half;
        set_ramps(law, GetParam(), random);
        return law;
      },
      21);
}

TEST_P(MoveIntegration, RampBrokenOff) {
  every_move_is_the_integral_of_its_jerk(
      [](RandomLaws& random) {
        SpeedLaw law = usual_speeds(random);
        law.when_short = Short::cut_ramp;
        set_ramps(law, GetParam(), random);
        return law;
      },
      22, true);
}

TEST_P(MoveIntegration, SlowedDownEarlyOrLate) {
  every_move_is_the_integral_of_its_jerk(
      [](RandomLaws& random) {
        SpeedLaw law = usual_speeds(random);
        if (law.start_speed_u_s == 0) law.start_speed_u_s = law.top_speed_u_s * random.between(0.01, 0.5);
        set_ramps(law, GetParam(), random);
        const double down_u =
            static_cast<double>(oracle::ramp_distance(law.down, oracle::start_of(law), law.top_speed_u_s));
        law.when_short = static_cast<Short>(random.below(3));
        if (random.below(3) == 0) law.slow_down_reckoned_by = random.any_ramp(from_start(law), false);
        if (random.below(3) == 0)
          law.slow_down_at_u = random.below(4) == 0 ? 0 : down_u * random.between(0, 2);
        switch (random.below(4)) {
          case 0: law.slow_down_offset_u = 8; break;
          case 1: law.slow_down_offset_u = -8; break;
          case 2: law.slow_down_offset_u = down_u * random.between(-0.5, 0.5); break;
          default: break;
        }
        return law;
      },
      23, true);
}

}  // namespace move_integration_test
}  // namespace understudy::motion
