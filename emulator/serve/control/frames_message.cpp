// What goes over the lines, in words.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/frames/frame_log.h"
#include "pty/capture.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMostFrames = 200;  // a reply, which the devices wait for

std::uint64_t demand_count(const Json& message, const char* key) {
  const Json& value = message[key];
  if (!value.is_number_unsigned()) throw MessageError(std::string(key) + ": expected a whole number");
  return value.get<std::uint64_t>();
}

}  // namespace

Json frames_message(Daemon& daemon, const Json& message) {
  demand_keys(message, {"do", "since", "last"});
  if (message.contains("since") && message.contains("last")) {
    throw MessageError("since: is given together with last; expected one of them");
  }
  daemon.catch_up();
  const world::FrameLog& log = daemon.frames();
  const std::uint64_t next = log.next_number();
  std::uint64_t first = 0;
  if (message.contains("since")) {
    first = demand_count(message, "since");
  } else {
    const std::uint64_t last = message.contains("last") ? demand_count(message, "last") : kMostFrames;
    first = next - std::min<std::uint64_t>({last, kMostFrames, next});
  }
  Json frames = Json::array();
  for (const world::FrameLog::Told& told : log.since(first, kMostFrames)) {
    first = told.number + 1;
    Json frame{{"number", told.number},
               {"time_ns", told.time.count()},
               {"line", told.line},
               {"way", told.way == pty::Way::from_host ? "in" : "out"},
               {"text", told.text}};
    if (!told.remark.empty()) frame["remark"] = told.remark;
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) first = next;
  return Json{{"ok", true}, {"frames", frames}, {"next", first}};
}

}  // namespace understudy::emulator::serve
