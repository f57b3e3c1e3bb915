// Streams that end otherwise than by their last segment (7.4): what is left of them, and what says so.
#include <cstddef>
#include <cstdint>
#include <utility>

#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/path_rows.h"
#include "emulator/models/rs_m8194h/paths.h"
#include "emulator/models/rs_m8194h/state.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

Stream stream_of(const HeldPath& segment) { return row_of_path(segment.command.verb()).stream; }

}  // namespace

bool is_segment(const HeldPath& path) { return row_of_path(path.command.verb()).runs == Paths::Runs::stream; }

bool is_last_segment(const HeldPath& path) { return is_segment(path) && path.command.values[0] == 1; }

void Module::forget_break(Stream stream) {
  state_.paths.broken &= static_cast<std::uint8_t>(~bit_of(stream));
}

/// Whether a segment belongs to what is left of a stream that was broken off. The last one ends that.
bool Module::is_left_over(const HeldPath& segment) {
  const Stream stream = stream_of(segment);
  const bool runs = chose(option("broken_stream", "runs_all_the_same"));
  if ((state_.paths.broken & bit_of(stream)) == 0 || runs) return false;
  const bool is_over = is_last_segment(segment) && !chose(option("broken_stream", "is_void_to_its_initial"));
  if (is_over) forget_break(stream);
  return true;
}

/// `has_more`: its last segment has not come. What is held of it is void, too.
void Module::break_off(Stream stream, bool has_more) {
  state_.rint |= bit_of(Rint::stream);
  auto& held = state_.held_paths;
  const bool is_held = !held.empty() && is_segment(held.front()) && stream_of(held.front()) == stream;
  if (is_held && !chose(option("broken_stream", "runs_all_the_same"))) {
    has_more = has_more && !is_last_segment(held.back());
    held.clear();
  }
  if (has_more || chose(option("broken_stream", "is_void_to_its_initial"))) {
    state_.paths.broken |= bit_of(stream);
  }
}

/// Of the path that runs or slows down, or of a stream that has starved.
void Module::break_off_stream() {
  Paths& paths = state_.paths;
  const bool is_stream = paths.runs == Paths::Runs::stream || paths.open;
  const bool has_more = std::exchange(paths.open, false);
  if (!is_stream || (!has_more && state_.loaded.empty())) return;  // all of it is done
  break_off(paths.stream, has_more);
  if (paths.together.engaged) return;  // it slows down
  auto loaded = std::exchange(state_.loaded, {});
  if (loaded.size() < 2 || !chose(option("broken_stream", "runs_all_the_same"))) return;
  // Behind the segment that was broken off they run as soon as they may, before all that waits.
  state_.held_paths.insert(state_.held_paths.begin(), loaded.begin() + 1, loaded.end());
}

/// It may not begin, so nothing behind it does.
void Module::refuse_segment(const HeldPath& path) {
  if (is_segment(path)) break_off(stream_of(path), !is_last_segment(path));
}

void Module::drop_held_path() {
  const auto dropped = std::exchange(state_.held_paths, {});
  if (dropped.empty() || !is_segment(dropped.front())) return;
  break_off(stream_of(dropped.front()), !is_last_segment(dropped.back()));
}

}  // namespace understudy::emulator::models::rs_m8194h
