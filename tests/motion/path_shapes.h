// Shapes with their own geometry, with which a run along paths is compared. They find how far along a shape a
// position is. This file uses nothing of motion/path.h except the Path for the run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "motion/path_run.h"

namespace understudy::motion {

inline Point place_of(double x, double y, double z = 0, double w = 0) { return Point(x, y, z, w); }

inline std::string number_as_code(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

inline std::string place_as_code(const Point& place) {
  std::string text = "place_of(";
  for (int i = 0; i < kPathAxes; ++i) text += (i > 0 ? ", " : "") + number_as_code(place[i]);
  return text + ")";
}

/// A straight line, or an arc of less than a turn in X and Y that may rise in Z.
struct Shape {
  bool straight = true;
  Point begin = Point::Zero();
  Point end = Point::Zero();  // for an arc, as in the path
  Point centre = Point::Zero();
  double sweep_rad = 0;
  double rise_u = 0;

  static Shape line_to(const Point& from, const Point& to) { return {.begin = from, .end = to}; }
  static Shape arc(const Point& from, const Point& centre, double sweep_rad, double rise_u = 0) {
    if (sweep_rad == 0) return line_to(from, from + place_of(0, 0, rise_u));
    Shape shape{.straight = false, .begin = from, .centre = centre, .sweep_rad = sweep_rad, .rise_u = rise_u};
    shape.end = shape.path().end;
    return shape;
  }

  Path path() const {
    if (straight) return line(begin, end);
    return arc_by_sweep(begin, centre, sweep_rad, place_of(0, 0, rise_u));
  }
  std::string code() const {
    const std::string from = place_as_code(begin) + ", ";
    if (straight) return "line(" + from + place_as_code(end) + ")";
    return "arc_by_sweep(" + from + place_as_code(centre) + ", " + number_as_code(sweep_rad) +
           ", place_of(0, 0, " + number_as_code(rise_u) + "))";
  }

  double radius_u() const { return std::hypot(begin[0] - centre[0], begin[1] - centre[1]); }
  double length_u() const {
    return straight ? (end - begin).norm() : std::hypot(radius_u() * sweep_rad, rise_u);
  }

  /// Returns the fraction of the shape, 0 to 1, nearest to a place.
  double share_at(const Point& place) const {
    const double length = length_u();
    if (length == 0) return 0;
    if (straight) return std::clamp((place - begin).dot(end - begin) / (length * length), 0.0, 1.0);
    const double from = std::atan2(begin[1] - centre[1], begin[0] - centre[0]);
    const double here = std::atan2(place[1] - centre[1], place[0] - centre[0]);
    const double turn = 2 * std::numbers::pi;
    double turned = std::fmod((here - from) * (sweep_rad < 0 ? -1 : 1), turn);
    if (turned < 0) turned += turn;
    // The rest of the turn is halved: each half is nearer to one end.
    const double sweep = std::abs(sweep_rad);
    if (turned > sweep + (turn - sweep) / 2) turned -= turn;
    return std::clamp(turned / sweep, 0.0, 1.0);
  }
  Point ideal(double share) const {
    if (straight) return begin + (end - begin) * share;
    const double from = std::atan2(begin[1] - centre[1], begin[0] - centre[0]);
    const double angle = from + sweep_rad * share;
    return place_of(centre[0] + radius_u() * std::cos(angle), centre[1] + radius_u() * std::sin(angle),
                    begin[2] + rise_u * share, begin[3]);
  }
  double distance_u(const Point& place) const { return (place - ideal(share_at(place))).norm(); }
};

/// Compares a run's steps with the shapes that were appended to it.
struct Walk {
  std::vector<Shape> shapes{};
  std::size_t done = 0;      // shapes completed
  double done_length_u = 0;  // their length
  double along_u = 0;        // the total
  double off_u = 0;          // the largest distance from the shapes so far
  double speed_u_s = 0;      // mean speed of the last tick
  double speed_before_u_s = 0;
  Point place = Point::Zero();

  void step(PathRun& run, Tick tick) {
    place = run.step(tick);
    for (int i = 0; i < run.completed(); ++i) done_length_u += shapes[done++].length_u();
    const double before = along_u;
    along_u = done_length_u;
    if (done < shapes.size()) {
      along_u += shapes[done].length_u() * shapes[done].share_at(place);
      off_u = std::max(off_u, shapes[done].distance_u(place));
    } else if (!shapes.empty()) {
      off_u = std::max(off_u, (place - shapes.back().end).norm());
    }
    speed_before_u_s = speed_u_s;
    speed_u_s = (along_u - before) * kTicksPerSecond;
  }
};

/// Returns the time from rest to rest with the acceleration `a`: L/v + v/a, or 2 sqrt(L/a) if v is not
/// reached.
inline double trapezoid_s(double length_u, double top_u_s, double slope_u_s2) {
  if (length_u < top_u_s * top_u_s / slope_u_s2) return 2 * std::sqrt(length_u / slope_u_s2);
  return length_u / top_u_s + top_u_s / slope_u_s2;
}

inline SpeedLaw by_slope(double top_u_s, double slope_u_s2) {
  return {
      .top_speed_u_s = top_u_s, .up = RampLaw::by_slope(slope_u_s2), .down = RampLaw::by_slope(slope_u_s2)};
}

/// Steps until nothing is left. Returns the last tick, or -1 if that takes more than `max` ticks.
inline Tick finish(PathRun& run, Tick after, Tick max = 1'000'000) {
  for (Tick tick = after + 1; tick <= after + max; ++tick) {
    run.step(tick);
    if (run.queued() == 0) return tick;
  }
  return -1;
}

inline constexpr Joint kStop{};
inline constexpr Joint kJoin{.rule = Joint::Rule::join};
constexpr Joint join_below(double corner) { return {.rule = Joint::Rule::join_below, .corner_deg = corner}; }

}  // namespace understudy::motion
