// Handles messages about the pace of time, the positions of programs, and named snapshots.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/device/device.h"
#include "emulator/device/user_program.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/world/snapshot.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kLongestName = 64;

std::string require_name(const Json& message) {
  require_keys(message, {"do", "name"});
  std::string name = require_text(message, "name");
  if (name.empty() || name.size() > kLongestName) throw MessageError("name: expected 1 to 64 bytes");
  return name;
}

Json time_of_now(const Daemon& daemon) {
  return Json{{"ok", true}, {"simulated_time_ns", daemon.world().now().count()}};
}

}  // namespace

std::string_view state_word(ProgramLocation::State state) {
  switch (state) {
    case ProgramLocation::State::stopped: return "stopped";
    case ProgramLocation::State::running: return "running";
    case ProgramLocation::State::waiting: return "waiting";
    case ProgramLocation::State::failed: return "failed";
  }
  return {};
}

Json where_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "device"});
  daemon.catch_up();
  const Device& device = daemon.world().device(require_device(daemon, message));
  Json programs = Json::array();
  if (device.powered() && device.user_program() != nullptr) {
    for (const ProgramLocation& place : device.user_program()->program_locations()) {
      Json entry{{"state", state_word(place.state)}};
      if (!place.program.empty()) entry["program"] = place.program;
      if (place.line > 0) entry["line"] = place.line;
      if (!place.text.empty()) entry["text"] = place.text;
      if (!place.waits_for.empty()) entry["waits_for"] = place.waits_for;
      if (!place.why.empty()) entry["why"] = place.why;
      if (place.until) entry["until_ns"] = place.until->count();
      programs.push_back(std::move(entry));
    }
  }
  return Json{
      {"ok", true}, {"simulated_time_ns", daemon.world().now().count()}, {"programs", std::move(programs)}};
}

Json speed_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "to"});
  const std::string text = require_text(message, "to");
  const auto speed = parse_speed(text);
  if (!speed) {
    throw MessageError("to: " + understudy::quoted(text) +
                       " is not a speed; expected real, free, manual or a factor");
  }
  if (!daemon.set_speed(*speed)) throw MessageError("time is being advanced; expected `speed` after that");
  daemon.observers().events.note("speed", format_speed(*speed));
  Json reply = time_of_now(daemon);
  reply["speed"] = format_speed(*speed);
  return reply;
}

Json snapshots_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "drop"});
  auto& kept = daemon.observers().snapshots;
  if (message.contains("drop") && kept.erase(require_text(message, "drop")) == 0) {
    throw MessageError("drop: there is no snapshot with that name");
  }
  Json snapshots = Json::array();
  for (const auto& [name, one] : kept) snapshots.push_back({{"name", name}, {"time_ns", one.at.count()}});
  return Json{{"ok", true}, {"snapshots", std::move(snapshots)}};
}

Json snapshot_by_name(Daemon& daemon, const Json& message) {
  const std::string name = require_name(message);
  auto& kept = daemon.observers().snapshots;
  if (kept.size() >= Observers::kMaxSnapshots && !kept.contains(name)) {
    throw MessageError("name: there are " + std::to_string(kept.size()) +
                       " snapshots already; expected `drop` of one of them first");
  }
  daemon.catch_up();
  kept.insert_or_assign(name, Observers::Kept{daemon.world().now(), world::save(daemon.world())});
  return time_of_now(daemon);
}

Json restore_by_name(Daemon& daemon, const Json& message) {
  const std::string name = require_name(message);
  const auto& kept = daemon.observers().snapshots;
  const auto found = kept.find(name);
  if (found == kept.end()) {
    throw MessageError("name: " + understudy::quoted(name) +
                       " is not a snapshot; expected one that `snapshots` lists");
  }
  if (const std::string_view why = daemon.why_no_restore(); !why.empty())
    throw MessageError(std::string(why));
  daemon.restore(found->second.state);
  return time_of_now(daemon);
}

}  // namespace understudy::emulator::serve
