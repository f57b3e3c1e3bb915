#include "motion/ramp.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/bad_motion.h"
#include "motion/profile.h"

namespace understudy::motion {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Returns the part of the acceleration that the law can have built up from standstill. Any excess, such as
/// after a change to a softer law, drops at once. So fading the acceleration at most doubles the speed.
double own_acceleration(const Sample& now, const RampLaw& up) {
  if (now.acceleration_u_s2 <= 0 || up.kind != RampLaw::Kind::jerk) return now.acceleration_u_s2;
  return std::min(now.acceleration_u_s2, std::sqrt(2 * up.jerk_u_s3 * now.speed_u_s) * (1 + 1e-12));
}

/// Returns the jerk with which a law brings the acceleration to 0, or 0 for laws that let it drop at once.
double usual_jerk(const RampLaw& law, const Sample& now) {
  switch (law.kind) {
    case RampLaw::Kind::jerk: return law.jerk_u_s3;
    case RampLaw::Kind::sections:
      if (law.section_u_s <= 0) return 0;
      // A small change has sections smaller than S, and therefore a greater jerk. It has no straight part,
      // where the jerk would be 0.
      if (now.jerk_u_s3 != 0) return std::abs(now.jerk_u_s3);
      return law.acceleration_u_s2 * law.acceleration_u_s2 / (2 * law.section_u_s);
    case RampLaw::Kind::slope:
    case RampLaw::Kind::time: break;
  }
  return 0;
}

/// Returns the usual jerk, or a greater one if the usual jerk would leave the speed range.
double jerk_within(const SpeedRange& range, const Sample& now, double acceleration_u_s2, const RampLaw& up,
                   const RampLaw& down) {
  if (acceleration_u_s2 == 0) return 0;
  const RampLaw& law = acceleration_u_s2 > 0 ? up : down;
  const double usual = usual_jerk(law, now);
  if (usual == 0 || (acceleration_u_s2 > 0 && law.kind == RampLaw::Kind::jerk)) return usual;
  const double room = acceleration_u_s2 > 0 ? range.max_u_s - now.speed_u_s : now.speed_u_s - range.min_u_s;
  return room > 0 ? std::max(usual, acceleration_u_s2 * acceleration_u_s2 / (2 * room)) : 0;
}

/// A smaller change is a rounding error, not a change that needs a ramp.
double rounding_of_change(double from_u_s, double to_u_s) { return 1e-12 * std::max(from_u_s, to_u_s); }

}  // namespace

RampLaw RampLaw::by_slope(double acceleration_u_s2) {
  RampLaw law{.kind = Kind::slope, .acceleration_u_s2 = acceleration_u_s2};
  check(law);
  return law;
}

RampLaw RampLaw::by_time(double duration_s) {
  RampLaw law{.kind = Kind::time, .duration_s = duration_s};
  check(law);
  return law;
}

RampLaw RampLaw::by_jerk(double jerk_u_s3) {
  RampLaw law{.kind = Kind::jerk, .acceleration_u_s2 = kInfinite, .jerk_u_s3 = jerk_u_s3};
  check(law);
  return law;
}

RampLaw RampLaw::by_jerk(double jerk_u_s3, double acceleration_limit_u_s2) {
  require_finite(acceleration_limit_u_s2, "jerk ramp", "acceleration limit");
  RampLaw law{.kind = Kind::jerk, .acceleration_u_s2 = acceleration_limit_u_s2, .jerk_u_s3 = jerk_u_s3};
  check(law);
  return law;
}

RampLaw RampLaw::by_sections(double acceleration_u_s2, double section_u_s) {
  RampLaw law{.kind = Kind::sections, .acceleration_u_s2 = acceleration_u_s2, .section_u_s = section_u_s};
  check(law);
  return law;
}

void check(const RampLaw& law) {
  switch (law.kind) {
    case RampLaw::Kind::slope: require_positive(law.acceleration_u_s2, "ramp", "acceleration"); break;
    case RampLaw::Kind::time: require_positive(law.duration_s, "ramp", "duration"); break;
    case RampLaw::Kind::jerk:
      require_positive(law.jerk_u_s3, "jerk ramp", "jerk");
      if (law.acceleration_u_s2 != kInfinite) {
        require_positive(law.acceleration_u_s2, "jerk ramp", "acceleration limit");
      }
      break;
    case RampLaw::Kind::sections:
      require_positive(law.acceleration_u_s2, "ramp with sections", "acceleration");
      require_not_negative(law.section_u_s, "ramp with sections", "section");
      break;
  }
}

double form_changes_at(const RampLaw& law) {
  switch (law.kind) {
    case RampLaw::Kind::jerk: return law.acceleration_u_s2 * law.acceleration_u_s2 / law.jerk_u_s3;
    case RampLaw::Kind::sections: return 2 * law.section_u_s;
    case RampLaw::Kind::slope:
    case RampLaw::Kind::time: break;
  }
  return kInfinite;
}

