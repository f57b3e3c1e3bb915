// Handles messages through which a user acts on devices and machines from outside: inputs, power, programs,
// faults.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/more_mistakes.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/user_program.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/check_fault.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/trigger.h"
#include "emulator/world/names/level.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::serve {

namespace {

bool is_whole(const Json& value) {
  const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
  return value.is_number_integer() && !huge;
}

/// Reads an integer, or a level as text.
std::int64_t level_of(const Json& value, const std::string& name, TerminalRow::Kind kind) {
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  if (is_whole(value)) return value.get<std::int64_t>();
  const auto level = value.is_string() ? world::parse_level(value.get<std::string>(), kind) : std::nullopt;
  if (!level) throw is_not(name, value, "a level", world::level_example(kind));
  return *level;
}

std::int32_t require_level(const Json& value, const std::string& name, const TerminalRow& row) {
  const std::int64_t level = level_of(value, name, row.kind);
  world::require_level(row, name, level);
  return static_cast<std::int32_t>(level);
}

/// Returns the value of a fault's field as text.
std::string field_of(const Json& value, const std::string& name) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  if (!value.is_number_integer()) throw is_not(name, value, "a whole number or a text");
  return value.dump();
}

/// Describes a fault and its effects so far.
Json course_of(std::size_t number, const world::ArmedFault& armed, const world::KnownDevices& known) {
  const auto& [fault, course] = armed;
  Json entry{{"number", number}, {"fault", world::to_text(known, fault)}};
  if (!world::waits(fault)) return entry;
  if (world::is_of_frames(fault.kind) || world::is_about_frames(fault.trigger)) entry["seen"] = course.seen;
  entry["matched"] = course.matched;
  entry["hits"] = course.hits;
  if (!world::is_of_frames(fault.kind)) entry["in_force"] = course.in_force;
  return entry;
}

Json mistakes_as_json(const std::vector<ProgramMistake>& mistakes) {
  Json list = Json::array();
  for (const ProgramMistake& mistake : mistakes) {
    list.push_back({{"line", mistake.line}, {"column", mistake.column}, {"what", mistake.what}});
  }
  return list;
}

/// Returns the refusal of a program: the first mistake as text for people, and all mistakes as data for
/// programs.
Json refusal_of(const std::vector<ProgramMistake>& mistakes) {
  return Json{{"ok", false},
              {"error", in_text(mistakes.front()) + and_more(mistakes)},
              {"mistakes", mistakes_as_json(with_word_of_more(mistakes))}};
}

/// Returns a text such as "it is busy (reason 5)". The number is the device's own reason code.
std::string why_refused(const Objection& refused) {
  const std::string reason = refused.reason == 0 ? "" : " (reason " + std::to_string(refused.reason) + ")";
  switch (refused.refusal) {
    case Refusal::busy: return "it is busy" + reason;
    case Refusal::failure: return "it has failed" + reason;
    case Refusal::none:
    case Refusal::no_register:
    case Refusal::bad_value: break;
  }
  return "the command is not accepted" + reason;
}

}  // namespace

Json input_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "values"});
  const Json& values = require_values(message, "names and levels");
  daemon.catch_up();
  const world::KnownDevices& known = daemon.world().known();
  std::vector<world::InputSetup> wanted;
  for (const auto& [name, value] : values.items()) {
    const world::InputName input = world::find_input(known, name);
    for (const world::InputSetup& other : wanted) {
      if (other.device == input.device && other.terminal == input.terminal) {
        throw MessageError(name + ": appears twice; expected it only once");
      }
    }
    wanted.push_back({.device = input.device,
                      .terminal = input.terminal,
                      .level = require_level(value, name, input.row(known))});
  }
  for (const world::InputSetup& input : wanted) {
    daemon.world().set_external_input(input.device, input.terminal, input.level);
  }
  return Json{{"ok", true}};
}

Json turn_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "values", "in"});
  const Json& values = require_values(message, "names and counts");
  daemon.catch_up();
  std::vector<world::Fault> turns;
  for (const auto& [name, value] : values.items()) {
    if (!is_whole(value)) throw is_not(name, value, "a whole number", "counts, such as 400");
    world::FaultText text{
        .kind = "turn", .place = name, .fields = {{"counts", std::to_string(value.get<std::int64_t>())}}};
    if (message.contains("in")) text.fields.emplace_back("in", require_text(message, "in"));
    try {
      turns.push_back(world::find_fault(daemon.world().known(), text));
      world::check_fault(daemon.world(), turns.back());
    } catch (const world::NameError& error) {
      // The message of a fault begins with its kind, which is also the name of this command.
      const std::string_view what = error.what();
      constexpr std::string_view kKind = "turn: ";
      throw MessageError(std::string(what.starts_with(kKind) ? what.substr(kKind.size()) : what));
    }
  }
  for (const world::Fault& turn : turns) daemon.world().inject(turn);
  return Json{{"ok", true}};
}

