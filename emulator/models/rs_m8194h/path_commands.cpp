// Interpolation: lines, arcs, streams, rectangle, helix (7.2, 7.4). What a command draws is a row; the path
// itself is motion's.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "emulator/device/device.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/not_implemented.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/path_rows.h"
#include "emulator/models/rs_m8194h/paths.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/transitions.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/commands.h"
#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/path.h"
#include "motion/path_run.h"

namespace understudy::emulator::models::rs_m8194h {

bool is_path(const lang::Command& command) {
  return std::any_of(std::begin(kPathRows), std::end(kPathRows),
                     [&](const PathRow& row) { return row.verb == command.verb(); }) &&
         lang::find_code(command.code) != nullptr;
}

/// The axes that a path is on, in their order.
std::array<std::uint8_t, 3> Module::codes_of_path(const lang::Command& command) const {
  const PathRow& row = row_of_path(command.verb());
  std::array<std::uint8_t, 3> codes = state_.paths.assigned;
  const StreamSettings& settings = state_.paths.streams[static_cast<std::size_t>(row.stream)];
  if (row.runs == Paths::Runs::stream && settings.given) codes = settings.axes;
  if (row.runs == Paths::Runs::rectangle) codes = codes_at(command, 2);
  if (row.runs == Paths::Runs::helix) codes = codes_at(command, 3);
  if (row.dimensions == 2) codes[2] = 0;
  return codes;
}

bool Module::streams_need_initial() const {
  return chose(option("continue_without_initial", "void_with_module_error"));
}

bool follows(const HeldPath& first, const HeldPath& other) {
  const PathRow& one = row_of_path(first.command.verb());
  const PathRow& another = row_of_path(other.command.verb());
  const bool are_segments = one.runs == Paths::Runs::stream && another.runs == Paths::Runs::stream;
  return are_segments && one.stream == another.stream && first.codes == other.codes;
}

AxisMask Module::axes_of_held_path() const {
  return state_.held_paths.empty() ? AxisMask{0} : mask_of_codes(state_.held_paths.front().codes);
}

/// A limit that is active before a path begins, or a soft limit that is reached, keeps it from beginning, as
/// it keeps the drive of an axis: the bit is that of the axis which would have set out against it.
bool Module::keeps_path_off(const std::array<std::uint8_t, 3>& codes, const motion::Point& way) {
  bool is_kept = false;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::int8_t a = axis_of_code(codes[i]);
    const double along = way[static_cast<Eigen::Index>(i)];
    constexpr double kRounding = 1e-9;
    if (a < 0 || std::abs(along) < kRounding) continue;
    const auto axis = static_cast<std::size_t>(a);
    const int sense = along < 0 ? -1 : +1;
    const motion::Cause why = state_.motors[axis].forbidden(sense);
    if (why == motion::Cause::none) continue;
    state_.units[axis].error_code |= error_of(why);
    is_kept = true;
  }
  return is_kept;
}

void Module::module_error() { state_.rint |= bit_of(Rint::module); }

/// One segment is loaded ahead of the one that runs; what ends within the coming tick has to have its
/// successors in time.
bool Module::has_room_for_segment() const {
  const motion::PathRun& run = state_.paths.together.run;
  if (run.full()) return false;
  if (chose(option("stream_lookahead", "30"))) return true;
  return run.queued() < 2 || run.queued_after(now() + 1) == 0;
}

Took Module::follow_path(const lang::Command& command) {
  const HeldPath path{.command = command, .codes = codes_of_path(command)};
  auto& held = state_.held_paths;
  if (held.empty() || !follows(held.front(), path)) return begin_path(path);
  // A stream is one drive: its segments are held together, and begin one after the other.
  const auto end = std::find_if_not(held.begin(), held.end(),
                                    [&](const HeldPath& each) { return follows(held.front(), each); });
  const bool has_last = is_last_segment(*std::prev(end));
  if (has_last && !joins_stream(held.front())) return begin_path(path);
  if (has_last || held.size() >= static_cast<std::size_t>(kFifoBlocks)) return Took::waits;
  held.insert(end, path);
  return Took::done;
}

bool Module::joins_stream(const HeldPath& path) const {
  const PathRow& row = row_of_path(path.command.verb());
  const Paths& paths = state_.paths;
  return row.runs == Paths::Runs::stream && paths.together.engaged && paths.runs == Paths::Runs::stream &&
         paths.stream == row.stream && paths.open && (paths.axes & ~mask_of_codes(path.codes)) == 0;
}

Took Module::begin_path(const HeldPath& path) {
  const lang::Command& command = path.command;
  const std::array<std::uint8_t, 3>& codes = path.codes;
  const PathRow& row = row_of_path(command.verb());
  Paths& paths = state_.paths;
  const bool is_stream = row.runs == Paths::Runs::stream;
  const StreamSettings& settings = paths.streams[static_cast<std::size_t>(row.stream)];
  const bool is_unfit = row.runs == Paths::Runs::single && chose(option("unfit_profile", "void")) &&
                        !fits_mode(paths.vector.mode, row.dimensions, row.draws);
  const bool has_no_initial = is_stream && !settings.given && streams_need_initial();
  if (has_no_initial || is_unfit || !is_one_each(codes, row.dimensions)) {
    module_error();
    return Took::done;
  }
  if (is_stream && is_left_over(path)) return Took::done;
  const bool joins = joins_stream(path);
  if (joins && (paths.together.slowing_for != motion::Cause::none || !has_room_for_segment())) {
    return Took::waits;
  }
  const AxisMask axes = mask_of_codes(codes);
  if (!joins) {
    const Start outcome = may_start(axes, Starter::command);
    if (outcome == Start::is_void) {
      note_obstacles(axes);
      refuse_segment(path);
      return Took::done;
    }
    // There is one path at a time, whatever its axes.
    if (outcome == Start::waits || paths.together.engaged) return Took::waits;
    const bool has_no_speed = row.runs == Paths::Runs::single && paths.vector.drive_pps == 0;
    if (has_no_speed && machine_.zero_speeds_drive_nothing) return Took::done;
    if (outcome == Start::is_held && waits_behind_held(axes)) return Took::waits;
    if (outcome == Start::is_held) {
      if (keeps_first_held(axes)) return Took::done;
      for (std::size_t a = 0; a < kAxes; ++a) {
        if (has(axes, a)) state_.units[a].held_drive = {};
      }
      drop_held_path();
      if (is_stream) forget_break(row.stream);  // what was held of it had another INITIAL
      state_.held_paths.assign(1, path);
      return Took::done;
    }
  }
  try {
    draw(path, joins);
  } catch (const motion::BadMotion& bad) {
    if (bad.refusal() == motion::Refusal::out_of_range) warn_not_implemented(kLongHelix, kWhyNoLongHelix);
    module_error();  // no such arc, for example
  }
  return Took::done;
}

}  // namespace understudy::emulator::models::rs_m8194h
