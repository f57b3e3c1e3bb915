// Interpolation: lines, arcs, streams, rectangle, helix (7.2, 7.4). What a command draws is a row; the path
// itself is motion's.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/device.h"
#include "emulator/models/rs_m8194h/meetings.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/paths.h"
#include "emulator/models/rs_m8194h/rectangle.h"
#include "emulator/models/rs_m8194h/state.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/elementary.h"
#include "motion/move.h"
#include "motion/path.h"
#include "motion/path_run.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

using lang::Verb;
using motion::Path;
using motion::Point;
using motion::Turn;

enum class Draws : std::uint8_t { line, arc, circle, mixed, rectangle, helix };

struct PathRow {
  Verb verb;
  Paths::Runs runs;
  Draws draws;
  int dimensions;
  bool absolute;
  Turn turn;      // of arcs and circles
  Stream stream;  // of streams
};
constexpr auto kCw = Turn::clockwise;
constexpr auto kCcw = Turn::counter_clockwise;
constexpr PathRow kPathRows[] = {
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

const PathRow& row_of_path(Verb verb) {
  return *std::find_if(std::begin(kPathRows), std::end(kPathRows),
                       [&](const PathRow& row) { return row.verb == verb; });
}

/// VECTOR_SPEED (7.2.2).
constexpr std::array<Shape, 12> kVectorShapes{{
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
/// MAX_V of interpolation (3.4), by the number of axes.
constexpr std::uint32_t kHighest[] = {2'828'854, 2'309'468};

/// nType of MIX_2D_CONTINUE.
struct MixRow {
  Draws draws;
  Turn turn;
};
constexpr MixRow kMixRows[] = {
    {Draws::line, kCw}, {Draws::arc, kCw}, {Draws::arc, kCcw}, {Draws::circle, kCw}, {Draws::circle, kCcw}};

/// What a mode is for: the number of axes, and whether lines or arcs; 0 and 7 are for all.
bool fits_mode(std::uint8_t mode, int dimensions, Draws draws) {
  if ((mode < 7) != (dimensions == 2)) return false;
  if (mode == 0 || mode == 7) return true;
  return (mode == 5 || mode == 6) == (draws != Draws::line);
}

std::array<std::uint8_t, 3> codes_at(const lang::Command& command, std::size_t count) {
  std::array<std::uint8_t, 3> codes{};
  for (std::size_t i = 0; i < count; ++i) codes[i] = static_cast<std::uint8_t>(command.values[i]);
  return codes;
}

bool is_one_each(const std::array<std::uint8_t, 3>& codes, int dimensions) {
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

constexpr motion::ArcOptions kArcOptions{.plane = {0, 1}, .off_circle = motion::OffCircle::quadrant};

}  // namespace

bool is_path(const lang::Command& command) {
  return std::any_of(std::begin(kPathRows), std::end(kPathRows),
                     [&](const PathRow& row) { return row.verb == command.verb(); }) &&
         lang::find_code(command.code) != nullptr;
}

/// What follow_path() needs to draw.
struct PathDrawing {
  motion::PathRun run;
  std::array<double, 4> end{};
  double length = 0;

  Point at() const { return {end[0], end[1], end[2], end[3]}; }
  void add(const Path& path, Tick now) {
    run.append(path, {.rule = motion::Joint::Rule::join}, now);
    length += path.length_u;
    for (Eigen::Index i = 0; i < motion::kPathAxes; ++i) end[static_cast<std::size_t>(i)] = path.end[i];
  }
};

/// The axes that a path is on, in their order.
std::array<std::uint8_t, 3> RsM8194h::codes_of_path(const lang::Command& command) const {
  const PathRow& row = row_of_path(command.verb());
  std::array<std::uint8_t, 3> codes = state_.paths.assigned;
  const StreamSettings& settings = state_.paths.streams[static_cast<std::size_t>(row.stream)];
  if (row.runs == Paths::Runs::stream && settings.given) codes = settings.axes;
  if (row.runs == Paths::Runs::rectangle) codes = codes_at(command, 2);
  if (row.runs == Paths::Runs::helix) codes = codes_at(command, 3);
  return codes;
}

bool RsM8194h::streams_need_initial() const {
  return chose(option("continue_without_initial", "void_with_module_error"));
}

AxisMask RsM8194h::axes_of_path(const lang::Command& command) const {
  std::array<std::uint8_t, 3> codes = codes_of_path(command);
  if (row_of_path(command.verb()).dimensions == 2) codes[2] = 0;
  return mask_of_codes(codes);
}

/// A limit that is active before a path begins, or a soft limit that is reached, keeps it from beginning, as
/// it keeps the drive of an axis: the bit is that of the axis which would have set out against it.
bool RsM8194h::keeps_path_off(const std::array<std::uint8_t, 3>& codes, const motion::Point& way) {
  bool is_kept = false;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::int8_t a = axis_of_code(codes[i]);
    const double along = way[static_cast<Eigen::Index>(i)];
    constexpr double kRounding = 1e-9;
    if (a < 0 || std::abs(along) < kRounding) continue;
    const auto axis = static_cast<std::size_t>(a);
    const int sense = along < 0 ? -1 : +1;
    motion::Cause why = state_.motors[axis].forbidden(sense);
    if (why == motion::Cause::none) {
      why = soft_limit_by_encoder(state_.units[axis], state_.motors[axis], sense);
    }
    if (why == motion::Cause::none) continue;
    state_.units[axis].error_code |= error_of(why);
    is_kept = true;
  }
  return is_kept;
}

void RsM8194h::module_error() { state_.rint |= bit_of(Rint::module); }

/// One segment is loaded ahead of the one that runs; what ends within the coming tick has to have its
/// successors in time.
bool RsM8194h::has_room_for_segment() const {
  const motion::PathRun& run = state_.paths.together.run;
  if (run.full()) return false;
  if (chose(option("stream_lookahead", "30"))) return true;
  return run.queued() < 2 || run.queued_after(now() + 1) == 0;
}

Took RsM8194h::follow_path(const lang::Command& command) {
  const PathRow& row = row_of_path(command.verb());
  Paths& paths = state_.paths;
  const bool is_stream = row.runs == Paths::Runs::stream;
  const StreamSettings& settings = paths.streams[static_cast<std::size_t>(row.stream)];
  const std::array<std::uint8_t, 3> codes = codes_of_path(command);
  const bool is_unfit = row.runs == Paths::Runs::single && chose(option("unfit_profile", "void")) &&
                        !fits_mode(paths.vector.mode, row.dimensions, row.draws);
  const bool has_no_initial = is_stream && !settings.given && streams_need_initial();
  if (has_no_initial || is_unfit || !is_one_each(codes, row.dimensions)) {
    module_error();
    return Took::done;
  }
  const bool joins = is_stream && paths.together.engaged && paths.runs == Paths::Runs::stream &&
                     paths.stream == row.stream && paths.open;
  if (joins && (paths.together.slowing_for != motion::Cause::none || !has_room_for_segment())) {
    return Took::waits;
  }
  const AxisMask axes = axes_of_path(command);
  if (!joins) {
    const Start outcome = may_start(axes, Starter::command);
    if (outcome == Start::is_void) {
      note_obstacles(axes);
      return Took::done;
    }
    // There is one path at a time, whatever its axes.
    if (outcome == Start::waits || paths.together.engaged) return Took::waits;
    const bool has_no_speed = row.runs == Paths::Runs::single && paths.vector.drive_pps == 0;
    if (has_no_speed && machine_.zero_speeds_drive_nothing) return Took::done;
    if (outcome == Start::is_held && waits_behind_held(axes)) return Took::waits;
    if (outcome == Start::is_held) {
      for (std::size_t a = 0; a < kAxes; ++a) {
        if (has(axes, a)) state_.units[a].held_drive = {};
      }
      state_.held_paths.assign(1, command);
      return Took::done;
    }
  }
  try {
    draw(command, codes, joins);
  } catch (const motion::BadMotion&) {
    module_error();  // no such arc, for example
  }
  return Took::done;
}

void RsM8194h::draw(const lang::Command& command, const std::array<std::uint8_t, 3>& codes, bool joins) {
  const PathRow& row = row_of_path(command.verb());
  Paths& paths = state_.paths;
  const bool is_stream = row.runs == Paths::Runs::stream;
  const auto max_v_of = [&](std::size_t coordinate) {
    return state_.units[static_cast<std::size_t>(axis_of_code(codes[coordinate]))].basic.max_v;
  };
  std::uint32_t max_v = max_v_of(0);
  for (int i = 1; i < row.dimensions && chose(option("vector_max_v", "the_least")); ++i) {
    max_v = std::min(max_v, max_v_of(static_cast<std::size_t>(i)));
  }
  const SpeedRange range = speed_range(max_v, machine_.speed, kHighest[row.dimensions - 2]);
  const auto number = [&](std::size_t i) { return static_cast<double>(command.signed_value(i)); };
  const Tick now_tick = now();

  PathDrawing drawing;
  if (joins) {
    drawing.run = paths.together.run;
    drawing.end = paths.end;
  }
  const Point begin = drawing.at();
  // The place of a coordinate that a command gives, in pulses from where the run began.
  const auto place = [&](std::size_t coordinate, double value) {
    if (!row.absolute) return begin[static_cast<Eigen::Index>(coordinate)] + value;
    const auto a = static_cast<std::size_t>(axis_of_code(codes[coordinate]));
    const double here = begin[static_cast<Eigen::Index>(coordinate)];
    const std::int64_t travel =
        joins ? paths.together.travel_at(coordinate, here) : state_.motors[a].travel_pulses;
    return here + value - static_cast<double>(static_cast<std::int32_t>(state_.units[a].absolute.at(travel)));
  };
  const auto point = [&](std::size_t first_value) {
    Point made = begin;
    for (int i = 0; i < row.dimensions; ++i) {
      made[i] = place(static_cast<std::size_t>(i), number(first_value + static_cast<std::size_t>(i)));
    }
    return made;
  };

  SpeedSettings speed = paths.vector;
  Shape shape = kVectorShapes[paths.vector.mode];
  bool is_last = true;
  Draws draws = row.draws;
  Turn turn = row.turn;
  std::size_t first_value = 0;
  if (is_stream) {
    const StreamSettings& settings = paths.streams[static_cast<std::size_t>(row.stream)];
    is_last = command.values[0] == 1;
    first_value = 1;
    if (draws == Draws::mixed) {
      const MixRow& mix = kMixRows[command.values[1] - 1];
      draws = mix.draws;
      turn = mix.turn;
      first_value = draws == Draws::line ? 4 : 2;
    }
    if (settings.given) {
      speed = {.start_pps = settings.start_pps,
               .drive_pps = settings.drive_pps,
               .acceleration = settings.acceleration,
               .offset_pulses = 0};
      shape = {.constant = settings.constant};
    } else {
      shape = {.constant = paths.vector.mode == 0 || paths.vector.mode == 7};
    }
  }
  motion::ArcOptions arc_options = kArcOptions;
  if (chose(option("arc_end_off_circle", "ends_at_its_end")))
    arc_options.off_circle = motion::OffCircle::blend;
  double speed_factor = 1;
  switch (draws) {
    case Draws::line: drawing.add(motion::line(begin, point(first_value)), now_tick); break;
    case Draws::arc:
      shape.s_curve = false;
      drawing.add(motion::arc_by_centre(begin, point(first_value), point(first_value + 2), turn, arc_options),
                  now_tick);
      break;
    case Draws::circle:
      shape.s_curve = false;
      drawing.add(motion::arc_by_centre(begin, point(first_value), begin, turn, kArcOptions), now_tick);
      break;
    case Draws::rectangle: {
      const bool is_clockwise = command.values[4] == 1;
      const RectanglePlan plan =
          rectangle_plan(number(5), number(6), std::min({number(7), number(5) / 2, number(6) / 2}));
      const std::size_t start_point = command.values[3];
      const bool counts_back = chose(option("rectangle_start_points", "clockwise_from_the_left_side"));
      const bool at_middles = chose(option("rectangle_start_points", "middles_from_the_lower_side"));
      const std::size_t from =
          at_middles ? 2 * start_point + 1 : 2 * (counts_back ? 7 - start_point : start_point);
      const auto at = [&](std::size_t i) {
        return Point{plan.points[i][0] - plan.points[from][0], plan.points[i][1] - plan.points[from][1], 0,
                     0};
      };
      const std::size_t count = plan.points.size();
      const std::size_t step = at_middles ? 1 : 2;
      std::size_t here = from;
      for (std::size_t i = 0; i < count; i += step) {
        const std::size_t next = (here + (is_clockwise ? count - step : step)) % count;
        const std::size_t side = (is_clockwise ? next : here) / 2;
        if (side % 2 == 0) {
          drawing.add(motion::line(drawing.at(), at(next)), now_tick);
        } else {
          const auto& centre = plan.centres[side / 2];
          const auto& origin = plan.points[from];
          drawing.add(
              motion::arc_by_centre(drawing.at(), {centre[0] - origin[0], centre[1] - origin[1], 0, 0},
                                    at(next), is_clockwise ? kCw : kCcw, kArcOptions),
              now_tick);
        }
        here = next;
      }
      speed = {.start_pps = command.values[8],
               .drive_pps = command.values[9],
               .acceleration = command.values[10],
               .deceleration = command.values[11],
               .offset_pulses = 0};
      shape = {.constant = command.values[2] == 0, .unlike_ramps = true};
      break;
    }
    case Draws::helix: {
      const double turns = number(7);
      if (turns == 0) return;
      const bool is_clockwise = (command.values[3] == 0) != (turns < 0);
      const double sweep = std::abs(turns) * 2 * motion::kPi * (is_clockwise ? -1 : +1);
      const Point centre{number(5), number(6), 0, 0};
      const Point rise{0, 0, number(8) * std::abs(turns), 0};
      drawing.add(motion::arc_by_sweep(begin, centre, sweep, rise, kArcOptions), now_tick);
      const double circle = std::abs(sweep) * std::sqrt(centre[0] * centre[0] + centre[1] * centre[1]);
      // VV is the speed of the circle.
      if (chose(option("helix_speed", "of_its_circle"))) speed_factor = drawing.length / circle;
      speed = {.drive_pps = command.values[4], .offset_pulses = 0};
      shape = {.constant = true};
      break;
    }
    case Draws::mixed: break;
  }

  if (joins) {
    paths.together.run = drawing.run;
    paths.end = drawing.end;
  } else {
    if (drawing.length == 0) return;  // no pulse, and neither beginning nor end
    motion::SpeedLaw law = rs_m8194h::law_of(speed, speed.drive_pps, range, shape, false);
    law.top_speed_u_s *= speed_factor;
    law.start_speed_u_s *= speed_factor;
    motion::Coordinated made;
    for (int i = 0; i < row.dimensions; ++i) {
      made.axis_of[static_cast<std::size_t>(i)] = axis_of_code(codes[static_cast<std::size_t>(i)]);
    }
    made.run = drawing.run;
    made.run.set_speed(law, now_tick);
    made.run.set_open(!is_last && !chose(option("stream_starves", "slows_down_in_what_is_left")), now_tick);
    for (const std::int8_t a : made.axis_of) {
      if (a < 0) continue;
      motion::Axis& motor = state_.motors[static_cast<std::size_t>(a)];
      motor.signals = state_.here[static_cast<std::size_t>(a)].at(motor.travel_pulses, motor.signals);
    }
    if (keeps_path_off(codes, drawing.run.path().direction_at(0))) return;
    if (made.begin(Point::Zero(), state_.motors, now_tick) != motion::Cause::none) return;
    paths.together = made;
    paths.end = drawing.end;
    paths.axes = axes_of_path(command);
    paths.runs = row.runs;
    paths.stream = row.stream;
    for (std::size_t a = 0; a < kAxes; ++a) {
      if (has(paths.axes, a)) state_.units[a].error_code &= static_cast<std::uint16_t>(~kClearedByDrive);
    }
    if (is_stream) state_.rint &= static_cast<std::uint8_t>(~bit_of(Rint::stream));
  }
  paths.open = is_stream && !is_last;
  if (joins) state_.rint &= static_cast<std::uint8_t>(~bit_of(Rint::stream));
  const bool begins_to_slow_down = !machine_.last_ramp_is_in_last_segment || paths.together.run.queued() < 2;
  if (joins && is_last && begins_to_slow_down) paths.together.run.set_open(false, now_tick);
}

}  // namespace understudy::emulator::models::rs_m8194h
