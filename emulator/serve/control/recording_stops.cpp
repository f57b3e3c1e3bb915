#include "emulator/serve/control/recording_stops.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/serve/control/debug_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/debug/breakpoint.h"
#include "emulator/world/debug/debugger.h"
#include "emulator/world/recording/timeline.h"

namespace understudy::emulator::serve {

namespace {

/// Returns true if the stop ends a step, either at the end of the step or at a breakpoint before that.
bool is_at_a_line(const world::DebugStop& stop) {
  using Reason = world::DebugStop::Reason;
  return stop.reason == Reason::step || (stop.reason == Reason::breakpoint && stop.place.line != 0);
}

}  // namespace

bool is_way_back(const Json& message) { return flag_or_false(message, "back"); }

RecordingStops::RecordingStops(Daemon& daemon, world::Timeline& timeline, std::function<void(SimTime)> go_to)
    : daemon_(daemon), timeline_(timeline), go_to_(std::move(go_to)) {}

world::Debugger& RecordingStops::debugger() const { return daemon_.observers().debugger; }

SimTime RecordingStops::now() const { return daemon_.world().now(); }

Json RecordingStops::resume(const Json& message) {
  require_keys(message, {"do", "within", "back"});
  if (is_way_back(message)) {
    if (message.contains("within"))
      throw MessageError("within: cannot be combined with back; expected one of them");
    go_back([this](SimTime until) { return play_on(until); }, [](const world::DebugStop&) { return true; });
    return time_and_stop(daemon_);
  }
  const SimTime end =
      message.contains("within") ? now() + require_duration(daemon_, message, "within") : timeline_.end();
  play_on(end);
  return time_and_stop(daemon_);
}

Json RecordingStops::step(const Json& message) {
  if (!message.contains("what")) {
    require_keys(message, {"do", "ticks"});
    const std::uint64_t ticks =
        message.contains("ticks") ? require_count(message, "ticks", kMaxStepTicks) : 1;
    play_on(time_of(tick_at(now()) + static_cast<Tick>(ticks)));
    return time_and_stop(daemon_);
  }
  require_keys(message, {"do", "what", "device", "program", "within", "back"});
  Wanted wanted = wanted_step(message);
  if (!is_way_back(message)) {
    const SimTime end =
        message.contains("within") ? now() + require_duration(daemon_, message, "within") : timeline_.end();
    step_on(wanted, end);
    return time_and_stop(daemon_);
  }
  if (wanted.kind == world::StepKind::stand)
    throw MessageError("what: stand cannot go back; expected instruction, line, over or out with back");
  // A step back over a routine goes to the last earlier line with at most as many callers. A step back out of
  // the routine goes to the last earlier line with fewer callers.
  const world::DebugStop* const stop = debugger().stop();
  const std::size_t depth = stop != nullptr ? stop->depth : SIZE_MAX;
  const world::StepKind kind = wanted.kind;
  if (kind == world::StepKind::out && depth == 0)
    throw MessageError("no routine is running; expected a step within a called routine");
  if (kind != world::StepKind::instruction) wanted.kind = world::StepKind::line;
  debugger().begin_step(wanted.kind, wanted.device, wanted.program);  // throws if there is no such program
  debugger().end_step();
  go_back([this, wanted](SimTime until) { return step_on(wanted, until); },
          [kind, depth](const world::DebugStop& one) {
            if (!is_at_a_line(one)) return false;
            if (kind == world::StepKind::over) return one.depth <= depth;
            return kind != world::StepKind::out || one.depth < depth;
          });
  return time_and_stop(daemon_);
}

RecordingStops::Wanted RecordingStops::wanted_step(const Json& message) const {
  Json where = message;
  const world::DebugStop* const stop = debugger().stop();
  if (!where.contains("device") && stop != nullptr && !stop->device.empty()) where["device"] = stop->device;
  return {.kind = require_step_kind(message),
          .device = require_device(daemon_, where),
          .program = message.contains("program") ? require_text(message, "program") : std::string()};
}

bool RecordingStops::play_on(SimTime until) {
  const SimTime began = now();
  timeline_.play_on(until, [this] { return debugger().stop() != nullptr; });
  static_cast<void>(debugger().take_stop());  // the clock is already stopped
  return now() > began && debugger().stop() != nullptr;
}

bool RecordingStops::step_on(const Wanted& wanted, SimTime until) {
  debugger().begin_step(wanted.kind, wanted.device, wanted.program);
  const bool has_stopped = play_on(until);
  debugger().end_step();
  return has_stopped;
}

void RecordingStops::begin_at(std::size_t keyframe) { go_to_(timeline_.time_of_keyframe(keyframe)); }

/// Plays from a keyframe on. Returns the number of the last wanted stop before the moment `before`. Plays to
/// the tick after the next keyframe, because a line that begins in that tick would seem to be already running
/// if playback began at that keyframe.
std::optional<std::size_t> RecordingStops::last_stop(std::size_t keyframe, SimTime before, const PlayOn& play,
                                                     const IsWanted& is_wanted) {
  const bool is_last = keyframe + 1 == timeline_.keyframes();
  const SimTime next =
      is_last ? timeline_.end() : time_of(tick_at(timeline_.time_of_keyframe(keyframe + 1)) + 1);
  begin_at(keyframe);
  std::optional<std::size_t> found;
  try {
    for (std::size_t count = 1; play(std::min(before, next)); ++count) {
      if (now() >= before) break;
      if (is_wanted(*debugger().stop())) found = count;
    }
  } catch (const world::BreakpointError&) {  // at this moment, there is no program to step
  }
  return found;
}

/// Searches from one keyframe after another, beginning with the last one.
void RecordingStops::go_back(const PlayOn& play, const IsWanted& is_wanted) {
  const SimTime from = now();
  for (std::size_t keyframe = timeline_.keyframes(); keyframe-- > 0;) {
    if (timeline_.time_of_keyframe(keyframe) >= from) continue;
    const auto found = last_stop(keyframe, from, play, is_wanted);
    if (!found) continue;
    begin_at(keyframe);
    for (std::size_t count = 0; count < *found; ++count) play(timeline_.end());
    return;
  }
  begin_at(0);
}

}  // namespace understudy::emulator::serve
