#include "emulator/models/rs_m8194h/drives/path_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/drives/path_rows.h"
#include "emulator/models/rs_m8194h/drives/rectangle.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "interpreter/rs_m8194h/command.h"
#include "motion/elementary.h"
#include "motion/move.h"
#include "motion/path.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

using motion::Point;

/// The figure that a command draws, its turning direction, and the first parameter of its points.
struct Figure {
  Draws draws = Draws::line;
  Turn turn = kCw;
  std::size_t first_value = 0;
};

Figure figure_of(const PathRow& row, const lang::Command& command) {
  if (row.runs != Paths::Runs::stream) return {.draws = row.draws, .turn = row.turn, .first_value = 0};
  if (row.draws != Draws::mixed) return {.draws = row.draws, .turn = row.turn, .first_value = 1};
  const MixRow& mix = kMixRows[command.values[1] - 1];
  return {.draws = mix.draws,
          .turn = mix.turn,
          .first_value = mix.draws == Draws::line ? std::size_t{4} : std::size_t{2}};
}

/// Speeds as sent, their ramp shape, and a factor for speeds that are not measured along the path.
struct PathSpeed {
  SpeedSettings settings{};
  Shape shape{};
  double factor = 1;
};

PathSpeed speed_of(const Paths& paths, const PathRow& row) {
  if (row.runs != Paths::Runs::stream)
    return {.settings = paths.vector, .shape = kVectorShapes[paths.vector.mode]};
  const StreamSettings& given = paths.streams[static_cast<std::size_t>(row.stream)];
  if (!given.given) {
    return {.settings = paths.vector,
            .shape = {.constant = paths.vector.mode == 0 || paths.vector.mode == 7}};
  }
  return {.settings = {.start_pps = given.start_pps,
                       .drive_pps = given.drive_pps,
                       .acceleration = given.acceleration,
                       .offset_pulses = 0},
          .shape = {.constant = given.constant}};
}

/// The pen reads a command's parameters one after another, and records what has been drawn so far.
class Pen {
 public:
  Pen(const Chip& chip, const HeldPath& path, bool joins)
      : chip_(chip), path_(path), row_(row_of_path(path.command.verb())), joins_(joins) {
    if (!joins) return;
    drawing_.run = chip.paths().together.run;
    drawing_.end = chip.paths().end;
    begin_ = drawing_.at();
  }

  PathDrawing draw() {
    const Figure figure = figure_of(row_, path_.command);
    PathSpeed speed = speed_of(chip_.paths(), row_);
    switch (figure.draws) {
      case Draws::line: add(motion::line(begin_, point(figure.first_value))); break;
      case Draws::arc:
        speed.shape.s_curve = false;
        arc(begin_, point(figure.first_value), point(figure.first_value + 2), figure.turn);
        break;
      case Draws::circle:
        speed.shape.s_curve = false;
        add(motion::arc_by_centre(begin_, point(figure.first_value), begin_, figure.turn, kArcOptions));
        break;
      case Draws::rectangle: speed = rectangle(); break;
      case Draws::helix: speed = helix(); break;
      case Draws::mixed: break;
    }
    drawing_.law =
        law_of(speed.settings, speed.settings.drive_pps, speed_range_of_path(), speed.shape, false);
    drawing_.law.top_speed_u_s *= speed.factor;
    drawing_.law.start_speed_u_s *= speed.factor;
    return drawing_;
  }

 private:
  double number(std::size_t i) const { return static_cast<double>(path_.command.signed_value(i)); }
  const AxisUnit& unit(std::size_t coordinate) const { return chip_.unit(axis(coordinate)); }
  std::size_t axis(std::size_t coordinate) const {
    return static_cast<std::size_t>(axis_of_code(path_.codes[coordinate]));
  }
  void add(const motion::Path& path) { drawing_.add(path, chip_.now()); }

  SpeedRange speed_range_of_path() const {
    std::uint32_t max_v = unit(0).basic.max_v;
    for (int i = 1; i < row_.dimensions && chip_.chose(option("vector_max_v", "the_least")); ++i) {
      max_v = std::min(max_v, unit(static_cast<std::size_t>(i)).basic.max_v);
    }
    const bool has_own_end = chip_.chose(option("path_max_v", "as_printed"));
    const std::uint32_t highest = has_own_end ? kHighest[row_.dimensions - 2] : kHighestOfOneAxis;
    return speed_range(max_v, chip_.machine_options().speed, highest);
  }

