// Handles single shots of the oscilloscope, and bytes that a user sends to a line.
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
#include "base/text/one_line.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/reply_text.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/ports/port.h"
#include "emulator/world/look/scope.h"
#include "emulator/world/world.h"
#include "pty/line.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMaxSamples = 500;  // maximum number of samples per name in a reply
constexpr std::size_t kMaxBytes = 512;

std::string_view state_word(world::Scope::State state) {
  switch (state) {
    case world::Scope::State::armed: return "armed";
    case world::Scope::State::triggered: return "triggered";
    case world::Scope::State::done: return "done";
  }
  return {};
}

Tick ticks_of(const Json& message, const char* key, Tick otherwise) {
  if (!message.contains(key)) return otherwise;
  const auto time = message[key].is_string() ? parse_duration(message[key].get<std::string>()) : std::nullopt;
  if (!time || *time < SimTime{0} || *time > time_of(world::ScopeSetup::kMaxTicks)) {
    throw is_not(key, message[key], "a duration of at most 10s", "one such as \"500ms\"");
  }
  return tick_at(*time);
}

world::ScopeSetup scope_setup(const Json& message) {
  require_keys(message, {"do", "names", "condition", "before", "after"});
  world::ScopeSetup setup;
  const Json& names = message["names"];
  if (!names.is_array() || names.empty() || names.size() > world::ScopeSetup::kMaxNames) {
    throw is_not("names", names, "a list of 1 to " + std::to_string(world::ScopeSetup::kMaxNames) + " names");
  }
  for (const Json& name : names) {
    if (!name.is_string()) throw is_not("names", names, "a list of names");
    setup.names.push_back(name.get<std::string>());
  }
  if (message.contains("condition")) setup.condition = require_text(message, "condition");
  setup.before = ticks_of(message, "before", setup.before);
  setup.after = ticks_of(message, "after", setup.after);
  return setup;
}

Json course_of_scope(const world::Scope& scope) {
  Json entry{{"state", state_word(scope.state())},   {"names", scope.setup().names},
             {"condition", scope.setup().condition}, {"from_ns", time_of(scope.first_tick()).count()},
             {"step_ns", kTickLength.count()},       {"count", scope.count()}};
  if (scope.state() != world::Scope::State::armed)
    entry["trigger_ns"] = time_of(scope.trigger_tick()).count();
  if (!scope.diagnostic().empty()) entry["error"] = scope.diagnostic();
  return entry;
}

std::optional<std::vector<std::uint8_t>> bytes_of(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  int digits = 0;
  unsigned value = 0;
  for (const char letter : text) {
    if (letter == ' ') {
      if (digits == 1) return std::nullopt;
      continue;
    }
    const std::size_t digit = std::string_view("0123456789abcdef0123456789ABCDEF").find(letter);
    if (digit == std::string_view::npos) return std::nullopt;
    value = value << 4U | digit % 16;
    if (++digits < 2) continue;
    bytes.push_back(static_cast<std::uint8_t>(value));
    digits = 0;
    value = 0;
  }
  if (digits != 0 || bytes.empty() || bytes.size() > kMaxBytes) return std::nullopt;
  return bytes;
}

const Port& require_port(const Daemon& daemon, const Json& message) {
  const auto& ports = daemon.ports();
  if (!message.contains("line") && ports.size() == 1) return *ports.front();
  std::string names;
  for (const auto& port : ports) {
    const std::string& name = daemon.world().line(port->line_number()).line.name();
    if (message.contains("line") && message["line"] == name) return *port;
    names += (names.empty() ? "" : ", ") + name;
  }
  if (!message.contains("line")) throw MessageError("'line' is missing; expected one of " + names);
  const std::string wanted = require_text(message, "line");
  // The user may have written "01 03" without quotes.
  const std::string hint = bytes_of(wanted) ? "; put the bytes in quotes, as one word" : "";
  throw MessageError("line: " + understudy::quoted(wanted) + " is unknown; expected one of " + names + hint);
}

}  // namespace

