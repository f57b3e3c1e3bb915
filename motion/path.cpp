#include "motion/path.h"

#include <algorithm>
#include <cmath>

#include "motion/arc_length.h"
#include "motion/elementary.h"

namespace understudy::motion {

namespace {

/// Returns the direction of a vector, or zero for the zero vector. The vector is scaled first, because the
/// square of 1e-200 would be 0.
Point direction_of(const Point& travel) {
  const double largest = travel.cwiseAbs().maxCoeff();
  if (largest == 0) return Point::Zero();
  const Point scaled = travel / largest;
  return scaled / scaled.norm();
}

}  // namespace

Point Path::at(double along_u) const {
  if (!(along_u > 0)) return begin;
  if (along_u >= length_u) return end;
  if (kind == Kind::arc) return place_on_arc(*this, turned_at(*this, along_u));
  // Multiply before dividing, so that at a whole pulse of the longest axis, that axis is at a whole pulse.
  // The bounds prevent the last bits of a very uneven sum from passing the end.
  const Point place = begin + (end - begin) * along_u / length_u;
  return place.cwiseMax(begin.cwiseMin(end)).cwiseMin(begin.cwiseMax(end));
}

Point Path::direction_at(double along_u) const {
  if (length_u == 0) return Point::Zero();
  if (kind == Kind::line) return direction_of(end - begin);
  Turned turned;
  if (along_u >= length_u) {
    turned = turned_to_share(*this, 1);
  } else if (along_u > 0) {
    turned = turned_at(*this, along_u);
  }
  const Point ray = first_ray(*this);
  const Point left = left_of(*this, ray);
  const double cosine = 1 + turned.cosine_less_1;
  const double growth = growth_u(*this);
  const double radius = std::max(0.0, begin_radius_u + growth * turned.share);
  return direction_of(sweep_rad * radius * (cosine * left - turned.sine * ray) +
                      growth * (cosine * ray + turned.sine * left) + rise);
}

double corner_deg(const Path& first, const Path& next) {
  const Point before = first.direction_at(first.length_u);
  const Point after = next.direction_at(0);
  if (before.isZero(0) || after.isZero(0)) return 0;
  // Kahan's form: exact both for small angles and for angles near a half turn.
  return 2 * angle_of((before - after).norm(), (before + after).norm()) * (180 / kPi);
}

}  // namespace understudy::motion
