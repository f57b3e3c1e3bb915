#include "emulator/serve/control/way_back.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/serve/control/debug_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/recording_stops.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/debug/debugger.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/recording/recent_course.h"
#include "emulator/world/recording/timeline.h"
#include "emulator/world/snapshot.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMaxEarlier =
    200;  // the number of earlier frames that observers keep, and also of events

/// Returns the name of a line that a host has open, or nothing.
std::optional<std::string> line_with_host(const Daemon& daemon) {
  for (const auto& port : daemon.ports()) {
    if (port->host_present()) return port->world_line().line.name();
  }
  return std::nullopt;
}

/// The frames and events before a moment. Observers do not see those of an abandoned course.
struct Before {
  std::vector<world::FrameLog::Frame> frames;
  std::vector<world::Event> events;
};

Before before_now(Daemon& daemon) {
  Before all{.frames = daemon.frames().kept_since(1, kMaxEarlier), .events = {}};
  for (const auto& event : daemon.observers().events.since(1, SIZE_MAX))
    if (event.what != "restored") all.events.push_back(event);
  if (all.events.size() > kMaxEarlier) all.events.erase(all.events.begin(), all.events.end() - kMaxEarlier);
  return all;
}

void require_way_back(const Daemon& daemon) {
  if (!daemon.pacer().standing() || daemon.is_advancing()) throw MessageError(std::string(kRunsByItself));
  if (const auto line = line_with_host(daemon))
    throw MessageError("back: a host has " + *line + " open; expected no host on the line, or a recording");
  if (const std::string_view why = daemon.why_no_restore(); !why.empty())
    throw MessageError(std::string(why));
  const auto& course = daemon.observers().course;
  if (!course || daemon.world().now() == course->begin())
    throw MessageError(
        "back: nothing has happened since debugging began; expected `continue` or `step` first");
  if (!course->is_whole())
    throw MessageError("back: more than " + std::to_string(world::RecentCourse::kMaxEvents) +
                       " events have occurred since debugging began; expected a recording");
}

std::optional<world::DebugStop> stop_of(const world::Debugger& debugger) {
  if (const world::DebugStop* const stop = debugger.stop()) return *stop;
  return std::nullopt;
}

/// Calls `go(stops)` with the course up to now. From there, the bench takes another course.
template <class Go>
Json go_back(Daemon& daemon, const Go& go) {
  require_way_back(daemon);
  world::Debugger& debugger = daemon.observers().debugger;
  const Before before = before_now(daemon);
  // Daemon::restore() ends a course, because most restores are not part of one, but this restore is.
  std::unique_ptr<world::RecentCourse> course = std::move(daemon.observers().course);
  const SimTime from = daemon.world().now();
  Json reply;
  {
    const world::RecentCourse::Pause pause(*course);
    const std::optional<world::DebugStop> stop = stop_of(debugger);
    debugger.sleep();
    world::Timeline& timeline = course->timeline();
    debugger.wake(stop);
    const auto go_to = [&](SimTime time) {
      debugger.sleep();
      timeline.go_to(time, [&](const world::WorldState& state, std::size_t) {
        daemon.restore(state);
        Before earlier = before;
        const SimTime at = daemon.world().now();
        std::erase_if(earlier.frames, [&](const auto& frame) { return frame.time > at; });
        std::erase_if(earlier.events, [&](const auto& event) { return event.time > at; });
        daemon.restart_logs(std::move(earlier.frames), std::move(earlier.events));
      });
      debugger.wake();
    };
    try {
      RecordingStops stops(daemon, timeline, go_to);
      reply = go(stops);
    } catch (...) {
      go_to(from);
      debugger.wake(stop);
      daemon.advance_at_once(from);
      daemon.observers().course = std::move(course);
      throw;
    }
  }
  daemon.advance_at_once(daemon.world().now());
  course->drop_after(daemon.world().now());
  daemon.observers().course = std::move(course);
  return reply;
}

}  // namespace

void keep_course(Daemon& daemon) {
  auto& course = daemon.observers().course;
  if ((course && course->is_whole()) || line_with_host(daemon)) return;
  course = std::make_unique<world::RecentCourse>(daemon.world());
}

Json continue_back(Daemon& daemon, const Json& message) {
  return go_back(daemon, [&](RecordingStops& stops) { return stops.resume(message); });
}

Json step_back(Daemon& daemon, const Json& message) {
  return go_back(daemon, [&](RecordingStops& stops) { return stops.step(message); });
}

}  // namespace understudy::emulator::serve
