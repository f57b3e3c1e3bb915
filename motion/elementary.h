// Our own sine, cosine, arctangent and logarithm. Those of the maths library differ in their last bits from
// processor to processor. These functions use only + - * / and rounding, so a path has the same bytes
// everywhere. Outside its domain, each function returns NaN; none of them throws.
#pragma once

namespace understudy::motion {

struct SineCosine {
  double sine = 0;
  double cosine = 1;
};

inline constexpr double kPi = 3.14159265358979323846;

/// The largest angle that sine_cosine accepts: about 160,000 turns.
inline constexpr double kFarthestAngle_rad = 1e6;

/// Returns both at once for |angle_rad| <= kFarthestAngle_rad. Returns NaN for both beyond that, and for NaN
/// and infinities. The angle is the exact value of the double: the absolute error of each result is below
/// 1.2e-16, and the relative error below 2.5e-16, even near the zeros (the sine of the double nearest to pi
/// is 1.2246e-16). At +-0 the result is exactly (angle, 1).
SineCosine sine_cosine(double angle_rad);

/// Returns the angle of (x, y) in [-kPi, kPi], counter-clockwise from +x. The relative error is below 4e-16.
/// (0, 0) gives 0, and y = +-0 with x < 0 gives +kPi. NaN and infinities give NaN.
double angle_of(double y, double x);

/// Returns the natural logarithm of a finite value > 0, which may be subnormal. The relative error is below
/// 4e-16. The result for 1 is exactly 0. 0, negative values, NaN and infinities give NaN.
double natural_log(double value);

}  // namespace understudy::motion
