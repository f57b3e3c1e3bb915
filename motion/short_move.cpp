#include "motion/short_move.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "motion/ramp.h"

namespace understudy::motion {

namespace {

// Both ramps cover (2 start + x) / 2 times their duration, so x is the solution of
//   (2 start + x) * (a x + b + c sqrt x) = 2 distance,
// where a, b and c are the sums of the two laws' coefficients, in the form that applies at x.
struct Sum {
  double a = 0;
  double b = 0;
  double c = 0;

  double distance(double start, double x) const {
    return 0.5 * (2 * start + x) * (a * x + b + c * std::sqrt(x));
  }
};

Sum sum_at(const RampLaw& up, const RampLaw& down, double x) {
  const RampTime first = time_law(up, x);
  const RampTime second = time_law(down, x);
  return {.a = first.per_speed + second.per_speed,
          .b = first.constant + second.constant,
          .c = first.per_root + second.per_root};
}

/// Returns the cube root of a value > 0, as a start for Newton's method. The result is slightly too large
/// rather than too small.
double above_cube_root(double value) {
  // Start from a third of the exponent. Three Newton steps then approach the root from above.
  const auto bits = std::bit_cast<std::uint64_t>(value);
  double y = std::bit_cast<double>(bits / 3 + 0x2A9F789300000000ULL);
  for (int step = 0; step < 3; ++step) y = (2 * y + value / (y * y)) / 3;
  return y * (1 + 1e-9);
}

double solve_quadratic(const Sum& sum, double start_u_s, double twice_distance_u) {
  // a x^2 + (b + 2 start_u_s a) x + 2 start_u_s b - 2 distance = 0, solved in the form that avoids
  // cancellation.
  const double linear = sum.b + 2 * start_u_s * sum.a;
  const double missing = twice_distance_u - 2 * start_u_s * sum.b;
  if (missing <= 0) return 0;
  if (sum.a == 0) return missing / linear;
  return 2 * missing / (linear + std::sqrt(linear * linear + 4 * sum.a * missing));
}

double solve_with_root(const Sum& sum, double start_u_s, double twice_distance_u) {
  // y = sqrt x: (2 start_u_s + y^2) (a y^2 + c y + b) = 2 distance. The left side is convex and increasing,
  // so Newton's method approaches the root from above and never passes it.
  const double missing = twice_distance_u - 2 * start_u_s * sum.b;
  if (missing <= 0) return 0;
  // Each power of y alone yields a bound. The smallest bound is at most four times too large.
  double y = above_cube_root(missing / sum.c);
  if (start_u_s > 0) y = std::min(y, missing / (2 * start_u_s * sum.c));
  if (const double square = 2 * start_u_s * sum.a + sum.b; square > 0)
    y = std::min(y, std::sqrt(missing / square));
  if (sum.a > 0) y = std::min(y, std::sqrt(std::sqrt(missing / sum.a)));
  y *= 1 + 1e-15;
  for (int step = 0; step < 20; ++step) {
    const double time = y * (sum.a * y + sum.c) + sum.b;
    const double speeds = 2 * start_u_s + y * y;
    const double value = speeds * time - twice_distance_u;
    const double rise = 2 * y * time + speeds * (2 * sum.a * y + sum.c);
    const double next = y - value / rise;
    if (!(next < y)) break;
    const bool settled = y - next <= 1e-16 * y;
    y = next;
    if (settled) break;
  }
  return y > 0 ? y * y : 0;
}

}  // namespace

double rise_within(double distance_u, double start_u_s, const RampLaw& up, const RampLaw& down,
                   double limit_u_s) {
  if (!(distance_u > 0) || !(limit_u_s > 0)) return 0;
  const double limit_needs = sum_at(up, down, limit_u_s).distance(start_u_s, limit_u_s);
  if (limit_needs <= distance_u) return limit_u_s;
  // Find the form of each law that applies at the solution: try the points at which the forms change.
  double low = 0;
  double high = limit_u_s;
  for (const double change : {form_changes_at(up), form_changes_at(down)}) {
    if (change <= low || change >= high) continue;
    (sum_at(up, down, change).distance(start_u_s, change) <= distance_u ? low : high) = change;
  }
  // A form applies up to and including its change, so the form that applies below `high` also applies at
  // `high`.
  const Sum sum = sum_at(up, down, high);
  const double x = sum.c > 0 ? solve_with_root(sum, start_u_s, 2 * distance_u)
                             : solve_quadratic(sum, start_u_s, 2 * distance_u);
  return std::clamp(x, low, high);
}

}  // namespace understudy::motion
