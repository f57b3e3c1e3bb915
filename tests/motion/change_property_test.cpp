// Changes during motion, from random moments of random moves of every family. A failure prints the law and
// the state as code. Under sanitizers it tries a tenth of them.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/motion/move_checks.h"
#include "tests/motion/random_laws.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace change_property_test {

enum Family { kSlopes, kTimes, kJerk, kSections, kMixed };
constexpr std::array<const char*, 5> kFamilies{"Slopes", "Times", "Jerk", "Sections", "MixedLaws"};

double from_start(const SpeedLaw& law) { return std::max(0.0, law.top_speed_u_s - law.start_speed_u_s); }

SpeedLaw random_law(RandomLaws& random, int family) {
  SpeedLaw law{.top_speed_u_s = random.usual_number()};
  law.start_speed_u_s = random.below(2) == 0 ? 0 : law.top_speed_u_s * random.between(0, 0.5);
  const double dv = from_start(law);
  for (RampLaw* ramp : {&law.up, &law.down}) {
    switch (family) {
      case kSlopes: *ramp = random.slope(false); break;
      case kTimes: *ramp = random.time(); break;
      case kJerk: *ramp = random.jerk(dv, false); break;
      case kSections: *ramp = random.sections(dv, false); break;
      default: *ramp = random.any_ramp(dv, false);
    }
  }
  if (random.below(3) == 0) law.down = law.up;
  return law;
}

/// A moment during a move.
struct OnTheWay {
  SpeedLaw law;
  double distance = 0;
  Profile profile;
  double t_s = 0;
  Sample now;

  std::string words() const {
    return code(law) + " " + code(now) + " // at " + code(t_s) + " s of plan(" + code(distance) + ", law)";
  }
};

OnTheWay random_moment(RandomLaws& random, int family) {
  OnTheWay moment;
  do {
    moment.law = random_law(random, family);
    const double start = std::min(moment.law.start_speed_u_s, moment.law.top_speed_u_s);
    const double ramps = ramp_distance(moment.law.up, start, moment.law.top_speed_u_s) +
                         ramp_distance(moment.law.down, start, moment.law.top_speed_u_s);
    moment.distance = std::max(1.0, std::floor(ramps * random.of_any_size(0.01, 10)));
    moment.profile = plan(moment.distance, moment.law);
  } while (moment.profile.duration_s > 1000);
  const double end_s = moment.profile.duration_s;
  const auto any =
      static_cast<std::size_t>(random.below(static_cast<std::uint64_t>(moment.profile.segment_count)));
  switch (random.below(6)) {
    case 0: moment.t_s = moment.profile.segments[any].begin_s; break;
    case 1: moment.t_s = end_s * random.of_any_size(1e-9, 1); break;
    case 2: moment.t_s = end_s * (1 - random.of_any_size(1e-9, 1)); break;
    default: moment.t_s = end_s * random.between(0, 1);
  }
  moment.t_s = std::min(moment.t_s, std::nextafter(end_s, 0));
  moment.now = moment.profile.sample(moment.t_s);
  moment.now.speed_u_s = std::max(0.0, moment.now.speed_u_s);  // a rounding error, at the last moment
  return moment;
}

/// Returns the speed at which the present acceleration has faded with the jerk of its law. A change can
/// exceed its target speed up to this: v + a^2 / 2 K for a jerk law, at most 2 v; just as much with the jerk
/// of whole sections, but no more than the top speed; no other law exceeds anything.
Long faded(const Sample& now, const SpeedLaw& law) {
  const Long a = now.acceleration_u_s2;
  const Long v = now.speed_u_s;
  if (a <= 0) return v;
  if (law.up.kind == RampLaw::Kind::jerk) return v + std::min(v, a * a / (2 * law.up.jerk_u_s3));
  if (law.up.kind != RampLaw::Kind::sections || law.up.section_u_s == 0) return v;
  const Long limit = law.up.acceleration_u_s2;
  return std::min(v + law.up.section_u_s * (a / limit) * (a / limit), std::max<Long>(law.top_speed_u_s, v));
}

