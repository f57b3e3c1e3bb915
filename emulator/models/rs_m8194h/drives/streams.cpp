#include "emulator/models/rs_m8194h/drives/streams.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/drives/path_rows.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/commands.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/move.h"
#include "motion/path_run.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

Stream stream_of(const HeldPath& segment) { return row_of_path(segment.command.verb()).stream; }

}  // namespace

bool is_segment(const HeldPath& path) { return row_of_path(path.command.verb()).runs == Paths::Runs::stream; }

bool is_last_segment(const HeldPath& path) { return is_segment(path) && path.command.values[0] == 1; }

bool is_path(const lang::Command& command) {
  return std::any_of(std::begin(kPathRows), std::end(kPathRows),
                     [&](const PathRow& row) { return row.verb == command.verb(); }) &&
         lang::find_code(command.code) != nullptr;
}

bool follows(const HeldPath& first, const HeldPath& other) {
  const PathRow& one = row_of_path(first.command.verb());
  const PathRow& another = row_of_path(other.command.verb());
  const bool are_segments = one.runs == Paths::Runs::stream && another.runs == Paths::Runs::stream;
  return are_segments && one.stream == another.stream && first.codes == other.codes;
}

AxisMask Streams::axes_of_held() const {
  return state_.held_paths.empty() ? AxisMask{0} : mask_of_codes(state_.held_paths.front().codes);
}

bool Streams::joins(const HeldPath& path) const {
  const PathRow& row = row_of_path(path.command.verb());
  const Paths& paths = chip_.paths();
  return row.runs == Paths::Runs::stream && paths.together.engaged && paths.runs == Paths::Runs::stream &&
         paths.stream == row.stream && paths.open && (paths.axes & ~mask_of_codes(path.codes)) == 0;
}

/// Returns true if there is room for a segment. One segment is loaded ahead of the running one, and segments
/// that end within the next tick need their successors in time.
bool Streams::has_room() const {
  const motion::PathRun& run = chip_.paths().together.run;
  if (run.full()) return false;
  if (chose(option("stream_lookahead", "30"))) return true;
  return run.queued() < 2 || run.queued_after(now() + 1) == 0;
}

bool Streams::is_complete() const {
  const motion::Coordinated& together = chip_.paths().together;
  for (std::size_t i = 0; i < together.axis_of.size(); ++i) {
    const std::int8_t a = together.axis_of[i];
    if (a < 0) continue;
    const std::int64_t travel = chip_.motor(static_cast<std::size_t>(a)).travel_pulses;
    if (together.travel_at(i, chip_.paths().end[i]) != travel) return false;
  }
  return true;
}

void Streams::on_path_end(bool was_full) {
  Paths& paths = chip_.paths();
  const bool in_stream = paths.together.engaged && paths.runs == Paths::Runs::stream;
  const bool has_room = in_stream && paths.open && paths.together.run.queued() < 2;
  if (machine_options().a_segment_may_come_sets_rint && was_full && has_room) interrupts_.raise(Rint::stream);
  // The last segment has begun.
  const bool is_last = machine_options().last_ramp_is_in_last_segment && in_stream && !paths.open &&
                       paths.together.run.open() && paths.together.run.queued() < 2;
  if (is_last) paths.together.run.set_open(false, now());
  if (paths.together.engaged || paths.runs == Paths::Runs::nothing) return;
  const bool starved =
      paths.runs == Paths::Runs::stream && paths.open && paths.together.cause == motion::Cause::arrived;
  const bool is_broken_off = paths.runs == Paths::Runs::stream &&
                             paths.together.cause != motion::Cause::arrived &&
                             (paths.open || !state_.loaded.empty());
  if (starved) interrupts_.raise(Rint::stream);
  if (is_broken_off) break_off();
  paths.open = starved;
  paths.runs = Paths::Runs::nothing;
}

void Streams::forget_done() {
  if (state_.loaded.empty()) return;
  const auto run = static_cast<std::size_t>(chip_.paths().together.run.completed());
  const auto done = static_cast<std::ptrdiff_t>(std::min(state_.loaded.size(), run));
  state_.loaded.erase(state_.loaded.begin(), state_.loaded.begin() + done);
}