  /// Returns the place of a coordinate in a command, in pulses from where the run began.
  double place(std::size_t coordinate, double value) const {
    const double here = begin_[static_cast<Eigen::Index>(coordinate)];
    if (!row_.absolute) return here + value;
    const std::int64_t travel = joins_ ? chip_.paths().together.travel_at(coordinate, here)
                                       : chip_.motor(axis(coordinate)).travel_pulses;
    return here + value -
           static_cast<double>(static_cast<std::int32_t>(unit(coordinate).absolute.at(travel)));
  }
  Point point(std::size_t first_value) const {
    Point made = begin_;
    for (int i = 0; i < row_.dimensions; ++i) {
      made[i] = place(static_cast<std::size_t>(i), number(first_value + static_cast<std::size_t>(i)));
    }
    return made;
  }

  void arc(const Point& from, const Point& centre, const Point& to, Turn turn) {
    motion::ArcOptions options = kArcOptions;
    if (chip_.chose(option("arc_end_off_circle", "ends_at_its_end")))
      options.off_circle = motion::OffCircle::blend;
    add(motion::arc_by_centre(from, centre, to, turn, options));
  }

  /// Draws a rectangle once around, from the point where it begins (7.4.1).
  PathSpeed rectangle() {
    const lang::Command& command = path_.command;
    const bool is_clockwise = command.values[4] == 1;
    const double corners = chip_.chose(option("rectangle_sides", "straight_parts")) ? 2 * number(7) : 0;
    const double length = number(5) + corners;
    const double width = number(6) + corners;
    const RectanglePlan plan = rectangle_plan(length, width, std::min({number(7), length / 2, width / 2}));
    const std::size_t start_point = command.values[3];
    const bool counts_back = chip_.chose(option("rectangle_start_points", "clockwise_from_the_left_side"));
    const bool at_middles = chip_.chose(option("rectangle_start_points", "middles_from_the_lower_side"));
    const std::size_t from =
        at_middles ? 2 * start_point + 1 : 2 * (counts_back ? 7 - start_point : start_point);
    const auto from_start = [&](const std::array<double, 2>& place) {
      return Point{place[0] - plan.points[from][0], place[1] - plan.points[from][1], 0, 0};
    };
    const std::size_t count = plan.points.size();
    const std::size_t step = at_middles ? 1 : 2;
    std::size_t here = from;
    for (std::size_t i = 0; i < count; i += step) {
      const std::size_t next = (here + (is_clockwise ? count - step : step)) % count;
      const std::size_t side = (is_clockwise ? next : here) / 2;
      const Point end = from_start(plan.points[next]);
      if (side % 2 == 0) {
        add(motion::line(drawing_.at(), end));
      } else {
        add(motion::arc_by_centre(drawing_.at(), from_start(plan.centres[side / 2]), end,
                                  is_clockwise ? kCw : kCcw, kArcOptions));
      }
      here = next;
    }
    return {.settings = {.start_pps = command.values[8],
                         .drive_pps = command.values[9],
                         .acceleration = command.values[10],
                         .deceleration = command.values[11],
                         .offset_pulses = 0},
            .shape = {.constant = command.values[2] == 0, .unlike_ramps = true}};
  }

  /// Draws a helix with this many turns (7.4.11). With 0 turns, it draws nothing.
  PathSpeed helix() {
    PathSpeed speed{.settings = {.drive_pps = path_.command.values[4], .offset_pulses = 0},
                    .shape = {.constant = true}};
    const double turns = number(7);
    if (turns == 0) return speed;
    const bool is_clockwise = (path_.command.values[3] == 0) != (turns < 0);
    const double sweep = std::abs(turns) * 2 * motion::kPi * (is_clockwise ? -1 : +1);
    const Point centre{number(5), number(6), 0, 0};
    const Point rise{0, 0, number(8) * std::abs(turns), 0};
    add(motion::arc_by_sweep(begin_, centre, sweep, rise, kArcOptions));
    const double circle = std::abs(sweep) * std::sqrt(centre[0] * centre[0] + centre[1] * centre[1]);
    // VV is the speed of the circle.
    if (chip_.chose(option("helix_speed", "of_its_circle"))) speed.factor = drawing_.length / circle;
    return speed;
  }

  const Chip& chip_;
  const HeldPath& path_;
  const PathRow& row_;
  const bool joins_;
  PathDrawing drawing_;
  Point begin_ = Point::Zero();
};

}  // namespace

PathDrawing draw_path(const Chip& chip, const HeldPath& path, bool joins) {
  return Pen(chip, path, joins).draw();
}

}  // namespace understudy::emulator::models::rs_m8194h
