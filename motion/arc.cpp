// Functions that create lines and arcs: they check their arguments and compute the beginning, the centre and
// the sweep.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "motion/arc_length.h"
#include "motion/bad_motion.h"
#include "motion/elementary.h"
#include "motion/path.h"

namespace understudy::motion {

namespace {

constexpr double kFarthest_u = 1e12;

/// Directions from the centre that differ by less than this count as equal: if the end of a full circle is
/// off by rounding, it must not become an arc of no length.
constexpr double kSameDirection_rad = 1e-9;

/// Radii that differ by less than this fraction of the coordinates differ only by rounding.
constexpr double kRounding = 1e-15;

/// Three points are on one line if their triangle is lower than this fraction of its longest side.
constexpr double kFlatTriangle = 1e-12;

std::string text(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

[[noreturn]] void refuse(Refusal refusal, std::string_view law, const std::string& demand) {
  throw BadMotion(refusal, law, demand);
}

void require_near(double value, std::string_view law, std::string_view quantity) {
  require_finite(value, law, quantity);
  if (std::abs(value) > kFarthest_u) {
    refuse(Refusal::out_of_range, law,
           std::string(quantity) + " must be within +-1e12; it is " + text(value));
  }
}

void require_near(const Point& point, std::string_view law, std::string_view quantity) {
  for (const double coordinate : point) require_near(coordinate, law, quantity);
}

/// Two coordinates in a plane. Arcs are calculated relative to their beginning or centre, not to zero.
struct Flat {
  double x = 0;
  double y = 0;

  Flat operator-(const Flat& other) const { return {x - other.x, y - other.y}; }
  double square() const { return x * x + y * y; }
  double norm() const { return std::sqrt(square()); }
};

double cross(const Flat& a, const Flat& b) { return a.x * b.y - a.y * b.x; }
double dot(const Flat& a, const Flat& b) { return a.x * b.x + a.y * b.y; }

/// What all functions that create arcs have in common: the checked options, and the split into plane and
/// rise.
struct ArcDemand {
  std::string_view law;
  const ArcOptions& options;
  Point begin;

  ArcDemand(std::string_view name, const ArcOptions& given, const Point& from)
      : law(name), options(given), begin(from) {
    for (const int axis : {options.plane.first, options.plane.second}) {
      if (axis < 0 || axis >= kPathAxes) {
        refuse(Refusal::out_of_range, law, "axis of the plane must be 0..3; it is " + std::to_string(axis));
      }
    }
    if (options.plane.first == options.plane.second) {
      refuse(Refusal::out_of_range, law,
             "axes of the plane must be different; both are " + std::to_string(options.plane.first));
    }
    require_not_negative(options.radius_tolerance_u, law, "radius tolerance");
    require_near(begin, law, "begin");
  }

  Flat in_plane(const Point& point) const {
    return {point[options.plane.first], point[options.plane.second]};
  }

  /// Returns `point` with these coordinates in the plane.
  Point with(Point point, const Flat& in_plane_now) const {
    point[options.plane.first] = in_plane_now.x;
    point[options.plane.second] = in_plane_now.y;
    return point;
  }

  Point centre_at(const Flat& centre) const {
    require_near(centre.x, law, "centre");
    require_near(centre.y, law, "centre");
    return with(begin, centre);
  }

  Point rise_to(const Point& end) const { return with(end - begin, {0, 0}); }
};

/// Performs the final step for all arcs. The plane, beginning, centre, sweep and rise of `path` are already
/// set.
Path finished(Path path, double growth_u, const ArcDemand& demand) {
  const double sweep = std::abs(path.sweep_rad);
  if (sweep > kFarthestAngle_rad) {
    refuse(Refusal::out_of_range, demand.law,
           "sweep must be within +-1e6 rad; it is " + text(path.sweep_rad));
  }
  path.kind = Path::Kind::arc;
  path.measure = demand.options.measure;
  const Point out = path.begin - path.centre;
  path.begin_radius_u = out.norm();
  path.begin_angle_rad = angle_of(out.dot(path.ordinate), out.dot(path.abscissa));
  path.radius_slope_u_rad = growth_u / sweep;
  if (path.measure == Measure::vector) {
    path.length_u = length_by_vector(path);
    return path;
  }
  // A difference within the tolerance is blended in, because a true spiral of this kind has no closed form
  // for its length.
  if (std::abs(growth_u) > demand.options.radius_tolerance_u || path.begin_radius_u == 0) {
    refuse(Refusal::out_of_range, demand.law,
           "growth of the radius must be 0 if the longest axis is the measure; it is " + text(growth_u));
  }
  path.length_u = length_by_longest_axis(path);
  return path;
}

Path in_plane_of(const ArcDemand& demand, const Point& centre, double sweep_rad, const Point& rise) {
  Path path;
  path.begin = demand.begin;
  path.centre = centre;
  path.sweep_rad = sweep_rad;
  path.rise = rise;
  path.abscissa[demand.options.plane.first] = 1;
  path.ordinate[demand.options.plane.second] = 1;
  return path;
}

/// Sets the end of an arc from its sweep. Whole quarter turns are exact, so a circle ends exactly where it
/// began.
void set_end_by_sweep(Path& path) {
  Turned turned = turned_to_share(path, 1);
  const double quarters = std::nearbyint(path.sweep_rad / (kPi / 2));
  if (std::abs(path.sweep_rad - quarters * (kPi / 2)) <= 4e-16 * std::abs(path.sweep_rad)) {
    constexpr double kSines[] = {0, 1, 0, -1};
    const auto quarter = static_cast<std::int64_t>(quarters) & 3;
    turned.sine = kSines[quarter];
    turned.cosine_less_1 = kSines[(quarter + 1) & 3] - 1;
  }
  path.end = place_on_arc(path, turned);
}

/// Returns where the chip ends an arc whose end point is not on the circle (all relative to the centre).
Flat end_in_quadrant(const ArcDemand& demand, double radius_u, const Flat& end) {
  const bool x_is_shorter = std::abs(end.x) <= std::abs(end.y);
  const double shorter = std::abs(x_is_shorter ? end.x : end.y);
  if (shorter > radius_u) {
    refuse(Refusal::no_such_arc, demand.law,
           "shorter coordinate of the end must be within the radius " + text(radius_u) + "; it is " +
               text(shorter));
  }
  const double longer = std::sqrt((radius_u - shorter) * (radius_u + shorter));
  return x_is_shorter ? Flat{end.x, std::copysign(longer, end.y)} : Flat{std::copysign(longer, end.x), end.y};
}

/// Returns the sweep from one ray of a circle to another; it is > 0 for counter-clockwise. `chord` is the
/// difference of the rays, computed from the points themselves, because on a large circle it has more digits
/// than the rays.
double sweep_between(const Flat& from, const Flat& to, const Flat& chord, Turn turn) {
  const double min = angle_of(cross(from, chord), dot(from, to));
  const double whole = turn == Turn::clockwise ? -2 * kPi : 2 * kPi;
  const bool wrong_way = (min < 0) != (whole < 0);
  return wrong_way || std::abs(min) < kSameDirection_rad ? min + whole : min;
}

/// The circle through the origin and two points, and its sweep from the origin through `middle` to `end`.
struct CircleThrough {
  Flat centre;
  double sweep_rad = 0;
};

CircleThrough circle_through(const Flat& middle, const Flat& end, std::string_view law) {
  const Flat rest = end - middle;
  const double doubled_area = cross(middle, end);
  const double longest_square = std::max({middle.square(), end.square(), rest.square()});
  const double shortest_square = std::min({middle.square(), end.square(), rest.square()});
  if (shortest_square == 0)
    refuse(Refusal::no_such_arc, law, "three points must be different; two are the same");
  if (std::abs(doubled_area) <= kFlatTriangle * longest_square) {
    refuse(Refusal::no_such_arc, law,
           "three points must not be on one line; they are within " +
               text(std::abs(doubled_area) / std::sqrt(longest_square)) + " of one");
  }
  // The sweep is twice the deviation of the angle at `middle` from a straight angle. The centre is away from
  // the middle of the chord by half the chord's length times the cotangent of half the sweep. Both follow
  // from the same two numbers, so they match (and the arc meets its end) even if a flat triangle leaves few
  // digits.
  const double along = dot(middle, rest);
  const double sweep = 2 * angle_of(std::abs(doubled_area), along);
  const double side = along / (2 * doubled_area);
  return {{end.x / 2 - side * end.y, end.y / 2 + side * end.x}, doubled_area > 0 ? sweep : -sweep};
}

/// Creates an arc or a spiral about `centre` through a sweep.
Path swept(const ArcDemand& demand, const Point& centre, double sweep_rad, double growth_u_turn,
           const Point& rise) {
  const Flat middle = demand.in_plane(centre);
  const Point at_centre = demand.centre_at(middle);
  require_near(rise, demand.law, "rise");
  require_near(growth_u_turn, demand.law, "growth");
  require_finite(sweep_rad, demand.law, "sweep");
  const Flat in_plane = demand.in_plane(rise);
  if (in_plane.x != 0 || in_plane.y != 0) {
    refuse(Refusal::out_of_range, demand.law,
           "rise must be 0 in the plane; it is " + text(in_plane.x != 0 ? in_plane.x : in_plane.y));
  }
  if (sweep_rad == 0) return line(demand.begin, demand.begin + rise, demand.options.measure);

  Path path = in_plane_of(demand, at_centre, sweep_rad, rise);
  const double radius = (demand.begin - at_centre).norm();
  if (radius == 0 && growth_u_turn <= 0) {
    refuse(Refusal::no_such_arc, demand.law, "centre must differ from begin; it is on it");
  }
  double growth = growth_u_turn * (std::abs(sweep_rad) / (2 * kPi));
  if (radius + growth < 0) {
    // A spiral that should end at its centre ends exactly there.
    if (radius + growth < -kSameDirection_rad * radius) {
      refuse(Refusal::no_such_arc, demand.law,
             "radius must be 0 or above; it is " + text(radius + growth) + " at the end");
    }
    growth = -radius;
  }
  path = finished(path, growth, demand);
  set_end_by_sweep(path);
  require_near(path.end, demand.law, "end");
  return path;
}

}  // namespace

Path line(const Point& begin, const Point& end, Measure measure) {
  require_near(begin, "line", "begin");
  require_near(end, "line", "end");
  Path path;
  path.measure = measure;
  path.begin = begin;
  path.end = end;
  const Point travel = end - begin;
  const double longest = travel.cwiseAbs().maxCoeff();
  if (measure == Measure::longest_axis) {
    path.length_u = longest;
  } else {
    // The squares of the shortest distances would underflow to 0.
    path.length_u = longest < 1e-140 && longest > 0 ? longest * (travel / longest).norm() : travel.norm();
  }
  return path;
}

Path arc_by_centre(const Point& begin, const Point& centre, const Point& end, Turn turn,
                   const ArcOptions& options, std::int64_t more_turns) {
  const ArcDemand demand("arc_by_centre", options, begin);
  require_near(end, demand.law, "end");
  const Flat middle = demand.in_plane(centre);
  const Point at_centre = demand.centre_at(middle);
  if (more_turns < 0) {
    refuse(Refusal::negative, demand.law,
           "more turns must be 0 or above; it is " + std::to_string(more_turns));
  }
  if (static_cast<double>(more_turns) > kFarthestAngle_rad) {
    refuse(Refusal::out_of_range, demand.law,
           "more turns must be within 1e6 rad; it is " + std::to_string(more_turns));
  }

  const Flat from = demand.in_plane(begin) - middle;
  Flat to = demand.in_plane(end) - middle;
  const double radius = from.norm();
  const double end_radius = to.norm();
  if (radius == 0 || end_radius == 0) {
    refuse(Refusal::no_such_arc, demand.law,
           "centre must differ from begin and end; it is on " + std::string(radius == 0 ? "begin" : "end"));
  }
  Point met = end;
  double growth = end_radius - radius;
  // The rounding error of each difference from the centre is proportional to its larger operand.
  const double largest = std::max({radius, end_radius, std::abs(middle.x), std::abs(middle.y)});
  if (std::abs(growth) <= kRounding * largest) {
    growth = 0;
  } else if (options.off_circle == OffCircle::refuse && std::abs(growth) > options.radius_tolerance_u) {
    refuse(Refusal::no_such_arc, demand.law,
           "end must be on the circle of radius " + text(radius) + "; it is at " + text(end_radius));
  } else if (options.off_circle == OffCircle::quadrant) {
    growth = 0;
    to = end_in_quadrant(demand, radius, to);
    met = demand.with(end, {middle.x + to.x, middle.y + to.y});
  }
  const Flat chord = demand.in_plane(met) - demand.in_plane(begin);
  const double once = sweep_between(from, to, chord, turn);
  const double sweep = once + std::copysign(2 * kPi, once) * static_cast<double>(more_turns);
  Path path = in_plane_of(demand, at_centre, sweep, demand.rise_to(met));
  path.end = met;
  return finished(path, growth, demand);
}

Path arc_by_sweep(const Point& begin, const Point& centre, double sweep_rad, const Point& rise,
                  const ArcOptions& options) {
  return swept(ArcDemand("arc_by_sweep", options, begin), centre, sweep_rad, 0, rise);
}

Path spiral(const Point& begin, const Point& centre, double sweep_rad, double growth_u_turn,
            const Point& rise, const ArcOptions& options) {
  return swept(ArcDemand("spiral", options, begin), centre, sweep_rad, growth_u_turn, rise);
}

Path arc_by_radius(const Point& begin, const Point& end, double radius_u, Turn turn,
                   const ArcOptions& options) {
  const ArcDemand demand("arc_by_radius", options, begin);
  require_near(end, demand.law, "end");
  require_near(radius_u, demand.law, "radius");
  const Flat from = demand.in_plane(begin);
  const Flat chord = demand.in_plane(end) - from;
  const double half = chord.norm() / 2;
  const double radius = std::abs(radius_u);
  if (radius == 0) refuse(Refusal::no_such_arc, demand.law, "radius must not be 0; it is 0");
  if (half == 0)
    refuse(Refusal::no_such_arc, demand.law, "end must differ from begin in the plane; it is on it");
  if (2 * half > 2 * radius + options.radius_tolerance_u) {
    refuse(Refusal::no_such_arc, demand.law,
           "chord must be at most " + text(2 * radius) + ", twice the radius; it is " + text(2 * half));
  }
  // For the shorter counter-clockwise arc, the centre is `height` to the left of the chord.
  const double height = radius > half ? std::sqrt((radius - half) * (radius + half)) : 0;
  const bool left = (turn == Turn::counter_clockwise) == (radius_u > 0);
  const double side = (left ? height : -height) / (2 * half);
  const Flat centre = {from.x + chord.x / 2 - side * chord.y, from.y + chord.y / 2 + side * chord.x};
  const double shorter = 2 * angle_of(half, height);
  const double sweep = radius_u > 0 ? shorter : 2 * kPi - shorter;
  Path path = in_plane_of(demand, demand.centre_at(centre), turn == Turn::clockwise ? -sweep : sweep,
                          demand.rise_to(end));
  path.end = end;
  return finished(path, 0, demand);
}

Path arc_by_three_points(const Point& begin, const Point& middle, const Point& end,
                         const ArcOptions& options) {
  const ArcDemand demand("arc_by_three_points", options, begin);
  require_near(middle, demand.law, "middle");
  require_near(end, demand.law, "end");
  const Flat from = demand.in_plane(begin);
  const CircleThrough circle =
      circle_through(demand.in_plane(middle) - from, demand.in_plane(end) - from, demand.law);
  const Flat centre = {from.x + circle.centre.x, from.y + circle.centre.y};
  Path path = in_plane_of(demand, demand.centre_at(centre), circle.sweep_rad, demand.rise_to(end));
  path.end = end;
  return finished(path, 0, demand);
}

Path arc_in_space(const Point& begin, const Point& middle, const Point& end) {
  const ArcOptions options;
  const ArcDemand demand("arc_in_space", options, begin);
  require_near(middle, demand.law, "middle");
  require_near(end, demand.law, "end");
  const Point to_middle = middle - begin;
  const Point to_end = end - begin;
  if (to_middle.isZero(0) || to_end.isZero(0) || middle == end) {
    refuse(Refusal::no_such_arc, demand.law, "three points must be different; two are the same");
  }
  Path path;
  path.begin = begin;
  path.end = end;
  // The plane contains the three points, and its first axis points towards the end. If the points are nearly
  // on one line, one step does not make the axes perpendicular enough, but two steps do.
  path.abscissa = to_end / to_end.norm();
  const Point off_chord = to_middle - to_middle.dot(path.abscissa) * path.abscissa;
  if (off_chord.norm() <= kFlatTriangle * std::max(to_middle.norm(), to_end.norm())) {
    refuse(Refusal::no_such_arc, demand.law,
           "three points must not be on one line; they are within " + text(off_chord.norm()) + " of one");
  }
  path.ordinate = off_chord / off_chord.norm();
  path.ordinate -= path.ordinate.dot(path.abscissa) * path.abscissa;
  path.ordinate = -path.ordinate / path.ordinate.norm();  // begin, middle, end: counter-clockwise
  const Flat flat_middle = {to_middle.dot(path.abscissa), to_middle.dot(path.ordinate)};
  const CircleThrough circle = circle_through(flat_middle, {to_end.norm(), 0}, demand.law);
  path.centre = begin + circle.centre.x * path.abscissa + circle.centre.y * path.ordinate;
  require_near(path.centre, demand.law, "centre");
  path.sweep_rad = circle.sweep_rad;
  return finished(path, 0, demand);
}

}  // namespace understudy::motion
