// Random paths: tiny and huge, exactly on the axes and between them, a sliver of an arc and a thousand turns.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "motion/elementary.h"
#include "motion/path.h"

namespace understudy::motion {

/// Returns the seed, which UNDERSTUDY_SEED can set. It is printed with a failure.
inline std::uint64_t path_seed() {
  const char* given = std::getenv("UNDERSTUDY_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 20'240'611;
}

inline std::string code_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

inline std::string code_of(const Point& point) {
  std::string text = "Point(";
  for (int axis = 0; axis < kPathAxes; ++axis) text += (axis > 0 ? ", " : "") + code_of(point[axis]);
  return text + ")";
}

/// The arguments of one arc function, and the known properties of the arc.
struct ArcCase {
  enum class Maker { by_sweep, by_centre, by_radius, by_three_points, in_space, spiral };

  Maker maker = Maker::by_sweep;
  Point begin = Point::Zero();
  Point centre = Point::Zero();
  Point middle = Point::Zero();
  Point end = Point::Zero();
  Point rise = Point::Zero();
  double radius_u = 0;
  double sweep_rad = 0;
  double growth_u_turn = 0;
  std::int64_t more_turns = 0;
  ArcOptions options;

  Turn turn() const { return sweep_rad < 0 ? Turn::clockwise : Turn::counter_clockwise; }
  double signed_radius_u() const { return std::abs(sweep_rad) > kPi ? -radius_u : radius_u; }

  Path path() const {
    switch (maker) {
      case Maker::by_sweep: return arc_by_sweep(begin, centre, sweep_rad, rise, options);
      case Maker::by_centre: return arc_by_centre(begin, centre, end, turn(), options, more_turns);
      case Maker::by_radius: return arc_by_radius(begin, end, signed_radius_u(), turn(), options);
      case Maker::by_three_points: return arc_by_three_points(begin, middle, end, options);
      case Maker::in_space: return arc_in_space(begin, middle, end);
      default: return spiral(begin, centre, sweep_rad, growth_u_turn, rise, options);
    }
  }

  /// Returns the call as code to paste into a test.
  std::string code() const {
    const std::string turned = sweep_rad < 0 ? "Turn::clockwise" : "Turn::counter_clockwise";
    const char* off_circle = options.off_circle == OffCircle::blend ? "blend" : "refuse";
    const std::string last =
        ", {.plane = {" + std::to_string(options.plane.first) + ", " + std::to_string(options.plane.second) +
        "}, .measure = Measure::" + (options.measure == Measure::vector ? "vector" : "longest_axis") +
        ", .off_circle = OffCircle::" + off_circle +
        ", .radius_tolerance_u = " + code_of(options.radius_tolerance_u) + "}";
    const std::string from = "(" + code_of(begin) + ", ";
    switch (maker) {
      case Maker::by_sweep:
        return "arc_by_sweep" + from + code_of(centre) + ", " + code_of(sweep_rad) + ", " + code_of(rise) +
               last + ")";
      case Maker::by_centre:
        return "arc_by_centre" + from + code_of(centre) + ", " + code_of(end) + ", " + turned + last + ", " +
               std::to_string(more_turns) + ")";
      case Maker::by_radius:
        return "arc_by_radius" + from + code_of(end) + ", " + code_of(signed_radius_u()) + ", " + turned +
               last + ")";
      case Maker::by_three_points:
        return "arc_by_three_points" + from + code_of(middle) + ", " + code_of(end) + last + ")";
      case Maker::in_space: return "arc_in_space" + from + code_of(middle) + ", " + code_of(end) + ")";
      default:
        return "spiral" + from + code_of(centre) + ", " + code_of(sweep_rad) + ", " + code_of(growth_u_turn) +
               ", " + code_of(rise) + last + ")";
    }
  }
};

class RandomPaths {
 public:
  explicit RandomPaths(std::uint64_t seed) : random_(seed) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// Draws small numbers as often as large ones.
  double of_any_size(double low, double high) {
    return std::pow(10, within(std::log10(low), std::log10(high)));
  }

  ArcCase next(ArcCase::Maker maker) {
    ArcCase arc;
    arc.maker = maker;
    const auto first = static_cast<std::int8_t>(between(0, 3));
    arc.options.plane = {first, static_cast<std::int8_t>((first + between(1, 3)) % kPathAxes)};
    arc.radius_u =
        between(0, 1) == 0 ? 1000.0 * static_cast<double>(between(1, 100)) : of_any_size(1e-3, 1e9);
    for (double& coordinate : arc.centre)
      coordinate = between(0, 2) == 0 ? 0 : within(-10, 10) * arc.radius_u;
    // The limits keep the points precise enough to determine the arguments: see the comment of each function.
    switch (maker) {
      case ArcCase::Maker::by_centre: arc.sweep_rad = sweep(1e-6, 6000); break;  // 1e-9 would be a whole turn
      case ArcCase::Maker::by_radius: arc.sweep_rad = sweep(1e-6, 6.28); break;
      case ArcCase::Maker::by_three_points:
      case ArcCase::Maker::in_space: arc.sweep_rad = sweep(1e-3, 6.28); break;  // flatter is near a line
      default: arc.sweep_rad = sweep(1e-12, 6300);
    }
    const double angle =
        between(0, 3) == 0 ? static_cast<double>(between(-4, 4)) * (kPi / 4) : within(-3.2, 3.2);
    double end_radius = arc.radius_u;
    if (maker == ArcCase::Maker::spiral || (maker == ArcCase::Maker::by_centre && between(0, 1) == 0)) {
      end_radius *= between(0, 2) == 0 ? 1 + of_any_size(1e-15, 1e-3) : within(0.01, 3);
      arc.options.off_circle = OffCircle::blend;
    }
    arc.growth_u_turn = (end_radius - arc.radius_u) / (std::abs(arc.sweep_rad) / (2 * kPi));
    if (maker == ArcCase::Maker::spiral && std::abs(arc.growth_u_turn) > 1e12)
      arc.growth_u_turn = arc.radius_u;
    arc.begin = on_ray(arc, arc.radius_u, angle);
    arc.middle = on_ray(arc, arc.radius_u, angle + arc.sweep_rad * within(0.3, 0.7));
    arc.end = on_ray(arc, end_radius, angle + arc.sweep_rad);
    // Less than 1e-9 rad is left, which is a whole turn for arc_by_centre.
    arc.more_turns = static_cast<std::int64_t>(std::ceil(std::abs(arc.sweep_rad) / (2 * kPi) - 1e-10)) - 1;
    // Coordinates are rounded, and so are radii.
    arc.options.radius_tolerance_u = 1e-6 + 1e-13 * arc.radius_u;
    if (between(0, 2) == 0) add_rise(arc);
    const bool plain = maker != ArcCase::Maker::spiral && arc.options.off_circle == OffCircle::refuse &&
                       maker != ArcCase::Maker::in_space;
    if (plain && between(0, 1) == 0) arc.options.measure = Measure::longest_axis;
    return arc;
  }

 private:
  double sweep(double min, double max) {
    const double sign = between(0, 1) == 0 ? 1 : -1;
    const std::int64_t kind = between(0, 3);
    if (kind == 0) return sign * of_any_size(min, max);
    if (kind == 1) {
      const auto quarters = static_cast<std::int64_t>(std::min(max / (kPi / 2), 4000.0));
      return sign * static_cast<double>(between(1, quarters)) * (kPi / 2);
    }
    return sign * within(0.01, std::min(max, 20.0));
  }
  Point on_ray(const ArcCase& arc, double radius, double angle) const {
    Point point = arc.centre;
    point[arc.options.plane.first] += radius * std::cos(angle);
    point[arc.options.plane.second] += radius * std::sin(angle);
    return point;
  }
  void add_rise(ArcCase& arc) {
    if (arc.maker == ArcCase::Maker::in_space) {
      // Tilting the plane keeps the circle: exchange a part of one axis for one outside the plane.
      const double part = within(0, 1);
      const double rest = std::sqrt(1 - part * part);
      const int into = other_axis(arc.options.plane);
      for (Point* point : {&arc.begin, &arc.middle, &arc.end}) {
        const double off = (*point)[arc.options.plane.first] - arc.centre[arc.options.plane.first];
        (*point)[arc.options.plane.first] = arc.centre[arc.options.plane.first] + rest * off;
        (*point)[into] += part * off;
      }
      return;
    }
    arc.rise[other_axis(arc.options.plane)] = within(-3, 3) * arc.radius_u;
    arc.end += arc.rise;
  }
  int other_axis(const Plane& plane) {
    int axis = static_cast<int>(between(0, 3));
    while (axis == plane.first || axis == plane.second) axis = (axis + 1) % kPathAxes;
    return axis;
  }

  std::mt19937_64 random_;
};

}  // namespace understudy::motion
