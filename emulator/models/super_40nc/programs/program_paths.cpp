// The geometry of LIN and arcs in programs (《LIN 指令》, 《CW , CCW 指令》, 《C3P 指令》, 《CWR , CCWR
// 指令》).
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/programs/program_machine.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/requests.h"
#include "motion/bad_motion.h"
#include "motion/path.h"

namespace understudy::emulator::models::super_40nc {

using language::Area;
using language::Begun;

namespace {

constexpr int kModeLine = 0x61;
constexpr int kModeClockwise = 0x64;
constexpr int kModeCounterClockwise = 0x65;
/// An end point is accepted if it is at most this far off the circle.
constexpr double kOffCircleLu = 10;

}  // namespace

Begun ProgramMachine::begin_on_path(const std::array<bool, kAxisCount>& takes,
                                    const std::array<std::int64_t, kAxisCount>& target_lu, std::int32_t feed,
                                    int mode, const Geometry& geometry) {
  const bool joins = controls_.paths.joins_paths();
  if (joins && !controls_.paths.has_room_on_path(takes)) return Begun::taken;
  switch (joins ? Grant::starts : controls_.paths.ask_for_path(takes)) {
    case Grant::waits: return Begun::taken;
    case Grant::refused: return Begun::ignored;
    case Grant::nothing:
    case Grant::starts:
    case Grant::continues_if_same_kind:
    case Grant::new_speed:
    case Grant::stops: break;
  }
  motion::Point from = motion::Point::Zero();
  motion::Point to = motion::Point::Zero();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    if (!takes[n]) continue;
    const std::int64_t offset = state_of(axis).offset_lu;
    from[axis] = static_cast<double>(controls_.paths.path_base_lu(axis) - offset);
    to[axis] = static_cast<double>(target_lu[n] - offset);
  }
  const PathPlan plan{.path = geometry(from, to),
                      .takes = takes,
                      .target_lu = target_lu,
                      .feed_lu_per_s = feed,
                      .mode = mode};
  if (plan.path.length_u <= 0) {
    if (ground_.finishes_without_motion()) ground_.show_finished(kPathSignal);
    return Begun::done;
  }
  if (joins) {
    controls_.paths.join_path(plan);
    return Begun::runs;
  }
  return controls_.paths.begin_path(plan) ? Begun::runs : Begun::refused;
}

Begun ProgramMachine::begin(Area, const language::LinearMove& move) {
  std::array<bool, kAxisCount> takes{};
  std::array<std::int64_t, kAxisCount> targets{};
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    takes[n] = move.target_lu[n].has_value();
    const bool is_relative = move.targets == language::Targets::relative;
    targets[n] = move.target_lu[n].value_or(0) + (is_relative ? controls_.paths.path_base_lu(axis) : 0);
  }
  return begin_on_path(
      takes, targets, move.feed_lu_per_s, kModeLine,
      [](const motion::Point& from, const motion::Point& to) { return motion::line(from, to); });
}

/// The points of an arc in its plane, and the two axes of the plane.
struct ProgramMachine::ArcFrame {
  std::array<int, 2> axes;
  motion::ArcOptions options;
  std::array<bool, kAxisCount> takes{};
  std::array<std::int64_t, kAxisCount> end_lu{};
  std::array<std::int64_t, kAxisCount> base_lu{};
  std::array<std::int64_t, kAxisCount> offset_lu{};

  /// Converts a point in the plane to the machine coordinate.
  motion::Point place(const std::array<double, 2>& lu) const {
    motion::Point point = motion::Point::Zero();
    point[axes[0]] = lu[0];
    point[axes[1]] = lu[1];
    return point;
  }
};

ProgramMachine::ArcFrame ProgramMachine::frame_of(language::Plane plane, language::Targets targets,
                                                  const language::PlanePoint& end) const {
  ArcFrame frame;
  frame.axes = language::axes_of(plane);
  frame.options = {
      .plane = {static_cast<std::int8_t>(frame.axes[0]), static_cast<std::int8_t>(frame.axes[1])},
      .radius_tolerance_u = kOffCircleLu};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto n = static_cast<std::size_t>(frame.axes[i]);
    frame.takes[n] = true;
    frame.offset_lu[n] = state_of(frame.axes[i]).offset_lu;
    frame.base_lu[n] = controls_.paths.path_base_lu(frame.axes[i]);
    frame.end_lu[n] = target_of(frame, i, targets, end[i]);
  }
  return frame;
}

std::int64_t ProgramMachine::target_of(const ArcFrame& frame, std::size_t i, language::Targets targets,
                                       const std::optional<std::int32_t>& value) const {
  const std::int64_t base = frame.base_lu[static_cast<std::size_t>(frame.axes[i])];
  if (!value) return base;
  return *value + (targets == language::Targets::relative ? base : 0);
}

