// Converts between the length travelled along an arc and the angle turned, for path.cpp and arc.cpp only.
//
// The share is the fraction of |sweep| done, 0..1. With radius(share) = r0 + growth * share, the length
// travelled per share (the pace) is sqrt((|sweep| * radius)^2 + growth^2 + |rise|^2). The length is the
// integral of the pace:
//   circle, helix   the pace is constant, share = along / length
//   spiral          closed form of the length; its inverse by Newton's method
//   longest axis    within a sector of a quarter turn about an axis, the coordinate that moves most is linear
//                   in the length: turns follow from square roots alone
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "motion/elementary.h"
#include "motion/path.h"

namespace understudy::motion {

inline double growth_u(const Path& path) { return path.radius_slope_u_rad * std::abs(path.sweep_rad); }

// ---- true length -----------------------------------------------------------------------------------------

/// Returns the mean of sqrt(x^2 + across_squared) for x between two values >= 0. One of the values or
/// `across` is above 0. The formula avoids cancellation, however close the two values are to each other.
inline double mean_pace(double low, double high, double across_squared) {
  if (low > high) std::swap(low, high);
  if (across_squared == 0) return 0.5 * (low + high);
  const double first = std::sqrt(low * low + across_squared);
  const double last = std::sqrt(high * high + across_squared);
  const double slope = (low + high) / (first + last);  // (last - first) / (high - low)
  // asinh(high / across) - asinh(low / across) = ln(1 + beyond), divided by high - low:
  const double rate = (1 + slope) / (low + first);
  const double beyond = 1 + (high - low) * rate;
  const double logarithms = beyond == 1 ? rate : rate * (natural_log(beyond) / (beyond - 1));
  return 0.5 * (last + low * slope + across_squared * logarithms);
}

inline double length_by_vector(const Path& path) {
  const double turned = std::abs(path.sweep_rad);
  const double growth = growth_u(path);
  const double across_squared = growth * growth + path.rise.squaredNorm();
  const double from = turned * path.begin_radius_u;
  if (growth == 0) return across_squared == 0 ? from : std::sqrt(from * from + across_squared);
  return mean_pace(from, std::max(0.0, from + turned * growth), across_squared);
}

/// Returns the share at `along`, for 0 < along < length. On a spiral, the length to that share is within
/// 2e-15 of the whole length from `along`.
inline double share_by_vector(const Path& path, double along) {
  const double growth = growth_u(path);
  if (growth == 0) return along / path.length_u;
  constexpr int kMaxSteps = 8;  // millions of test spirals needed at most four
  const double turned = std::abs(path.sweep_rad);
  const double across_squared = growth * growth + path.rise.squaredNorm();
  const double from = turned * path.begin_radius_u;
  const double gain = turned * growth;
  const double to = std::max(0.0, from + gain);
  // The first guess assumes that the pace changes linearly from begin to end.
  const double first = std::sqrt(from * from + across_squared);
  const double last = std::sqrt(to * to + across_squared);
  const double even = 0.5 * (first + last) * (along / path.length_u);
  const double change = gain * ((from + to) / (first + last));
  double share = 2 * even / (first + std::sqrt(std::max(0.0, first * first + 2 * change * even)));
  share = std::min(share, 1.0);
  // For nearly equal radii the guess is already exact.
  const double min = std::min(first, last) * std::min(first, last);
  if (gain * gain * across_squared <= 1e-16 * min * min) return share;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double here = std::max(0.0, from + gain * share);
    const double error = share * mean_pace(from, here, across_squared) - along;
    const double better = std::clamp(share - error / std::sqrt(here * here + across_squared), 0.0, 1.0);
    const double step = std::abs(better - share);
    share = better;
    if (step <= 1e-8 * share) break;  // the next step would be about 1e-16
  }
  return share;
}

// ---- the length along the axis that moves most -----------------------------------------------------------

/// A place on the unit circle, relative to the nearest axis (in a sector of +-45 degrees). In this sector,
/// the other axis moves most, and its coordinate is the sine. A clockwise arc is mirrored.
struct SectorPlace {
  double sine = 0;
  double cosine = 1;

  double angle_rad() const { return angle_of(sine, cosine); }
};

inline constexpr double kSector = 0x1.6a09e667f3bcdp+0;  // the length of a sector of the unit circle: 2^(1/2)

inline SectorPlace begin_in_sector(const Path& path) {
  const Point out = path.begin - path.centre;
  const double x = out.dot(path.abscissa) / path.begin_radius_u;
  const double y = out.dot(path.ordinate) / (path.sweep_rad < 0 ? -path.begin_radius_u : path.begin_radius_u);
  if (std::abs(x) >= std::abs(y)) return x > 0 ? SectorPlace{y, x} : SectorPlace{-y, -x};
  return y > 0 ? SectorPlace{-x, y} : SectorPlace{x, -y};
}

