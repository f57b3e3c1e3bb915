// How speed changes: the law of a ramp from one speed to another. The acceleration is 0 at both ends.
//
//   speed      ╭───      Every ramp is the same forwards and backwards, so it covers the mean of its two
//            ╱            speeds times its duration. A law is therefore one function, the duration of a
//       ___╯              change of speed, and the corresponding shape.
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
    time,      // constant duration, independent of the change: T            (Simple2-R3, appendix A)
    jerk,      // jerk K, acceleration at most A: T = 2 sqrt(dv / K), and   (MCX314 S-curve: no limit A)
               //   dv / A + A / K when A is reached
    sections,  // slope a between two parabolic sections of S each:        (PCL6045 S-curve)
               //   T = (dv + 2 S) / a, and 2 dv / a when 2 S >= dv
  };

  Kind kind = Kind::slope;
  double acceleration_u_s2 = 0;  // slope, sections: a; jerk: the limit A, or infinite
  double jerk_u_s3 = 0;          // jerk: K
  double section_u_s = 0;        // sections: S
  double duration_s = 0;         // time: T

  bool operator==(const RampLaw&) const = default;

  /// All of these throw BadMotion for values that are not finite or not above 0 (section: below 0).
  static RampLaw by_slope(double acceleration_u_s2);
  static RampLaw by_time(double duration_s);
  static RampLaw by_jerk(double jerk_u_s3);
  static RampLaw by_jerk(double jerk_u_s3, double acceleration_limit_u_s2);
  static RampLaw by_sections(double acceleration_u_s2, double section_u_s);
};

/// Throws BadMotion if the functions above could not have created `law`.
void check(const RampLaw& law);

/// The duration of a change of speed dv >= 0 is per_speed * dv + constant + per_root * sqrt(dv). The
/// coefficients are those of the form that applies at dv. Planners solve the equation for dv.
struct RampTime {
  double per_speed = 0;
  double constant = 0;
  double per_root = 0;
};
RampTime time_law(const RampLaw& law, double dv_u_s);
/// Returns the dv at which the law changes from one form to the other, or infinity if there is only one form.
double form_changes_at(const RampLaw& law);

/// The shape of one change of speed.
struct Ramp {
  double ends_s = 0;             // duration of each of the two ends, in which the acceleration grows or fades
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

/// Appends the change from `now` to `to_u_s`, where the acceleration is 0. The speed of `now` must be in
/// `range`; its acceleration need not be 0, and its position does not matter. The present acceleration is
/// brought to 0 with the jerk of the law to which it belongs (`up` for above 0, `down` for below), so the
/// speed may pass `to_u_s` on the way. Laws without jerk drop the acceleration at once. A section law
/// continues with the present jerk, because that depends on the change in progress. If a jerk is too small to
/// keep the speed within `range`, a greater one is used. The exception is a jerk law that accelerates: it may
/// exceed range.max_u_s, up to speed_without_acceleration(), which is at most twice the speed.
void append_change(Profile& profile, const Sample& now, double to_u_s, const RampLaw& up, const RampLaw& down,
                   const SpeedRange& range);
/// Returns the speed at which the acceleration of such a change first becomes 0, if it fades immediately.
double speed_without_acceleration(const Sample& now, const RampLaw& up, const RampLaw& down,
                                  const SpeedRange& range);

}  // namespace understudy::motion
