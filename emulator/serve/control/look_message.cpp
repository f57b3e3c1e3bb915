// Many values at once, with what has happened since.
#include <unistd.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/look/looked_names.h"
#include "pty/capture.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMostListed = 200;  // frames or events in a reply, which the devices wait for
constexpr std::size_t kMostNames = 2'000;

Json json_of_looked(const world::LookedNames::Looked& looked) {
  if (const auto* number = std::get_if<world::Number>(&looked)) {
    return number->is_whole() ? Json(number->whole()) : Json(number->real());
  }
  if (const auto* text = std::get_if<std::string>(&looked)) return *text;
  return nullptr;
}

std::string hex_of(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

/// The first of a list: those from "since" on, or the last ones.
std::uint64_t first_wanted(const Json& message, std::uint64_t next, std::size_t most) {
  if (message.contains("since") && message.contains("last")) {
    throw MessageError("since: is given together with last; expected one of them");
  }
  if (message.contains("since")) return demand_count(message, "since");
  const std::uint64_t last = message.contains("last") ? demand_count(message, "last") : most;
  return next - std::min<std::uint64_t>({last, most, next});
}

}  // namespace

Json frames_of(Daemon& daemon, std::uint64_t since, std::size_t most, bool raw, std::uint64_t& next) {
  Json frames = Json::array();
  next = since;
  for (const world::FrameLog::Told& told : daemon.frames().since(since, most)) {
    next = told.number + 1;
    Json frame{{"number", told.number},
               {"time_ns", told.time.count()},
               {"line", told.line},
               {"way", told.way == pty::Way::from_host ? "in" : "out"},
               {"text", told.text}};
    if (!told.remark.empty()) frame["remark"] = told.remark;
    if (raw) {
      frame["bytes"] = hex_of(told.bytes);
      if (told.latency) frame["latency_ns"] = told.latency->count();
      if (told.is_refusal) frame["exception"] = true;
    }
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) next = daemon.frames().next_number();
  return frames;
}

Json events_of(Daemon& daemon, std::uint64_t since, std::size_t most, std::uint64_t& next) {
  Json events = Json::array();
  next = since;
  for (const world::Event& event : daemon.onlookers().events.since(since, most)) {
    next = event.number + 1;
    Json told{{"number", event.number}, {"time_ns", event.time.count()}, {"what", event.what}};
    const auto add = [&](const char* key, const std::string& text) {
      if (!text.empty()) told[key] = text;
    };
    add("by", event.by);
    add("line", event.line);
    add("device", event.device);
    add("name", event.name);
    if (!event.value.empty()) told["value"] = json_of(std::stod(event.value));
    add("text", event.text);
    events.push_back(std::move(told));
  }
  if (events.empty()) next = daemon.onlookers().events.next_number();
  return events;
}

Json events_message(Daemon& daemon, const Json& message) {
  demand_keys(message, {"do", "since", "last"});
  daemon.catch_up();
  const std::uint64_t first = first_wanted(message, daemon.onlookers().events.next_number(), kMostListed);
  std::uint64_t next = 0;
  Json events = events_of(daemon, first, kMostListed, next);
  return Json{{"ok", true}, {"events", std::move(events)}, {"next", next}};
}

Json frames_message(Daemon& daemon, const Json& message) {
  demand_keys(message, {"do", "since", "last", "raw"});
  daemon.catch_up();
  const std::uint64_t first = first_wanted(message, daemon.frames().next_number(), kMostListed);
  const bool raw = message.contains("raw") && message["raw"] == true;
  std::uint64_t next = 0;
  Json frames = frames_of(daemon, first, kMostListed, raw, next);
  return Json{{"ok", true}, {"frames", std::move(frames)}, {"next", next}};
}

Json look_message(Daemon& daemon, const Json& message) {
  demand_keys(message, {"do", "names", "frames", "events", "status"});
  daemon.catch_up();
  Json reply{{"ok", true},
             {"pid", getpid()},
             {"simulated_time_ns", daemon.world().now().count()},
             {"paused", daemon.pacer().paused()},
             {"speed", format_speed(daemon.pacer().speed())},
             {"advancing", daemon.is_advancing()}};
  if (message.contains("names")) {
    const Json& names = message["names"];
    if (!names.is_array() || names.size() > kMostNames) {
      throw MessageError("names: expected a list of at most " + std::to_string(kMostNames) + " names");
    }
    Json values = Json::array();
    for (const Json& name : names) {
      if (!name.is_string()) throw MessageError("names: expected a list of names");
      values.push_back(json_of_looked(daemon.onlookers().names.look(name.get_ref<const std::string&>())));
    }
    reply["values"] = std::move(values);
  }
  std::uint64_t next = 0;
  if (message.contains("frames")) {
    reply["frames"] = frames_of(daemon, demand_count(message, "frames"), kMostListed, true, next);
    reply["next_frame"] = next;
  }
  if (message.contains("events")) {
    reply["events"] = events_of(daemon, demand_count(message, "events"), kMostListed, next);
    reply["next_event"] = next;
  }
  if (message.contains("status") && message["status"] == true) {
    reply["status"] = status_message(daemon, Json{{"do", "status"}})["status"];
  }
  return reply;
}

}  // namespace understudy::emulator::serve
