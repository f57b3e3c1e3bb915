// What a command of 7.2 or 7.4 draws, and how fast; the path itself is motion's.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/path_rows.h"
#include "emulator/models/rs_m8194h/paths.h"
#include "emulator/models/rs_m8194h/rectangle.h"
#include "emulator/models/rs_m8194h/state.h"
#include "interpreter/rs_m8194h/command.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/elementary.h"
#include "motion/move.h"
#include "motion/path.h"
#include "motion/path_run.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

using motion::Path;
using motion::Point;

/// A run in the making.
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

}  // namespace

void Module::draw(const HeldPath& path, bool joins) {
  const lang::Command& command = path.command;
  const std::array<std::uint8_t, 3>& codes = path.codes;
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
  const bool has_own_end = chose(option("path_max_v", "as_printed"));
  const std::uint32_t highest = has_own_end ? kHighest[row.dimensions - 2] : kHighestOfOneAxis;
  const SpeedRange range = speed_range(max_v, machine_.speed, highest);
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
  // What a stream that was broken off has left behind it stays until it is begun anew.
  const bool goes_on = is_stream && (paths.broken & bit_of(row.stream)) != 0;
  if (is_stream && is_last) forget_break(row.stream);
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
      const bool are_straight = chose(option("rectangle_sides", "straight_parts"));
      const double corners = are_straight ? 2 * number(7) : 0;
      const double length = number(5) + corners;
      const double width = number(6) + corners;
      const RectanglePlan plan = rectangle_plan(length, width, std::min({number(7), length / 2, width / 2}));
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
    state_.loaded.push_back(path);
  } else {
    if (drawing.length == 0) {  // no pulse, and neither beginning nor end
      if (is_stream && is_last) paths.open = false;
      return;
    }
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
      motor.signals = state_.environment[static_cast<std::size_t>(a)].at(motor.travel_pulses, motor.signals);
    }
    on_path_end(false);  // of one that was stopped since the last tick
    if (keeps_path_off(codes, drawing.run.path().direction_at(0)) ||
        made.begin(Point::Zero(), state_.motors, now_tick) != motion::Cause::none) {
      return refuse_segment(path);
    }
    state_.loaded.clear();
    if (is_stream) state_.loaded.push_back(path);
    paths.together = made;
    paths.end = drawing.end;
    paths.axes = mask_of_codes(codes);
    paths.runs = row.runs;
    paths.stream = row.stream;
    for (std::size_t a = 0; a < kAxes && !goes_on; ++a) {
      if (has(paths.axes, a)) forget_errors(a);
    }
  }
  paths.open = is_stream && !is_last;
  if (is_stream && !goes_on) state_.rint &= static_cast<std::uint8_t>(~bit_of(Rint::stream));
  const bool begins_to_slow_down = !machine_.last_ramp_is_in_last_segment || paths.together.run.queued() < 2;
  if (joins && is_last && begins_to_slow_down) paths.together.run.set_open(false, now_tick);
}

}  // namespace understudy::emulator::models::rs_m8194h
