// Our own sine, cosine, arctangent and logarithm. Those of the maths library differ in their last bits from
// processor to processor; these use only + - * / and rounding, so a path has the same bytes everywhere.
// Outside its domain each returns NaN; none of them throws.
#pragma once

namespace understudy::motion {

struct SineCosine {
  double sine = 0;
  double cosine = 1;
};

inline constexpr double kPi = 3.14159265358979323846;

/// The largest angle that sine_cosine accepts: about 160,000 turns.
inline constexpr double kFarthestAngle_rad = 1e6;

/// Both at once, for |angle_rad| <= kFarthestAngle_rad; NaN for both beyond, and for NaN and infinities. The
/// angle is taken as the very number given: absolute error below 1.2e-16 each, and relative error below
/// 2.5e-16, near the zeros too (the sine of the double nearest to pi is 1.2246e-16). Exactly (angle, 1) at
/// +-0.
SineCosine sine_cosine(double angle_rad);

/// The angle of (x, y) in [-kPi, kPi], counter-clockwise from +x; relative error below 4e-16. (0, 0) gives 0,
/// and y = +-0 with x < 0 gives +kPi. NaN for NaN and infinities.
double angle_of(double y, double x);

/// Natural logarithm of a finite value > 0 (subnormal ones too); relative error below 4e-16. 1 gives exactly
/// 0. NaN for 0, negative values, NaN and infinities.
double natural_log(double value);

}  // namespace understudy::motion