/// Returns the speed law for slowing down. For a path without ramps, it is that of its start speed.
motion::SpeedLaw Streams::law_to_slow_down() const {
  const Paths& paths = chip_.paths();
  motion::SpeedLaw law = paths.together.run.speed();
  const bool has_no_ramps = law.start_speed_u_s >= law.top_speed_u_s;
  if (paths.together.engaged && has_no_ramps && machine_options().constant_paths_slow_down) {
    const bool is_stream = paths.runs == Paths::Runs::stream;
    const std::uint32_t start_pps =
        is_stream ? paths.streams[static_cast<std::size_t>(paths.stream)].start_pps : paths.vector.start_pps;
    law.start_speed_u_s = std::min(std::max(1.0, static_cast<double>(start_pps)), law.top_speed_u_s);
  }
  return law;
}

void Streams::slow_down(Tick tick) {
  motion::Coordinated& together = chip_.paths().together;
  if (together.engaged) together.run.set_speed(law_to_slow_down(), tick);
  together.slow_down(tick);
}

void Streams::stop(motion::Instant at) {
  chip_.paths().together.stop(chip_.state().motors, motion::Cause::stopped, at);
}

void Streams::on_single_drive(std::size_t axis) {
  Paths& paths = chip_.paths();
  if (paths.open && !paths.together.engaged && has(paths.axes, axis)) paths.open = false;
}

void Streams::forget_break(Stream stream) {
  chip_.paths().broken &= static_cast<std::uint8_t>(~bit_of(stream));
}

/// Returns true if the segment belongs to a broken stream. The last segment ends the rest of the stream.
bool Streams::is_left_over(const HeldPath& segment) {
  const Stream stream = stream_of(segment);
  const bool runs = chose(option("broken_stream", "runs_all_the_same"));
  if ((chip_.paths().broken & bit_of(stream)) == 0 || runs) return false;
  const bool is_over = is_last_segment(segment) && !chose(option("broken_stream", "is_void_to_its_initial"));
  if (is_over) forget_break(stream);
  return true;
}

/// Breaks off a stream. `has_more` means that its last segment has not arrived yet. Its held segments also
/// become void.
void Streams::break_off(Stream stream, bool has_more) {
  interrupts_.raise(Rint::stream);
  auto& held = state_.held_paths;
  const bool is_held = !held.empty() && is_segment(held.front()) && stream_of(held.front()) == stream;
  if (is_held && !chose(option("broken_stream", "runs_all_the_same"))) {
    has_more = has_more && !is_last_segment(held.back());
    held.clear();
  }
  if (has_more || chose(option("broken_stream", "is_void_to_its_initial"))) {
    chip_.paths().broken |= bit_of(stream);
  }
}

void Streams::break_off() {
  Paths& paths = chip_.paths();
  const bool is_stream = paths.runs == Paths::Runs::stream || paths.open;
  const bool has_more = std::exchange(paths.open, false);
  if (!is_stream || (!has_more && state_.loaded.empty())) return;  // no part of the stream is left
  break_off(paths.stream, has_more);
  if (paths.together.engaged) return;  // the path is slowing down
  auto loaded = std::exchange(state_.loaded, {});
  if (loaded.size() < 2 || !chose(option("broken_stream", "runs_all_the_same"))) return;
  // The segments after the interrupted one run as soon as possible, before everything else that is waiting.
  state_.held_paths.insert(state_.held_paths.begin(), loaded.begin() + 1, loaded.end());
}

/// Refuses a segment that must not begin, and all segments after it.
void Streams::refuse(const HeldPath& path) {
  if (is_segment(path)) break_off(stream_of(path), !is_last_segment(path));
}

void Streams::drop_held() {
  const auto dropped = std::exchange(state_.held_paths, {});
  if (dropped.empty() || !is_segment(dropped.front())) return;
  break_off(stream_of(dropped.front()), !is_last_segment(dropped.back()));
}

}  // namespace understudy::emulator::models::rs_m8194h
