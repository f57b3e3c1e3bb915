// A path is geometry in up to four axes over arc length, without time. The position along it comes from a
// profile (motion/profile.h). Several paths without a stop in between are a chain (motion/path_run.h).
//
//   line      ●────────────●           arc, circle, several turns      ╭──╮    helix: an arc while the
//             begin      end           in any plane, by centre,        │ ●╯    other axes go straight
//   spiral    an arc whose radius      radius or three points          ╰──     (rise)
//             grows linearly with the angle
//
// Units: one unit of length for all axes (pulses, 0.001 mm, ...): u. Angles in radians, counter-clockwise
// from the first axis of the plane towards its second. A path of no length is valid, and ends immediately.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace understudy::motion {

inline constexpr int kPathAxes = 4;

/// A place, in axis order (X, Y, Z, U or W). Axes that take no part are 0 or do not move. The type is
/// unaligned on purpose: a state is copied, compared and hashed as plain bytes.
using Point = Eigen::Matrix<double, kPathAxes, 1, Eigen::DontAlign>;

/// Two different axes of a plane, numbered 0..3: `first` is the abscissa, `second` the ordinate.
struct Plane {
  std::int8_t first = 0;
  std::int8_t second = 1;
  bool operator==(const Plane&) const = default;
};

enum class Turn : std::uint8_t { counter_clockwise, clockwise };

/// What to do with an arc whose end point is not on the circle about its centre.
enum class OffCircle : std::uint8_t {
  refuse,    // BadMotion(no_such_arc) if the radii differ by more than the tolerance, otherwise as blend
  blend,     // the radius changes linearly from one value to the other, so the end point is exact
  quadrant,  // as chips draw it: the arc stays on the circle and ends in the quadrant of the end point, where
             // it reaches the shorter of the end point's two coordinates (relative to the centre; the first
             // axis if they are equal). The path ends there, not at the end point. BadMotion(no_such_arc) if
             // the shorter coordinate exceeds the radius
};

/// How length is measured, which defines what a constant speed along the path means.
enum class Measure : std::uint8_t {
  vector,        // true length: constant vector speed
  longest_axis,  // as in chips: the length of the axis that moves most at each place. That axis has the
                 // commanded speed, and the vector speed is up to 1.414 times as high (two axes). For an arc,
                 // only its plane counts; a rise follows the angle. Not for oblique planes or spirals: if the
                 // radius changes by more than the tolerance, BadMotion(out_of_range)
};

/// One piece of a path, as a value. Only the functions below create paths.
struct Path {
  enum class Kind : std::uint8_t { line, arc };  // an arc with `radius_slope` != 0 is a spiral

  Kind kind = Kind::line;
  Measure measure = Measure::vector;
  Point begin = Point::Zero();
  Point end = Point::Zero();
  double length_u = 0;  // length by `measure`; >= 0

  // An arc: centre + radius(angle) * (cos(angle) * abscissa + sin(angle) * ordinate) + share * rise. The
  // angle goes from begin_angle to begin_angle + sweep. The share is the fraction of |sweep| done, from 0 to
  // 1.
  Point centre = Point::Zero();
  Point abscissa = Point::Zero();  // unit vectors of the plane, at right angles
  Point ordinate = Point::Zero();
  Point rise = Point::Zero();
  double begin_angle_rad = 0;
  double sweep_rad = 0;  // > 0 counter-clockwise
  double begin_radius_u = 0;
  double radius_slope_u_rad = 0;  // change of the radius per radian of |sweep|

  bool operator==(const Path&) const = default;

  /// Returns the place after `along_u` (clamped to 0..length_u; NaN is 0). It is exactly `begin` at 0 and
  /// `end` at length_u. In between, it is exact except for rounding errors: within 2e-15 of the largest
  /// coordinate, the radius and the length (if measured by the longest axis, also of the rise per radian). On
  /// a line that is measured by its longest axis, that axis is at a whole unit at each whole unit of length
  /// if it began at a whole unit.
  Point at(double along_u) const;
  /// Returns the unit vector of motion at `along_u` (the true geometry, independent of the measure), or zero
  /// for a path of no length.
  Point direction_at(double along_u) const;
};