Json command_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "device", "text"});
  const std::size_t number = require_device(daemon, message);
  const std::string text = require_text(message, "text");
  daemon.catch_up();
  const Device& device = daemon.world().device(number);
  require_power(device);
  Objection refused;
  try {
    refused = daemon.world().command(number, text);
  } catch (const ProgramError& error) {
    throw MessageError(in_line(error.first()));
  }
  if (refused) throw MessageError(device.name() + " refuses it: " + why_refused(refused));
  return Json{{"ok", true}};
}

Json power_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "device", "to"});
  const std::string to = require_text(message, "to");
  if (to != "on" && to != "off" && to != "cycle") {
    throw MessageError("to: " + understudy::quoted(to) + " is unknown; expected on, off or cycle");
  }
  const std::size_t device = require_device(daemon, message);
  daemon.catch_up();
  if (to != "on") daemon.world().switch_power(device, false);
  if (to != "off") daemon.world().switch_power(device, true);
  return Json{{"ok", true}};
}

namespace {

Json load_program(Daemon& daemon, std::size_t number, const std::string& text) {
  daemon.catch_up();
  const Device& device = daemon.world().device(number);
  require_power(device);
  try {
    daemon.world().load_program(number, text);
  } catch (const ProgramError& error) {
    return refusal_of(error.mistakes);
  }
  Json reply{{"ok", true}};
  const auto warnings = program_warnings(device.model(), text, device.settings());
  if (!warnings.empty()) reply["warnings"] = mistakes_as_json(warnings);
  return reply;
}

}  // namespace

void program_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply) {
  require_keys(message, {"do", "device", "text"});
  const std::size_t number = require_device(daemon, message);
  const Device& device = daemon.world().device(number);
  require_power(device);
  if (!message.contains("text")) {
    return answer(reply, [&] {
      daemon.catch_up();
      const UserProgram* const program = device.user_program();
      return Json{{"ok", true}, {"text", program != nullptr ? program->program_text() : ""}};
    });
  }
  const std::string text = require_text(message, "text");
  if (text.size() <= kMaxAtOnce) return answer(reply, [&] { return load_program(daemon, number, text); });
  // The check runs in a helper thread, because a message may be much longer than any program that fits in a
  // device. Loading a valid program is fast.
  daemon.do_aside([&daemon, &model = device.model(), settings = device.settings(), number, text,
                   author = daemon.observers().events.author(), reply]() -> std::function<void()> {
    std::vector<ProgramMistake> mistakes = check_program(model, text, settings);
    return [&daemon, number, text, author, reply, mistakes = std::move(mistakes)] {
      answer(reply, [&] {
        daemon.observers().events.set_author(author);
        return mistakes.empty() ? load_program(daemon, number, text) : refusal_of(mistakes);
      });
    };
  });
}

Json inject_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "fault"});
  const Json& entries = require(message, "fault");
  if (!entries.is_object() || entries.empty() || !entries.front().is_string()) {
    throw MessageError("fault: expected an object such as {\"stall\":\"feeder.A\"}");
  }
  world::FaultText text{};
  for (const auto& [key, value] : entries.items()) {
    if (&value != &entries.front()) {
      text.fields.emplace_back(key, field_of(value, key));
      continue;
    }
    text.kind = key;
    text.place = value.get<std::string>();
  }
  const world::Fault fault = world::find_fault(daemon.world().known(), text);
  daemon.catch_up();
  return Json{{"ok", true}, {"number", daemon.world().inject(fault)}};
}

namespace {

/// Returns a text such as "one of 1, 4".
std::string numbers_of_faults(const world::World& world) {
  constexpr std::size_t kMaxListed = 8;
  std::string numbers;
  std::size_t count = 0;
  for (const auto& [number, armed] : world.faults()) {
    if (++count > kMaxListed) return "one of " + numbers + ", ...";
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(number);
  }
  return numbers.empty() ? "no number, because no fault is in force" : "one of " + numbers;
}

}  // namespace

Json clear_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "number"});
  daemon.catch_up();
  world::World& world = daemon.world();
  if (!message.contains("number")) {
    world.clear_faults();
    return Json{{"ok", true}};
  }
  const Json& number = message["number"];
  if (!is_whole(number)) throw is_not("number", number, "a whole number");
  const bool is_present = number.get<std::int64_t>() >= 0 && world.clear_fault(number.get<std::size_t>());
  if (!is_present) throw is_not("number", number, "a fault in force", numbers_of_faults(world));
  return Json{{"ok", true}};
}

Json faults_message_part(const world::World& world) {
  Json faults = Json::array();
  for (const auto& [number, armed] : world.faults())
    faults.push_back(course_of(number, armed, world.known()));
  return faults;
}

Json list_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do"});
  daemon.catch_up();
  return Json{{"ok", true}, {"faults", faults_message_part(daemon.world())}};
}

}  // namespace understudy::emulator::serve
