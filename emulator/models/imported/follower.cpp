#include "emulator/models/imported/follower.h"

#include <algorithm>
#include <cmath>

namespace understudy::emulator::models::imported {

namespace {

constexpr double kRest = 1e-9;

/// Returns 1 - exp(-x) for 0 <= x <= 0.5, from its series.
double by_series(double x) {
  double term = x;
  double sum = x;
  for (int n = 2; n < 30; ++n) {
    term = -term * x / n;
    sum += term;
  }
  return sum;
}

}  // namespace

double lag_fraction(double time_s, double time_constant_s) {
  if (!(time_constant_s > 0)) return 1;
  double x = time_s / time_constant_s;
  if (!(x < 50)) return 1;
  int doublings = 0;
  for (; x > 0.5; x /= 2) ++doublings;
  // The first half of the time covers the fraction s of the distance, and the second half covers s of the
  // rest.
  double share = by_series(x);
  for (; doublings > 0; --doublings) share += share * (1 - share);
  return share;
}

double approach(double value, double goal, double share, double max) {
  double step = share * (goal - value);
  if (max > 0) step = std::clamp(step, -max, max);
  const double next = value + step;
  return std::abs(goal - next) <= kRest * std::max(1.0, std::abs(goal)) ? goal : next;
}

}  // namespace understudy::emulator::models::imported
