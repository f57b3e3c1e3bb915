#include "emulator/models/rs_m8194h/drives/path_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/drives/path_drawing.h"
#include "emulator/models/rs_m8194h/drives/path_rows.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "emulator/models/rs_m8194h/drives/transitions.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/not_implemented.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "interpreter/rs_m8194h/command.h"
#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/coordinated.h"
#include "motion/path.h"

namespace understudy::emulator::models::rs_m8194h {

/// Returns the axes of a path, in order.
std::array<std::uint8_t, 3> PathStarts::codes_of(const lang::Command& command) const {
  const PathRow& row = row_of_path(command.verb());
  std::array<std::uint8_t, 3> codes = chip_.paths().assigned;
  const StreamSettings& settings = chip_.paths().streams[static_cast<std::size_t>(row.stream)];
  if (row.runs == Paths::Runs::stream && settings.given) codes = settings.axes;
  if (row.runs == Paths::Runs::rectangle) codes = codes_at(command, 2);
  if (row.runs == Paths::Runs::helix) codes = codes_at(command, 3);
  if (row.dimensions == 2) codes[2] = 0;
  return codes;
}

Took PathStarts::follow(const lang::Command& command) {
  const HeldPath path{.command = command, .codes = codes_of(command)};
  std::vector<HeldPath>& held = streams_.held();
  if (held.empty() || !follows(held.front(), path)) return begin(path);
  // A stream counts as one drive: its segments are held together, and begin one after another.
  const auto end = std::find_if_not(held.begin(), held.end(),
                                    [&](const HeldPath& each) { return follows(held.front(), each); });
  const bool has_last = is_last_segment(*std::prev(end));
  if (has_last && !streams_.joins(held.front())) return begin(path);
  if (has_last || held.size() >= static_cast<std::size_t>(kFifoBlocks)) return Took::waits;
  held.insert(end, path);
  return Took::done;
}

void PathStarts::start_held() {
  std::vector<HeldPath>& held = streams_.held();
  while (!held.empty()) {
    const HeldPath path = held.front();
    const Start outcome = drives_.may_start(mask_of_codes(path.codes), Starter::command);
    const bool stays = outcome == Start::is_held || outcome == Start::waits;
    // Segments join the one that has begun.
    if (stays && !streams_.joins(path)) return;
    if (begin(path) == Took::waits) return;
    if (!held.empty()) held.erase(held.begin());
  }
}

/// Returns true if the path does not match the settings of its axes or of its speed.
bool PathStarts::is_refused(const HeldPath& path) const {
  const PathRow& row = row_of_path(path.command.verb());
  const Paths& paths = chip_.paths();
  const bool is_unfit = row.runs == Paths::Runs::single && chose(option("unfit_profile", "void")) &&
                        !fits_mode(paths.vector.mode, row.dimensions, row.draws);
  const bool has_no_initial = is_segment(path) &&
                              !paths.streams[static_cast<std::size_t>(row.stream)].given &&
                              chose(option("continue_without_initial", "void_with_module_error"));
  return has_no_initial || is_unfit || !is_one_each(path.codes, row.dimensions);
}

Took PathStarts::begin(const HeldPath& path) {
  if (is_refused(path)) {
    interrupts_.raise(Rint::module);
    return Took::done;
  }
  if (is_segment(path) && streams_.is_left_over(path)) return Took::done;
  const bool joins = streams_.joins(path);
  if (joins) {
    const bool slows_down = chip_.paths().together.slowing_for != motion::Cause::none;
    if (slows_down || !streams_.has_room()) return Took::waits;
  } else {
    switch (may_begin(path)) {
      case Start::is_void: return Took::done;
      case Start::waits: return Took::waits;
      case Start::is_held: return hold(path);
      case Start::starts: break;
    }
  }
  try {
    draw(path, joins);
  } catch (const motion::BadMotion& bad) {
    if (bad.refusal() == motion::Refusal::out_of_range) warn_not_implemented(kLongHelix, kWhyNoLongHelix);
    interrupts_.raise(Rint::module);  // for example, there is no such arc
  }
  return Took::done;
}

Start PathStarts::may_begin(const HeldPath& path) {
  const AxisMask axes = mask_of_codes(path.codes);
  const Start outcome = drives_.may_start(axes, Starter::command);
  if (outcome == Start::is_void) {
    drives_.note_obstacles(axes);
    streams_.refuse(path);
    return outcome;
  }
  // Only one path can run at a time, regardless of its axes.
  if (outcome == Start::waits || chip_.paths().together.engaged) return Start::waits;
  const bool is_single = row_of_path(path.command.verb()).runs == Paths::Runs::single;
  const bool has_no_speed = is_single && chip_.paths().vector.drive_pps == 0;
  return has_no_speed && machine_options().zero_speeds_drive_nothing ? Start::is_void : outcome;
}

Took PathStarts::hold(const HeldPath& path) {
  const AxisMask axes = mask_of_codes(path.codes);
  if (drives_.waits_behind_held(axes)) return Took::waits;
  if (drives_.keeps_first_held(axes)) return Took::done;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (has(axes, a)) chip_.unit(a).held_drive = {};
  }
  streams_.drop_held();
  // The held segments of the stream belong to a different INITIAL.
  if (is_segment(path)) streams_.forget_break(row_of_path(path.command.verb()).stream);
  streams_.held().assign(1, path);
  return Took::done;
}