/// Creates a straight path from `begin` to `end`, in all axes in which they differ. All functions that create
/// lines and arcs throw BadMotion(not_finite) for coordinates that are not finite, and
/// BadMotion(out_of_range) for coordinates beyond +-1e12.
Path line(const Point& begin, const Point& end, Measure measure = Measure::vector);

/// Options common to all arcs.
struct ArcOptions {
  Plane plane = {};
  Measure measure = Measure::vector;
  OffCircle off_circle = OffCircle::refuse;
  double radius_tolerance_u = 1e-6;  // for `refuse`: how much the two radii may differ
};

/// Creates an arc about `centre` (its coordinates in the plane count) from `begin` to `end`, in the direction
/// of `turn`. If `end` == `begin` in the plane, or the two are within 1e-9 rad of each other as seen from the
/// centre, the arc is a full circle, so rounding never decides between a whole turn and none. `more_turns` >=
/// 0 adds whole turns, up to 1e6 rad in all. The difference between `end` and `begin` outside the plane is
/// the rise, which makes a helix. A centre on `begin` or `end` throws BadMotion(no_such_arc).
Path arc_by_centre(const Point& begin, const Point& centre, const Point& end, Turn turn,
                   const ArcOptions& options = {}, std::int64_t more_turns = 0);

/// Creates an arc about `centre` through `sweep_rad` (> 0 counter-clockwise, any number of turns up to 1e6
/// rad), while the other axes move by `rise` (its part in the plane must be 0). With a sweep of 0, the path
/// is the line of `rise` alone. Whole quarter turns (a sweep as near to them as a double can be) end exactly
/// there.
Path arc_by_sweep(const Point& begin, const Point& centre, double sweep_rad,
                  const Point& rise = Point::Zero(), const ArcOptions& options = {});

/// Creates an arc of `radius_u` to `end`. A radius > 0 selects the arc of at most half a turn, a radius < 0
/// the longer one. If both are half a turn, the two signs mean the same, and `turn` decides the side of the
/// arc. The chord may exceed twice the radius by radius_tolerance_u, which results in a half circle. A longer
/// chord, `end` == `begin` in the plane, or a radius of 0 throws BadMotion(no_such_arc). The rise is as in
/// arc_by_centre.
Path arc_by_radius(const Point& begin, const Point& end, double radius_u, Turn turn,
                   const ArcOptions& options = {});

/// Creates the arc from `begin` through `middle` to `end`, in the plane of the options. The direction of the
/// turn follows from the points. Points on one line (a triangle lower than 1e-12 of its longest side) and
/// equal points throw BadMotion(no_such_arc). The rise is as in arc_by_centre.
Path arc_by_three_points(const Point& begin, const Point& middle, const Point& end,
                         const ArcOptions& options = {});

/// Like arc_by_three_points(), but in the plane of the three points, which may be oblique (all four axes
/// count).
Path arc_in_space(const Point& begin, const Point& middle, const Point& end);

/// Creates a spiral about `centre` through `sweep_rad`. Its radius changes by `growth_u_turn` per turn. A
/// radius that would become negative throws BadMotion(no_such_arc). The spiral may end at its centre, or
/// begin there; in that case it leaves along the first axis. A sweep of 0 is as in arc_by_sweep.
Path spiral(const Point& begin, const Point& centre, double sweep_rad, double growth_u_turn,
            const Point& rise = Point::Zero(), const ArcOptions& options = {});

/// Returns the deflection between the end of one path and the beginning of the next, in degrees 0..180; 0 is
/// straight on. If a path has no length, it has no direction, and the deflection is 0.
double corner_deg(const Path& first, const Path& next);

}  // namespace understudy::motion
