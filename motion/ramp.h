// How speed changes: the law of one ramp, from one speed to another. The acceleration is 0 at both ends.
//
//   speed      ╭───      Every ramp here is the same forwards and backwards, so it covers the mean of its two
//            ╱            speeds times its duration. A law is therefore one function, the duration of a
//            change of
//       ___╯              speed, and the shape that goes with it.
//       ends middle ends
//
// u is the coordinate's unit (motion/profile.h).
#pragma once

#include <cstdint>

#include "motion/profile.h"

namespace understudy::motion {

struct RampLaw {
  enum class Kind : std::uint8_t {
    slope,     // constant acceleration: T = dv / a                        (MCX314 T-curve, PCL6045 linear)
    time,      // constant duration, whatever the change: T given          (Simple2-R3, appendix A)
    jerk,      // jerk K, acceleration at most A: T = 2 sqrt(dv / K), and   (MCX314 S-curve: no bound A)
               //   dv / A + A / K when A is reached
    sections,  // slope a between two parabolic sections of S each:        (PCL6045 S-curve)
               //   T = (dv + 2 S) / a, and 2 dv / a when 2 S >= dv
  };

  Kind kind = Kind::slope;
  double acceleration_u_s2 = 0;  // slope, sections: a; jerk: the bound A, or infinite
  double jerk_u_s3 = 0;          // jerk: K
  double section_u_s = 0;        // sections: S
  double duration_s = 0;         // time: T

  bool operator==(const RampLaw&) const = default;

  /// All throw BadMotion for values that are not finite or not above 0 (section: not below 0).
  static RampLaw by_slope(double acceleration_u_s2);
  static RampLaw by_time(double duration_s);
  static RampLaw by_jerk(double jerk_u_s3);
  static RampLaw by_jerk(double jerk_u_s3, double acceleration_limit_u_s2);
  static RampLaw by_sections(double acceleration_u_s2, double section_u_s);
};

/// Throws BadMotion if `law` is not one that the functions above could have made.
void check(const RampLaw& law);

/// The duration of a change of speed dv >= 0 is per_speed * dv + constant + per_root * sqrt(dv), in the form
/// that holds at the given dv. Planners solve it for dv.
struct RampTime {
  double per_speed = 0;
  double constant = 0;
  double per_root = 0;
};
RampTime time_law(const RampLaw& law, double dv_u_s);
/// Returns the dv at which the law changes from one form to the other, or infinity if it has only one.
double form_changes_at(const RampLaw& law);

/// The shape of one change of speed.
struct Ramp {
  double ends_s = 0;             // duration of each of the two ends, where acceleration grows and fades
  double middle_s = 0;           // duration at constant acceleration
  double acceleration_u_s2 = 0;  // the maximum acceleration, >= 0
  double jerk_u_s3 = 0;          // jerk in the ends, >= 0

  double duration_s() const { return 2 * ends_s + middle_s; }
};
Ramp ramp(const RampLaw& law, double dv_u_s);

/// Returns the distance from one speed (>= 0) to another.
double ramp_distance(const RampLaw& law, double from_u_s, double to_u_s);

/// Appends the ramp from one speed (>= 0) to another.
void append_ramp(Profile& profile, const RampLaw& law, double from_u_s, double to_u_s);

/// The range in which the speed stays during a change: 0 <= min <= max.
struct SpeedRange {
  double min_u_s = 0;
  double max_u_s = 0;
};

/// Appends the change from `now` (its speed in `range`, its acceleration not necessarily 0; its position does
/// not matter) to `to_u_s`, with no acceleration there. The present acceleration is brought to 0 by the jerk
/// of the law it belongs to (`up` for above 0, `down` for below), so the speed may pass `to_u_s` on the way;
/// laws without jerk drop it at once. A section law continues with the present jerk, as that depends on the
/// change under way. If a jerk is too small to keep the speed within `range`, a greater one is used, except
/// for a jerk law going up: that passes range.max_u_s, up to at most speed_without_acceleration(), which is
/// no more than twice the speed.
void append_change(Profile& profile, const Sample& now, double to_u_s, const RampLaw& up, const RampLaw& down,
                   const SpeedRange& range);
/// Returns the speed at which the acceleration of such a change first is 0, if it fades at once.
double speed_without_acceleration(const Sample& now, const RampLaw& up, const RampLaw& down,
                                  const SpeedRange& range);

}  // namespace understudy::motion
