// RS-M8194H: the path commands (7.2, 7.4) as rows, with what each of them draws.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "motion/elementary.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

using lang::Verb;
using motion::Turn;

enum class Draws : std::uint8_t { line, arc, circle, mixed, rectangle, helix };

struct PathRow {
  Verb verb;
  Paths::Runs runs;
  Draws draws;
  int dimensions;
  bool absolute;
  Turn turn;      // direction of arcs and circles
  Stream stream;  // the kind of stream
};
inline constexpr auto kCw = Turn::clockwise;
inline constexpr auto kCcw = Turn::counter_clockwise;
inline constexpr PathRow kPathRows[] = {
    {Verb::line_2d, Paths::Runs::single, Draws::line, 2, false, kCw, {}},
    {Verb::line_3d, Paths::Runs::single, Draws::line, 3, false, kCw, {}},
    {Verb::arc_cw, Paths::Runs::single, Draws::arc, 2, false, kCw, {}},
    {Verb::arc_ccw, Paths::Runs::single, Draws::arc, 2, false, kCcw, {}},
    {Verb::circle_cw, Paths::Runs::single, Draws::circle, 2, false, kCw, {}},
    {Verb::circle_ccw, Paths::Runs::single, Draws::circle, 2, false, kCcw, {}},
    {Verb::abs_line_2d, Paths::Runs::single, Draws::line, 2, true, kCw, {}},
    {Verb::abs_line_3d, Paths::Runs::single, Draws::line, 3, true, kCw, {}},
    {Verb::abs_arc_cw, Paths::Runs::single, Draws::arc, 2, true, kCw, {}},
    {Verb::abs_arc_ccw, Paths::Runs::single, Draws::arc, 2, true, kCcw, {}},
    {Verb::line_2d_continue, Paths::Runs::stream, Draws::line, 2, false, kCw, Stream::line_2d},
    {Verb::abs_line_2d_continue, Paths::Runs::stream, Draws::line, 2, true, kCw, Stream::line_2d},
    {Verb::line_3d_continue, Paths::Runs::stream, Draws::line, 3, false, kCw, Stream::line_3d},
    {Verb::abs_line_3d_continue, Paths::Runs::stream, Draws::line, 3, true, kCw, Stream::line_3d},
    {Verb::mix_2d_continue, Paths::Runs::stream, Draws::mixed, 2, false, kCw, Stream::mix_2d},
    {Verb::abs_mix_2d_continue, Paths::Runs::stream, Draws::mixed, 2, true, kCw, Stream::mix_2d},
    {Verb::rectangle, Paths::Runs::rectangle, Draws::rectangle, 2, false, kCw, {}},
    {Verb::helix_3d, Paths::Runs::helix, Draws::helix, 3, false, kCw, {}},
};

inline const PathRow& row_of_path(Verb verb) {
  return *std::find_if(std::begin(kPathRows), std::end(kPathRows),
                       [&](const PathRow& row) { return row.verb == verb; });
}

/// The shapes of VECTOR_SPEED 0 to 11 (7.2.2).
inline constexpr std::array<Shape, 12> kVectorShapes{{
    {.constant = true},
    {},
    {.s_curve = true},
    {.unlike_ramps = true},
    {.s_curve = true, .unlike_ramps = true},
    {},
    {.unlike_ramps = true},
    {.constant = true},
    {},
    {.s_curve = true},
    {.unlike_ramps = true},
    {.s_curve = true, .unlike_ramps = true},
}};
/// The highest MAX_V for interpolation (3.4), by the number of axes.
inline constexpr std::uint32_t kHighest[] = {2'828'854, 2'309'468};
inline constexpr std::uint32_t kHighestOfOneAxis = 4'000'000;

/// The segment kinds that nType selects in MIX_2D_CONTINUE.
struct MixRow {
  Draws draws;
  Turn turn;
};
inline constexpr MixRow kMixRows[] = {
    {Draws::line, kCw}, {Draws::arc, kCw}, {Draws::arc, kCcw}, {Draws::circle, kCw}, {Draws::circle, kCcw}};

/// Returns true if a mode matches the number of axes and the kind of path (lines or arcs). Modes 0 and 7
/// match both kinds.
inline bool fits_mode(std::uint8_t mode, int dimensions, Draws draws) {
  if ((mode < 7) != (dimensions == 2)) return false;
  if (mode == 0 || mode == 7) return true;
  return (mode == 5 || mode == 6) == (draws != Draws::line);
}

inline std::array<std::uint8_t, 3> codes_at(const lang::Command& command, std::size_t count) {
  std::array<std::uint8_t, 3> codes{};
  for (std::size_t i = 0; i < count; ++i) codes[i] = static_cast<std::uint8_t>(command.values[i]);
  return codes;
}

inline bool is_one_each(const std::array<std::uint8_t, 3>& codes, int dimensions) {
  int axes = 0;
  AxisMask seen = 0;
  for (int i = 0; i < dimensions; ++i) {
    const std::uint8_t code = codes[static_cast<std::size_t>(i)];
    if (axis_of_code(code) < 0 || (seen & code) != 0) return false;
    seen |= code;
    ++axes;
  }
  return axes == dimensions;
}

inline constexpr motion::ArcOptions kArcOptions{.plane = {0, 1}, .off_circle = motion::OffCircle::quadrant};

}  // namespace understudy::emulator::models::rs_m8194h
