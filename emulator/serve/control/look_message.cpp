// Returns many values at once, with the frames and events since the last request.
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "emulator/serve/control/debug_messages.h"
#include "emulator/serve/control/listing.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/reply_text.h"
#include "emulator/serve/control/status_parts.h"
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

constexpr std::size_t kMaxInReply = 200;  // frames or events per reply
constexpr std::size_t kMaxNames = 2'000;

void add_value(ReplyText& text, const world::LookedNames::Looked& looked) {
  if (const auto* number = std::get_if<world::Number>(&looked)) {
    return number->is_whole() ? text.element(number->whole()) : text.element(Json(number->real()));
  }
  const auto* drivers = std::get_if<world::TerminalDrivers>(&looked);
  text.element(drivers != nullptr ? Json(world::to_text(*drivers)) : Json());
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

/// Returns the number of the first entry in a list: "since", or the first of the "last" entries.
std::uint64_t first_wanted(const Json& message, std::uint64_t next, std::size_t max) {
  if (message.contains("since") && message.contains("last")) {
    throw MessageError("since: cannot be combined with last; expected one of them");
  }
  if (message.contains("since")) return require_count(message, "since");
  const std::uint64_t last = message.contains("last") ? require_count(message, "last") : max;
  return next - std::min<std::uint64_t>({last, max, next});
}

}  // namespace

bool Listing::add_next(ReplyText& text) {
  if (count_ == kMaxInReply) return false;
  return what_ == What::frames ? add_frame(text) : add_event(text);
}

bool Listing::add_frame(ReplyText& text) {
  const auto some = daemon_.frames().since(next_, 1);
  if (some.empty()) {
    if (count_ == 0) next_ = daemon_.frames().next_number();
    return false;
  }
  const world::FrameLog::Decoded& entry = some.front();
  Json frame{{"number", entry.number},
             {"time_ns", entry.time.count()},
             {"line", entry.line},
             {"way", entry.direction == pty::Direction::from_host ? "in" : "out"},
             {"text", entry.text}};
  if (!entry.remark.empty()) frame["remark"] = entry.remark;
  if (is_raw_) {
    frame["bytes"] = hex_of(entry.bytes);
    if (entry.latency) frame["latency_ns"] = entry.latency->count();
    if (entry.is_refusal) frame["exception"] = true;
    if (entry.is_ignored) frame["ignored"] = true;
    if (entry.request) frame["request"] = *entry.request;
    for (const Device* const device : entry.devices) frame["devices"].push_back(device->name());
  }
  text.element(frame);
  next_ = entry.number + 1;
  ++count_;
  return true;
}

bool Listing::add_event(ReplyText& text) {
  world::EventLog& events = daemon_.observers().events;
  if (events.collect(1)) return true;  // many frames may result in no event, so each frame counts as a step
  const auto some = events.since(next_, 1);
  if (some.empty()) {
    if (count_ == 0) next_ = events.next_number();
    return false;
  }
  const world::Event& event = some.front();
  Json entry{{"number", event.number}, {"time_ns", event.time.count()}, {"what", event.what}};
  const auto add = [&](const char* key, const std::string& what) {
    if (!what.empty()) entry[key] = what;
  };
  add("by", event.by);
  add("line", event.line);
  add("device", event.device);
  add("name", event.name);
  if (!event.value.empty()) entry["value"] = json_of(std::stod(event.value));
  add("text", event.text);
  text.element(entry);
  next_ = event.number + 1;
  ++count_;
  return true;
}

namespace {

/// Returns only frames, or only events.
ReplyTask tell_listing(Daemon& daemon, Json message, Listing::What what) {
  const Pause pause(daemon);
  daemon.catch_up();
  world::EventLog& events = daemon.observers().events;
  const bool are_events = what == Listing::What::events;
  while (are_events && events.collect(1)) co_await pause;
  const std::uint64_t next = are_events ? events.next_number() : daemon.frames().next_number();
  const bool is_raw = message.contains("raw") && message["raw"] == true;
  Listing listing(daemon, what, first_wanted(message, next, kMaxInReply), is_raw);
  ReplyText text;
  text.open_list(are_events ? "events" : "frames");
  while (listing.add_next(text)) co_await pause;
  text.close_list();
  text.member("next", listing.next());
  co_return text.take();
}

}  // namespace