/// Limits of a change from `now`, in which speeds should stay within [least, most].
Fault change_beyond_limits(const Profile& profile, const Sample& now, const SpeedLaw& law, Long min,
                           Long max) {
  const Blur blur = blur_of(profile);
  const Long top = std::max<Long>(max, law.top_speed_u_s);
  const Long blur_speed = kLimitTolerance * top + 4 * blur.speed;
  const Long acceleration =
      std::max({limits_of(law.up, top).acceleration, limits_of(law.down, top).acceleration,
                std::abs(Long{now.acceleration_u_s2})});
  Long before = now.acceleration_u_s2;
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    const Segment& segment = profile.segments[static_cast<std::size_t>(i)];
    const Long duration_s = segment_end_s(profile, i) - segment.begin_s;
    const State begin = begin_of(segment);
    const State end = std::isinf(duration_s) ? begin : advance(begin, segment.jerk_u_s3, duration_s);
    for (const State& state : {begin, end}) {
      if (state.speed > max + blur_speed || state.speed < min - blur_speed) {
        return "speed is " + text(state.speed);
      }
      if (!has_jerk(law.up) || !has_jerk(law.down)) continue;
      if (std::abs(state.acceleration) > acceleration * (1 + kLimitTolerance) + 4 * blur.acceleration) {
        return "acceleration is " + text(state.acceleration);
      }
    }
    // Jerk: the law's; more only if that could not bring the acceleration to 0 before the start speed, as
    // with rounding errors at the end of a ramp.
    const bool both_by_jerk = law.up.kind == RampLaw::Kind::jerk && law.down.kind == RampLaw::Kind::jerk;
    const Long jerk = std::max(law.up.jerk_u_s3, law.down.jerk_u_s3);
    const bool rounding = std::abs(begin.speed - end.speed) <= kLimitTolerance * top;
    if (both_by_jerk && !rounding && std::abs(segment.jerk_u_s3) > jerk * (1 + 1e-6L)) {
      return "jerk is " + text(segment.jerk_u_s3);
    }
    // Acceleration without a gap, from the state on.
    const Long gap = std::abs(begin.acceleration - before);
    const bool jumped_to_start = i == 0 && now.speed_u_s < segment.speed_u_s;
    if (both_by_jerk && !jumped_to_start && gap > 1e-6L * acceleration + 4 * blur.acceleration &&
        gap * gap / (2 * jerk) > blur_speed) {
      return "acceleration jumps by " + text(gap) + " before segment " + std::to_string(i);
    }
    before = end.acceleration;
  }
  return {};
}

Fault begins_elsewhere(const Profile& profile, const Sample& now, const SpeedLaw& law) {
  if (profile.segment_count == 0) {
    return std::abs(profile.end_position_u - now.position_u) < 2e-9 ? Fault{} : "it begins elsewhere";
  }
  const Segment& first = profile.segments[0];
  if (first.position_u != now.position_u) return "it begins at " + text(first.position_u);
  const double start = std::min(law.start_speed_u_s, law.top_speed_u_s);
  const bool jumps = now.speed_u_s <= start * (1 + 2e-12);  // speeds below the start speed are skipped
  if (!jumps && std::abs(first.speed_u_s - now.speed_u_s) > 1e-11 * now.speed_u_s) {
    return "it begins with speed " + text(first.speed_u_s);
  }
  return {};
}

class ChangeProperty : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Of, ChangeProperty, testing::Range(0, 5), [](const auto& family) {
  return kFamilies[static_cast<std::size_t>(family.param)];
});

/// Only for families whose ramps continue from the present state: one by time starts again.
class ChangeOnTheWay : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Of, ChangeOnTheWay, testing::Values(kSlopes, kJerk, kSections),
                         [](const auto& family) {
                           return kFamilies[static_cast<std::size_t>(family.param)];
                         });