namespace {

Json scope_reply(const world::Scope* scope) {
  return Json{{"ok", true}, {"scope", scope != nullptr ? course_of_scope(*scope) : Json()}};
}

/// Returns samples. They are all copied at the same moment, and then written in pieces.
ReplyTask samples_message(Daemon& daemon, std::uint64_t from) {
  const Pause pause(daemon);
  const world::Scope& scope = *daemon.observers().scope;
  const std::uint64_t count = scope.count();
  const std::uint64_t end = std::min<std::uint64_t>(count, from + kMaxSamples);
  std::vector<std::vector<double>> samples(scope.setup().names.size());
  for (std::size_t name = 0; name < samples.size(); ++name) {
    for (std::uint64_t place = from; place < end; ++place) samples[name].push_back(scope.sample(name, place));
  }
  ReplyText text;
  text.member("scope", course_of_scope(scope));
  text.open_list("samples");
  for (const std::vector<double>& of_name : samples) {
    text.open_list();
    for (const double sample : of_name) {
      text.element(json_of(sample));
      co_await pause;
    }
    text.close_list();
  }
  text.close_list();
  if (end < count) text.member("next", end);
  co_return text.take();
}

/// Returns a reply that consists of one piece.
ReplyTask reply_of(Json reply) { co_return text_of(reply); }

}  // namespace

ReplyTask scope_message(Daemon& daemon, Json message) {
  auto& scope = daemon.observers().scope;
  if (message.contains("names")) {
    world::ScopeSetup setup = scope_setup(message);
    daemon.catch_up();
    auto armed = std::make_unique<world::Scope>(daemon.world(), std::move(setup));
    scope = std::move(armed);
    return reply_of(scope_reply(scope.get()));
  }
  require_keys(message, {"do", "from", "off"});
  daemon.catch_up();
  if (message.contains("off")) scope.reset();
  if (!scope || !message.contains("from")) return reply_of(scope_reply(scope.get()));
  return samples_message(daemon, require_count(message, "from"));
}

Json send_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "line", "bytes", "text", "checksum"});
  const Port& port = require_port(daemon, message);
  world::World& world = daemon.world();
  const world::WorldLine& line = world.line(port.line_number());
  std::vector<std::uint8_t> bytes;
  if (message.contains("text")) {
    const std::string text = require_text(message, "text");
    if (message.contains("bytes") || text.empty() || text.size() > kMaxBytes) {
      throw MessageError("text: expected 1 to " + std::to_string(kMaxBytes) + " bytes, without \"bytes\"");
    }
    bytes.assign(text.begin(), text.end());
    if (line.protocol.carries_text() && text.back() != '\r' && text.back() != '\n') bytes.push_back('\r');
  } else {
    const auto parsed = bytes_of(require_text(message, "bytes"));
    if (!parsed)
      throw is_not("bytes", message["bytes"], "hexadecimal digits", "bytes such as \"01 03 00 00 00 01\"");
    bytes = *parsed;
  }
  if (message.contains("checksum") && message["checksum"] == true) understudy::pty::append_rtu_crc(bytes);
  daemon.catch_up_for_bytes();
  const std::string& name = line.line.name();
  if (port.host_present()) {
    throw MessageError(name +
                       ": a host has the line open and would receive the reply; expected it to be closed");
  }
  if (line.line.due() || line.line.room() < bytes.size()) {
    throw MessageError(name + ": bytes are in transit on the line; expected an idle line");
  }
  // The bytes arrive as if from a host that has closed the port: the reply appears in `frames`, but no host
  // receives it.
  const std::uint64_t next = daemon.frames().next_number();
  world.receive_departed(port.line_number(), bytes);
  world.advance_to(world.now());
  return Json{{"ok", true}, {"next_frame", next}};
}

}  // namespace understudy::emulator::serve