void PathStarts::draw(const HeldPath& path, bool joins) {
  const PathRow& row = row_of_path(path.command.verb());
  Paths& paths = chip_.paths();
  const bool is_stream = is_segment(path);
  const bool is_last = !is_stream || is_last_segment(path);
  // The errors and the RINT bit of an interrupted stream remain until a new stream begins.
  const bool continues = is_stream && (paths.broken & bit_of(row.stream)) != 0;
  if (is_stream && is_last) streams_.forget_break(row.stream);
  const PathDrawing drawing = draw_path(chip_, path, joins);
  if (joins) {
    paths.together.run = drawing.run;
    paths.end = drawing.end;
    streams_.loaded().push_back(path);
  } else if (drawing.length == 0) {  // the path sends no pulse, so it neither begins nor ends
    if (is_stream && is_last) paths.open = false;
    return;
  } else if (!set_out(path, drawing)) {
    return streams_.refuse(path);
  } else {
    for (std::size_t a = 0; a < kAxes && !continues; ++a) {
      if (has(paths.axes, a)) drives_.forget_errors(a);
    }
  }
  paths.open = is_stream && !is_last;
  if (is_stream && !continues) interrupts_.clear(Rint::stream);
  const bool begins_to_slow_down =
      !machine_options().last_ramp_is_in_last_segment || paths.together.run.queued() < 2;
  if (joins && is_last && begins_to_slow_down) paths.together.run.set_open(false, now());
}

/// Starts the drawn path. Returns false if an axis prevents this.
bool PathStarts::set_out(const HeldPath& path, const PathDrawing& drawing) {
  const PathRow& row = row_of_path(path.command.verb());
  const bool ends_here = !is_segment(path) || is_last_segment(path);
  motion::Coordinated made;
  for (int i = 0; i < row.dimensions; ++i) {
    made.axis_of[static_cast<std::size_t>(i)] = axis_of_code(path.codes[static_cast<std::size_t>(i)]);
  }
  made.run = drawing.run;
  made.run.set_speed(drawing.law, now());
  made.run.set_open(!ends_here && !chose(option("stream_starves", "slows_down_in_what_is_left")), now());
  for (const std::int8_t a : made.axis_of) {
    if (a < 0) continue;
    const auto axis = static_cast<std::size_t>(a);
    motion::Axis& motor = chip_.motor(axis);
    motor.signals = chip_.environment(axis).at(motor.travel_pulses, motor.signals);
  }
  streams_.on_path_end(false);  // needed if the path was stopped after the last tick
  if (is_kept_off(path.codes, drawing.run.path().direction_at(0)) ||
      made.begin(motion::Point::Zero(), chip_.state().motors, now()) != motion::Cause::none) {
    return false;
  }
  streams_.loaded().clear();
  if (is_segment(path)) streams_.loaded().push_back(path);
  Paths& paths = chip_.paths();
  paths.together = made;
  paths.end = drawing.end;
  paths.axes = mask_of_codes(path.codes);
  paths.runs = row.runs;
  paths.stream = row.stream;
  return true;
}

/// Returns true if an active limit, or a soft limit that is reached, prevents a path from beginning, as for
/// the drive of an axis. The error bit is set for the axis that would have moved against the limit.
bool PathStarts::is_kept_off(const std::array<std::uint8_t, 3>& codes, const motion::Point& direction) {
  bool is_kept = false;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::int8_t a = axis_of_code(codes[i]);
    const double along = direction[static_cast<Eigen::Index>(i)];
    constexpr double kRounding = 1e-9;
    if (a < 0 || std::abs(along) < kRounding) continue;
    const auto axis = static_cast<std::size_t>(a);
    const motion::Cause why = chip_.motor(axis).forbidden(along < 0 ? -1 : +1);
    if (why == motion::Cause::none) continue;
    chip_.add_errors(axis, error_of(why));
    is_kept = true;
  }
  return is_kept;
}

}  // namespace understudy::emulator::models::rs_m8194h