template <class Try>
void from_every_moment(std::uint64_t salt, int family, const Try& try_one) {
  const std::uint64_t from = seed() + salt + static_cast<std::uint64_t>(family);
  std::cout << "seed " << from << "\n";
  RandomLaws random(from);
  const int tries = random_cases(20'000);
  for (int i = 0; i < tries; ++i) {
    const OnTheWay moment = random_moment(random, family);
    Fault fault;
    try {
      fault = try_one(random, moment);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    ASSERT_FALSE(fault) << "seed " << from << ": " << moment.words() << ": " << *fault;
  }
}

TEST_P(ChangeProperty, AnotherSpeedIsReachedWithoutAGapAndKept) {
  from_every_moment(100, GetParam(), [](RandomLaws& random, const OnTheWay& moment) -> Fault {
    const SpeedLaw& law = moment.law;
    double speed = law.top_speed_u_s * random.between(0, 1.5);
    if (random.below(8) == 0) speed = law.top_speed_u_s;
    if (random.below(8) == 0) speed = moment.now.speed_u_s;
    if (random.below(8) == 0) speed = law.start_speed_u_s;
    if (speed == 0) return {};
    const Profile profile = change_speed(moment.now, speed, law);
    const std::string what = " with change_speed(now, " + code(speed) + ", law)";
    if (!profile.endless()) return "it ends" + what;
    if (profile.end_speed_u_s != speed || profile.sample(1e7).speed_u_s != speed)
      return "another speed" + what;
    const double start = law.start_speed_u_s;
    const Long max = std::max<Long>({Long{speed}, Long{start}, faded(moment.now, law)});
    Fault fault = begins_elsewhere(profile, moment.now, law);
    // From the start speed down it is a jump, to the commanded speed.
    if (!fault && speed >= start) fault = gap_in(profile, farthest(profile), law.top_speed_u_s);
    if (!fault && speed >= start) fault = change_beyond_limits(profile, moment.now, law, start, max);
    return fault ? *fault + what : fault;
  });
}

/// A change of speed no larger than a rounding error is not made by a ramp, and may be lost in the speeds
/// themselves. It would take this long.
double tail_s(const Sample& now, const SpeedLaw& law) {
  const double rounding_u_s = 2e-12 * (now.speed_u_s + law.start_speed_u_s) + 1e-15 * law.top_speed_u_s;
  switch (law.down.kind) {
    case RampLaw::Kind::jerk: return 2 * std::sqrt(rounding_u_s / law.down.jerk_u_s3);
    case RampLaw::Kind::time:
      return now.speed_u_s - law.start_speed_u_s < rounding_u_s ? law.down.duration_s : 0;
    case RampLaw::Kind::sections:
      return now.jerk_u_s3 == 0 ? 0 : 2 * std::sqrt(rounding_u_s / std::abs(now.jerk_u_s3));
    case RampLaw::Kind::slope: break;
  }
  return 0;
}
double tail_u(const Sample& now, const SpeedLaw& law) { return tail_s(now, law) * law.start_speed_u_s; }

/// The distance of a stop, in closed form; nothing if there is none without integration.
std::optional<Long> stop_distance(const Sample& now, const SpeedLaw& law) {
  const Long start = law.start_speed_u_s;
  const Long speed = now.speed_u_s;
  const Long a = now.acceleration_u_s2;
  if (speed <= start) return 0;
  const RampLaw& moving = a > 0 ? law.up : law.down;
  if (a == 0 || moving.kind == RampLaw::Kind::slope || moving.kind == RampLaw::Kind::time) {
    return oracle::ramp_distance(law.down, start, speed);
  }
  if (moving.kind != RampLaw::Kind::jerk) return {};
  const Long k = moving.jerk_u_s3;
  const Long t = std::abs(a) / k;
  if (a > 0) {
    const Long peak = speed + a * t / 2;
    return speed * t + a * t * t / 2 - k * t * t * t / 6 + oracle::ramp_distance(law.down, start, peak);
  }
  // On a ramp down that started `t` ago, at a speed higher by a^2 / 2 K.
  const Long began = speed - a * t / 2;
  return oracle::ramp_distance(law.down, start, began) - (began * t - k * t * t * t / 6);
}

TEST_P(ChangeProperty, AStopTakesTheDistanceOfItsClosedForm) {
  from_every_moment(200, GetParam(), [](RandomLaws&, const OnTheWay& moment) -> Fault {
    const Profile profile = slow_to_stop(moment.now, moment.law);
    Fault fault = begins_elsewhere(profile, moment.now, moment.law);
    if (fault) return fault;
    const Long went = Long{profile.end_position_u} - moment.now.position_u;
    if (const std::optional<Long> stop = stop_distance(moment.now, moment.law)) {
      if (std::abs(went - *stop) > 1e-9L * moment.distance + tail_u(moment.now, moment.law)) {
        return "stops after " + text(went) + ", not " + text(*stop);
      }
    }
    if (profile.segment_count == 0) return {};
    const Long start = moment.law.start_speed_u_s;
    if (profile.end_speed_u_s != moment.law.start_speed_u_s)
      return "ends with " + text(profile.end_speed_u_s);
    fault = gap_in(profile, moment.distance);
    if (!fault) fault = differs_from_integral(profile, profile.end_position_u, moment.distance);
    if (!fault) {
      fault = change_beyond_limits(profile, moment.now, moment.law, start, faded(moment.now, moment.law));
    }
    return fault;
  });
}

TEST_P(ChangeOnTheWay, AStopWhileSlowingDownEndsWhereTheMoveWouldHave) {
  from_every_moment(300, GetParam(), [](RandomLaws&, const OnTheWay& moment) -> Fault {
    const SpeedLaw& law = moment.law;
    if (moment.now.acceleration_u_s2 >= 0 || moment.now.speed_u_s <= law.start_speed_u_s) return {};
    const Profile profile = slow_to_stop(moment.now, law);
    if (std::abs(profile.end_position_u - moment.distance) >
        1e-9 * moment.distance + tail_u(moment.now, law)) {
      return "stops at " + text(profile.end_position_u);
    }
    if (std::abs(moment.t_s + profile.duration_s - moment.profile.duration_s) >
        1e-6 + tail_s(moment.now, law)) {
      return "stops after " + text(moment.t_s + profile.duration_s) + " s";
    }
    return {};
  });
}

Fault wrong_way_to(double target, const OnTheWay& moment, const SpeedLaw& law) {
  const Profile profile = change_target(moment.now, target, law);
  Fault fault = off_target(profile, target);
  if (!fault) fault = begins_elsewhere(profile, moment.now, law);
  if (fault || profile.segment_count == 0) return fault;
  const Long scale_u = farthest(profile) + 20;  // less than 1e-9 is not a distance
  fault = gap_in(profile, scale_u);
  if (!fault) fault = differs_from_integral(profile, target, scale_u);
  if (!fault) {
    const Long max =
        std::max<Long>({Long{law.top_speed_u_s}, Long{moment.now.speed_u_s}, faded(moment.now, law)});
    fault = change_beyond_limits(profile, moment.now, law, -law.top_speed_u_s, max);
  }
  return fault;
}

TEST_P(ChangeProperty, AnotherTargetIsMetExactlyFartherNearerAndPassed) {
  from_every_moment(400, GetParam(), [](RandomLaws& random, const OnTheWay& moment) -> Fault {
    double target = std::floor(moment.distance * random.between(-1, 3));
    switch (random.below(8)) {
      case 0: target = moment.distance; break;
      case 1: target = moment.now.position_u; break;
      case 2: target = std::floor(moment.now.position_u) + 1; break;
      case 3: target = slow_to_stop(moment.now, moment.law).end_position_u; break;  // just near enough
      case 4: target = std::floor(slow_to_stop(moment.now, moment.law).end_position_u); break;
      default: break;
    }
    const Fault fault = wrong_way_to(target, moment, moment.law);
    return fault ? *fault + " with change_target(now, " + code(target) + ", law)" : fault;
  });
}

TEST_P(ChangeProperty, AnotherTargetByAnotherLawIsMetExactly) {
  from_every_moment(500, GetParam(), [](RandomLaws& random, const OnTheWay& moment) -> Fault {
    SpeedLaw law = random_law(random, kMixed);
    law.when_short = static_cast<Short>(random.below(3));
    if (law.start_speed_u_s > 0) {
      if (random.below(4) == 0) law.slow_down_offset_u = random.below(2) == 0 ? 8 : -8;
      if (random.below(4) == 0) law.slow_down_reckoned_by = random.any_ramp(from_start(law), false);
      if (random.below(4) == 0) law.slow_down_at_u = moment.distance * random.between(0, 0.5);
    }
    const double target = std::floor(moment.distance * random.between(-1, 3));
    const Profile profile = change_target(moment.now, target, law);
    Fault fault = off_target(profile, target);
    if (!fault) fault = begins_elsewhere(profile, moment.now, law);
    if (!fault) fault = gap_in(profile, farthest(profile) + 20);
    return fault ? *fault + " with " + code(law) + " change_target(now, " + code(target) + ", law)" : fault;
  });
}

TEST_P(ChangeOnTheWay, NoChangeOfTargetIsNoChange) {
  from_every_moment(600, GetParam(), [](RandomLaws&, const OnTheWay& moment) -> Fault {
    const Profile rest = change_target(moment.now, moment.distance, moment.law);
    if (std::abs(moment.t_s + rest.duration_s - moment.profile.duration_s) >
        1e-6 + tail_s(moment.now, moment.law)) {
      return "takes " + code(moment.t_s + rest.duration_s) + " s, not " + code(moment.profile.duration_s);
    }
    for (const double share : {0.1, 0.5, 0.9}) {
      const double t_s = rest.duration_s * share;
      const double expected = moment.profile.sample(moment.t_s + t_s).position_u;
      if (std::abs(rest.sample(t_s).position_u - expected) > 1e-6 * moment.distance)
        return "goes another way";
    }
    return {};
  });
}

TEST_P(ChangeProperty, AnEndlessMoveIsStoppedAndGivenATargetAsWell) {
  from_every_moment(700, GetParam(), [](RandomLaws& random, const OnTheWay& other) -> Fault {
    OnTheWay moment = other;
    moment.profile = plan_endless(moment.law);
    moment.t_s = other.profile.duration_s * random.between(0, 2);
    moment.now = moment.profile.sample(moment.t_s);
    const Profile stop = slow_to_stop(moment.now, moment.law);
    if (const std::optional<Long> distance = stop_distance(moment.now, moment.law)) {
      const Long went = Long{stop.end_position_u} - moment.now.position_u;
      const Long tolerance_u = 1e-9L * (moment.now.position_u + *distance) + tail_u(moment.now, moment.law);
      if (std::abs(went - *distance) > tolerance_u) {
        return "stops after " + text(went) + ", not " + text(*distance) + ", from " + code(moment.now);
      }
    }
    moment.distance = std::max(1.0, moment.now.position_u);
    return wrong_way_to(std::floor(moment.now.position_u * random.between(0, 2)), moment, moment.law);
  });
}

}  // namespace change_property_test
}  // namespace understudy::motion