ReplyTask events_message(Daemon& daemon, Json message) {
  require_keys(message, {"do", "since", "last"});
  return tell_listing(daemon, std::move(message), Listing::What::events);
}

ReplyTask frames_message(Daemon& daemon, Json message) {
  require_keys(message, {"do", "since", "last", "raw"});
  return tell_listing(daemon, std::move(message), Listing::What::frames);
}

namespace {

/// Returns the list of names in the message, which contains either all names or the number of a list. Returns
/// nothing if it contains neither.
std::optional<std::uint64_t> require_list(world::LookedNames& known, const Json& message) {
  if (message.contains("look")) {
    if (message.contains("names"))
      throw MessageError("look: cannot be combined with names; expected one of them");
    const std::uint64_t list = require_count(message, "look");
    if (!known.is_kept(list)) throw MessageError("look: these names are no longer stored; expected names");
    return list;
  }
  if (!message.contains("names")) return std::nullopt;
  const Json& names = message["names"];
  if (!names.is_array() || names.size() > kMaxNames) {
    throw is_not("names", names, "a list of at most " + std::to_string(kMaxNames) + " names");
  }
  std::vector<std::string> texts;
  texts.reserve(names.size());
  for (const Json& name : names) {
    if (!name.is_string()) throw is_not("names", names, "a list of names");
    texts.push_back(name.get_ref<const std::string&>());
  }
  return known.keep(texts);
}

}  // namespace

/// Returns the values at the moment that is stated in the reply. Frames and events have their own times.
ReplyTask look_message(Daemon& daemon, Json message) {
  require_keys(message, {"do", "look", "names", "frames", "events", "status"});
  const std::uint64_t frames = message.contains("frames") ? require_count(message, "frames") : 0;
  const std::uint64_t events = message.contains("events") ? require_count(message, "events") : 0;
  const Pause pause(daemon);
  world::LookedNames& known = daemon.observers().names;
  const auto list = require_list(known, message);
  if (list) known.begin(*list);
  while (list && known.look_up_next(*list)) co_await pause;

  daemon.catch_up();
  std::vector<world::LookedNames::Looked> values;
  if (list && !known.look(*list, values)) {
    throw MessageError("look: these names are no longer stored; expected names");
  }
  ReplyText text;
  text.member("pid", getpid());
  text.member("simulated_time_ns", daemon.world().now().count());
  text.member("restores", daemon.observers().restores);
  text.member("paused", daemon.pacer().paused());
  text.member("speed", format_speed(daemon.pacer().speed()));
  text.member("advancing", daemon.is_advancing());
  if (const Json stop = json_of_stop(daemon); !stop.is_null()) text.member("stop", stop);
  if (daemon.observers().altered_at) text.member("altered_at_ns", daemon.observers().altered_at->count());
  if (list) {
    text.member("look", *list);
    text.open_list("values");
    for (const auto& value : values) {
      add_value(text, value);
      co_await pause;
    }
    text.close_list();
  }
  if (message.contains("frames")) {
    Listing listing(daemon, Listing::What::frames, frames, true);
    text.open_list("frames");
    while (listing.add_next(text)) co_await pause;
    text.close_list();
    text.member("next_frame", listing.next());
  }
  if (message.contains("events")) {
    Listing listing(daemon, Listing::What::events, events);
    text.open_list("events");
    while (listing.add_next(text)) co_await pause;
    text.close_list();
    text.member("next_event", listing.next());
  }
  if (message.contains("status") && message["status"] == true) {
    StatusParts parts(daemon);
    text.open_object("status");
    while (parts.add_next(text)) co_await pause;
    text.close_object();
  }
  co_return text.take();
}

}  // namespace understudy::emulator::serve