RampTime time_law(const RampLaw& law, double dv_u_s) {
  const double a = law.acceleration_u_s2;
  switch (law.kind) {
    case RampLaw::Kind::slope: return {.per_speed = 1 / a};
    case RampLaw::Kind::time: return {.constant = law.duration_s};
    case RampLaw::Kind::jerk:
      if (dv_u_s <= form_changes_at(law)) return {.per_root = 2 / std::sqrt(law.jerk_u_s3)};
      return {.per_speed = 1 / a, .constant = a / law.jerk_u_s3};
    case RampLaw::Kind::sections:
      if (dv_u_s <= form_changes_at(law)) return {.per_speed = 2 / a};
      return {.per_speed = 1 / a, .constant = 2 * law.section_u_s / a};
  }
  return {};
}

Ramp ramp(const RampLaw& law, double dv_u_s) {
  if (!(dv_u_s > 0)) return {};
  const double a = law.acceleration_u_s2;
  switch (law.kind) {
    case RampLaw::Kind::slope: return {.middle_s = dv_u_s / a, .acceleration_u_s2 = a};
    case RampLaw::Kind::time:
      return {.middle_s = law.duration_s, .acceleration_u_s2 = dv_u_s / law.duration_s};
    case RampLaw::Kind::jerk: {
      const double k = law.jerk_u_s3;
      if (dv_u_s <= form_changes_at(law)) {
        const double ends_s = std::sqrt(dv_u_s / k);
        return {.ends_s = ends_s, .acceleration_u_s2 = k * ends_s, .jerk_u_s3 = k};
      }
      return {.ends_s = a / k, .middle_s = dv_u_s / a - a / k, .acceleration_u_s2 = a, .jerk_u_s3 = k};
    }
    case RampLaw::Kind::sections: {
      const double section = std::min(law.section_u_s, dv_u_s / 2);
      if (section <= 0) return {.middle_s = dv_u_s / a, .acceleration_u_s2 = a};
      const double ends_s = 2 * section / a;
      return {.ends_s = ends_s,
              .middle_s = (dv_u_s - 2 * section) / a,
              .acceleration_u_s2 = a,
              .jerk_u_s3 = a / ends_s};
    }
  }
  return {};
}

double ramp_distance(const RampLaw& law, double from_u_s, double to_u_s) {
  return 0.5 * (from_u_s + to_u_s) * ramp(law, std::abs(to_u_s - from_u_s)).duration_s();
}

void append_ramp(Profile& profile, const RampLaw& law, double from_u_s, double to_u_s) {
  const Ramp shape = ramp(law, std::abs(to_u_s - from_u_s));
  const double sign = to_u_s < from_u_s ? -1 : 1;
  const double a = sign * shape.acceleration_u_s2;
  const double j = sign * shape.jerk_u_s3;
  const double at_ends = 0.5 * a * shape.ends_s;  // the change of speed in each of the two ends
  profile.append(shape.ends_s, from_u_s, 0, j);
  profile.append(shape.middle_s, from_u_s + at_ends, a, 0);
  profile.append(shape.ends_s, to_u_s - at_ends, a, -j);
  // The sum of the parts may differ from the speed by a rounding error.
  if (profile.segment_count > 0 && shape.duration_s() > 0) profile.end_speed_u_s = to_u_s;
}

double speed_without_acceleration(const Sample& now, const RampLaw& up, const RampLaw& down,
                                  const SpeedRange& range) {
  const double acceleration = own_acceleration(now, up);
  const double jerk = jerk_within(range, now, acceleration, up, down);
  if (jerk == 0) return now.speed_u_s;
  const double faded = now.speed_u_s + acceleration * std::abs(acceleration) / (2 * jerk);
  return std::max(range.min_u_s, faded);
}

void append_change(Profile& profile, const Sample& now, double to_u_s, const RampLaw& up, const RampLaw& down,
                   const SpeedRange& range) {
  double speed = now.speed_u_s;
  const double acceleration = own_acceleration(now, up);
  const double jerk = jerk_within(range, now, acceleration, up, down);
  if (jerk > 0) {
    const double sign = acceleration < 0 ? -1 : 1;
    const double size = std::abs(acceleration);
    const double faded = speed_without_acceleration(now, up, down, range);
    if (sign * (to_u_s - faded) > rounding_of_change(faded, to_u_s)) {
      // The speed continues to change in the same direction: up to the maximum acceleration, at it, and back
      // to 0.
      const double further = sign * (to_u_s - speed);
      const double bound = (acceleration > 0 ? up : down).acceleration_u_s2;
      const double peak = std::min(bound, std::sqrt(jerk * further + 0.5 * size * size));
      const double there_s = std::abs(peak - size) / jerk;
      const double gained = 0.5 * (size + peak) * there_s;
      const double fade_s = peak / jerk;
      const double left = 0.5 * peak * fade_s;
      profile.append(there_s, speed, acceleration, peak < size ? -sign * jerk : sign * jerk);
      profile.append((further - gained - left) / peak, speed + sign * gained, sign * peak, 0);
      profile.append(fade_s, to_u_s - sign * left, sign * peak, -sign * jerk);
      profile.end_speed_u_s = to_u_s;
      return;
    }
    profile.append(size / jerk, speed, acceleration, -sign * jerk);
    profile.end_speed_u_s = faded;
    speed = faded;
  }
  if (std::abs(to_u_s - speed) > rounding_of_change(speed, to_u_s)) {
    append_ramp(profile, to_u_s < speed ? down : up, speed, to_u_s);
  } else if (profile.segment_count > 0) {
    profile.end_speed_u_s = to_u_s;
  }
}

}  // namespace understudy::motion