inline double length_by_longest_axis(const Path& path) {
  const SectorPlace begin = begin_in_sector(path);
  const double whole_turns = std::floor(std::abs(path.sweep_rad) / (2 * kPi));
  const double rest = std::abs(path.sweep_rad) - whole_turns * (2 * kPi);
  const double last = begin.angle_rad() + rest;
  const double sectors = std::nearbyint(last / (kPi / 2));
  // Within one sector, a difference of sines is written as a product, to keep the digits of short arcs.
  const double part = sectors == 0
                          ? 2 * sine_cosine(rest / 2).sine * sine_cosine(last - rest / 2).cosine
                          : sectors * kSector + sine_cosine(last - sectors * (kPi / 2)).sine - begin.sine;
  return path.begin_radius_u * std::max(0.0, whole_turns * 4 * kSector + part);
}

// ---- both ------------------------------------------------------------------------------------------------

/// The turn at a place along an arc; counter-clockwise is positive, as in the path.
struct Turned {
  double sine = 0;
  double cosine_less_1 = 0;  // keeps the digits of a short path on a large circle
  double share = 0;
};

inline Turned turned_to_share(const Path& path, double share) {
  const SineCosine half = sine_cosine(0.5 * path.sweep_rad * share);
  return {2 * half.sine * half.cosine, -2 * half.sine * half.sine, share};
}

inline Turned turned_by_longest_axis(const Path& path, double along) {
  const SectorPlace begin = begin_in_sector(path);
  const double way = along / path.begin_radius_u;
  const double length = begin.sine + way;
  const double sectors = std::nearbyint(length / kSector);
  SectorPlace here;
  here.sine = std::clamp(length - sectors * kSector, -1.0, 1.0);
  here.cosine = std::sqrt((1 - here.sine) * (1 + here.sine));
  Turned turned;
  double angle_in_sectors = 0;
  // The angle itself is needed only by the quantities that depend on it: a spiral's radius and a rise.
  const bool angle_counts = path.radius_slope_u_rad != 0 || !path.rise.isZero(0);
  if (sectors == 0) {
    // Within one sector, the turn is calculated from the path itself, to keep the digits of short arcs.
    const double slope = (begin.sine + here.sine) / (begin.cosine + here.cosine);
    turned = {way * (begin.cosine + begin.sine * slope), -0.5 * way * way * (1 + slope * slope)};
    if (angle_counts) angle_in_sectors = angle_of(turned.sine, 1 + turned.cosine_less_1);
  } else {
    const double sine = here.sine * begin.cosine - here.cosine * begin.sine;
    const double cosine = here.cosine * begin.cosine + here.sine * begin.sine;
    switch (static_cast<std::int64_t>(sectors) & 3) {
      case 0: turned = {sine, cosine - 1}; break;
      case 1: turned = {cosine, -sine - 1}; break;
      case 2: turned = {-sine, -cosine - 1}; break;
      default: turned = {-cosine, sine - 1};
    }
    if (angle_counts) angle_in_sectors = here.angle_rad() - begin.angle_rad();
  }
  if (angle_counts) {
    const double angle = sectors * (kPi / 2) + angle_in_sectors;
    turned.share = std::clamp(angle / std::abs(path.sweep_rad), 0.0, 1.0);
  }
  if (path.sweep_rad < 0) turned.sine = -turned.sine;
  return turned;
}

/// Returns the turn at `along`, for 0 < along < length.
inline Turned turned_at(const Path& path, double along) {
  return path.measure == Measure::vector ? turned_to_share(path, share_by_vector(path, along))
                                         : turned_by_longest_axis(path, along);
}

/// Returns the unit vector from the centre to the beginning. For a spiral that begins at its centre, it is
/// the direction in which the spiral leaves.
inline Point first_ray(const Path& path) {
  if (path.begin_radius_u > 0) return (path.begin - path.centre) / path.begin_radius_u;
  const SineCosine angle = sine_cosine(path.begin_angle_rad);
  return angle.cosine * path.abscissa + angle.sine * path.ordinate;
}

/// Returns a vector in the path's plane, rotated left by a right angle.
inline Point left_of(const Path& path, const Point& ray) {
  return ray.dot(path.abscissa) * path.ordinate - ray.dot(path.ordinate) * path.abscissa;
}

/// The calculation starts from the beginning of the arc, not from the centre, so that a short path on a large
/// circle loses no digits.
inline Point place_on_arc(const Path& path, const Turned& turned) {
  const Point out = path.begin - path.centre;
  Point place = path.begin + turned.cosine_less_1 * out + turned.sine * left_of(path, out);
  if (turned.share != 0) place += turned.share * path.rise;
  if (path.radius_slope_u_rad != 0) {
    const Point ray = first_ray(path);
    place += (growth_u(path) * turned.share) *
             ((1 + turned.cosine_less_1) * ray + turned.sine * left_of(path, ray));
  }
  return place;
}

}  // namespace understudy::motion