Begun ProgramMachine::begin_arc(const ArcFrame& frame, std::int32_t feed, int mode, bool reports,
                                const Geometry& geometry) {
  try {
    return begin_on_path(frame.takes, frame.end_lu, feed, mode, geometry);
  } catch (const motion::BadMotion&) {
    if (reports && chose(option("arc_off_circle", "a_line_to_the_end"))) {
      return begin_on_path(
          frame.takes, frame.end_lu, feed, kModeLine,
          [](const motion::Point& from, const motion::Point& to) { return motion::line(from, to); });
    }
    if (reports) ground_.report(Code::arc_impossible, Mover::c);
    return Begun::ignored;
  }
}

/// Returns the turn in a plane, which C24 to C26 can swap. Seen from the third axis, Z comes before X.
motion::Turn ProgramMachine::turn_of(language::Turn turn, language::Plane plane) const {
  const std::array<StoredRegister, 3> swaps{stored_d(d9::kSwapXy), stored_d(d9::kSwapXz),
                                            stored_d(d9::kSwapYz)};
  const bool is_seen_from_behind =
      plane == language::Plane::xz && chose(option("arc_axes", "seen_from_the_third_axis"));
  const bool is_swapped_by_parameter = !chose(option("plane_swap_registers", "none")) &&
                                       registers().is_on(swaps[static_cast<std::size_t>(plane)]);
  const bool is_swapped = is_swapped_by_parameter != is_seen_from_behind;
  const bool is_clockwise = (turn == language::Turn::clockwise) != is_swapped;
  return is_clockwise ? motion::Turn::clockwise : motion::Turn::counter_clockwise;
}

Begun ProgramMachine::begin(Area, const language::CentreArc& arc) {
  const ArcFrame frame = frame_of(arc.plane, arc.targets, arc.end_lu);
  const motion::Turn turn = turn_of(arc.turn, arc.plane);
  const int mode = turn == motion::Turn::clockwise ? kModeClockwise : kModeCounterClockwise;
  return begin_arc(frame, arc.feed_lu_per_s, mode, true,
                   [&](const motion::Point& from, const motion::Point& to) {
                     const motion::Point centre = from + frame.place({static_cast<double>(arc.centre_lu[0]),
                                                                      static_cast<double>(arc.centre_lu[1])});
                     return motion::arc_by_centre(from, centre, to, turn, frame.options);
                   });
}

Begun ProgramMachine::begin(Area, const language::PointArc& arc) {
  const bool is_absolute = chose(option("c3p_points", "absolute"));
  const language::Targets targets = is_absolute ? language::Targets::absolute : arc.targets;
  const ArcFrame frame = frame_of(arc.plane, targets, arc.end_lu);
  std::array<double, 2> through{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto n = static_cast<std::size_t>(frame.axes[i]);
    through[i] = static_cast<double>(target_of(frame, i, targets, arc.through_lu[i]) - frame.offset_lu[n]);
  }
  return begin_arc(frame, arc.feed_lu_per_s, kModeCounterClockwise, false,
                   [&](const motion::Point& from, const motion::Point& to) {
                     return motion::arc_by_three_points(from, frame.place(through), to, frame.options);
                   });
}

/// Returns the radius. Depending on a choice, a radius that is too small for its chord is replaced with that
/// of a half circle.
double ProgramMachine::radius_for(std::int32_t radius_lu, const motion::Point& from,
                                  const motion::Point& to) const {
  constexpr double kNoLess = 1 + 1e-12;  // at least half the chord, despite rounding
  const auto radius = static_cast<double>(radius_lu);
  const double min = (to - from).norm() / 2 * kNoLess;
  const bool widens = std::abs(radius) < min && chose(option("radius_too_small", "half_circle"));
  return widens ? std::copysign(min, radius) : radius;
}

Begun ProgramMachine::begin(Area, const language::RadiusArc& arc) {
  const ArcFrame frame = frame_of(arc.plane, arc.targets, arc.end_lu);
  const motion::Turn turn = turn_of(arc.turn, arc.plane);
  const int mode = turn == motion::Turn::clockwise ? kModeClockwise : kModeCounterClockwise;
  const bool goes_nowhere = frame.end_lu == frame.base_lu;
  motion::ArcOptions options = frame.options;
  options.radius_tolerance_u = 0;
  return begin_arc(
      frame, arc.feed_lu_per_s, mode, !goes_nowhere, [&](const motion::Point& from, const motion::Point& to) {
        return motion::arc_by_radius(from, to, radius_for(arc.radius_lu, from, to), turn, options);
      });
}

}  // namespace understudy::emulator::models::super_40nc
