#include "emulator/serve/control/debug_messages.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/device/program_cells.h"
#include "emulator/device/program_language.h"
#include "emulator/device/program_parts.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/terminals.h"
#include "emulator/device/user_program.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/recording_stops.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/control/way_back.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/debug/breakpoint.h"
#include "emulator/world/debug/debugger.h"
#include "emulator/world/debug/program_lines.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/names/names.h"
#include "emulator/world/probe/probes.h"

namespace understudy::emulator::serve {

namespace {

using PointKind = world::BreakpointSetup::Kind;

constexpr std::uint64_t kMaxLine = 1'000'000;
constexpr std::array<std::string_view, 5> kKinds{"line", "instruction", "when", "write", "on"};
constexpr std::array<std::pair<std::string_view, world::StepKind>, 5> kSteps{
    {{"instruction", world::StepKind::instruction},
     {"line", world::StepKind::line},
     {"over", world::StepKind::over},
     {"out", world::StepKind::out},
     {"stand", world::StepKind::stand}}};

std::string_view reason_word(world::DebugStop::Reason reason) {
  switch (reason) {
    case world::DebugStop::Reason::breakpoint: return "breakpoint";
    case world::DebugStop::Reason::step: return "step";
    case world::DebugStop::Reason::program: return "program";
    case world::DebugStop::Reason::power: return "power";
  }
  return {};
}

Json json_of_breakpoint(const Daemon& daemon, const world::Breakpoint& breakpoint) {
  const world::BreakpointSetup& setup = breakpoint.setup;
  Json entry{{"number", breakpoint.number}, {"kind", kKinds.at(static_cast<std::size_t>(setup.kind))}};
  const auto add = [&](const char* key, const std::string& text) {
    if (!text.empty()) entry[key] = text;
  };
  if (setup.kind == PointKind::line || setup.kind == PointKind::instruction) {
    entry["device"] = daemon.world().device(setup.device).name();
    add("program", setup.program);
    entry["found"] = breakpoint.line != 0;
    if (breakpoint.line != 0) entry["line"] = breakpoint.line;
    if (setup.kind == PointKind::instruction) entry["instruction"] = setup.line;
    if (setup.kind == PointKind::line && breakpoint.line != setup.line) entry["moved_from"] = setup.line;
  }
  if (setup.kind == PointKind::write) add("write", setup.name);
  if (setup.kind == PointKind::event) add("on", setup.name);
  add("by", setup.by);
  add("when", setup.condition);
  if (setup.nth != 1) entry["nth"] = setup.nth;
  add("log", setup.log);
  entry["hits"] = breakpoint.hits;
  return entry;
}

world::BreakpointSetup setup_of(const Daemon& daemon, const Json& message) {
  world::BreakpointSetup setup;
  std::string_view chosen;
  for (const std::string_view kind : {kKinds[0], kKinds[1], kKinds[3], kKinds[4]}) {
    if (!message.contains(kind)) continue;
    if (!chosen.empty())
      throw MessageError(std::string(kind) + ": cannot be combined with " + std::string(chosen) +
                         "; expected one of them");
    chosen = kind;
  }
  if (message.contains("when")) setup.condition = require_text(message, "when");
  if (message.contains("log")) setup.log = require_text(message, "log");
  if (message.contains("nth")) setup.nth = require_count(message, "nth", INT64_MAX);
  if (setup.nth == 0) throw MessageError("nth: 0 is too small; expected 1 or more");
  if (chosen.empty()) {
    if (setup.condition.empty())
      throw MessageError("nothing to stop at; expected line, instruction, when, write or on");
    setup.kind = PointKind::condition;
  } else if (chosen == "write" || chosen == "on") {
    setup.kind = chosen == "write" ? PointKind::write : PointKind::event;
    setup.name = require_text(message, std::string(chosen).c_str());
  } else {
    setup.kind = chosen == "line" ? PointKind::line : PointKind::instruction;
    setup.line = static_cast<int>(require_count(message, std::string(chosen).c_str(), kMaxLine));
    setup.device = require_device(daemon, message);
  }
  const bool is_of_program = setup.kind == PointKind::line || setup.kind == PointKind::instruction;
  if (message.contains("by")) setup.by = require_text(message, "by");
  if (!setup.by.empty() && setup.kind != PointKind::write)
    throw MessageError("by: needs write; expected both, or neither");
  if (message.contains("program")) setup.program = require_text(message, "program");
  if (!setup.program.empty() && setup.kind != PointKind::instruction)
    throw MessageError("program: needs instruction; expected both, or neither");
  if (message.contains("device") && !is_of_program)
    throw MessageError("device: needs line or instruction; expected one of them");
  return setup;
}

}  // namespace

const Device& require_program(Daemon& daemon, const Json& message) {
  const Device& device = daemon.world().device(require_device(daemon, message));
  require_power(device);
  if (device.user_program() == nullptr)
    throw MessageError(device.name() + " runs no programs; expected a device that does");
  return device;
}

world::StepKind require_step_kind(const Json& message) {
  const std::string what = require_text(message, "what");
  const auto* const found =
      std::find_if(kSteps.begin(), kSteps.end(), [&](const auto& row) { return row.first == what; });
  if (found != kSteps.end()) return found->second;
  throw MessageError("what: " + understudy::quoted(what) +
                     " is unknown; expected instruction, line, over, out or stand");
}

Json json_of_stop(const Daemon& daemon) {
  const world::DebugStop* const stop = daemon.observers().debugger.stop();
  if (stop == nullptr) return nullptr;
  Json entry{{"reason", reason_word(stop->reason)}, {"text", stop->text}};
  if (stop->breakpoint != 0) entry["breakpoint"] = stop->breakpoint;
  if (!stop->device.empty()) entry["device"] = stop->device;
  if (!stop->place.program.empty()) entry["program"] = stop->place.program;
  if (stop->place.line != 0) {
    entry["line"] = stop->place.line;
    entry["instruction"] = stop->place.number;
    entry["code"] = stop->place.text;
    entry["callers"] = stop->depth;
  }
  return entry;
}

Json time_and_stop(const Daemon& daemon) {
  Json reply{{"ok", true}, {"simulated_time_ns", daemon.world().now().count()}};
  if (Json stop = json_of_stop(daemon); !stop.is_null()) reply["stop"] = std::move(stop);
  return reply;
}

Json break_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "device", "program", "line", "instruction", "when", "write", "by", "on", "nth",
                         "log", "delete"});
  world::Debugger& debugger = daemon.observers().debugger;
  daemon.catch_up();
  if (message.contains("delete")) {
    require_keys(message, {"do", "delete"});
    if (message["delete"] == "all") {
      debugger.remove_all();
    } else {
      const auto number = static_cast<int>(require_count(message, "delete", INT32_MAX));
      if (!debugger.remove(number))
        throw MessageError("delete: there is no breakpoint " + std::to_string(number) +
                           "; expected one that `break` lists");
    }
    return Json{{"ok", true}};
  }
  if (message.size() > 1) {
    keep_course(daemon);
    try {
      return Json{{"ok", true},
                  {"breakpoint", json_of_breakpoint(daemon, debugger.add(setup_of(daemon, message)))}};
    } catch (const world::ExpressionError& error) {
      throw MessageError(std::string(message.contains("log") ? "when or log: " : "when: ") + error.what());
    }
  }
  Json breakpoints = Json::array();
  for (const world::Breakpoint& breakpoint : debugger.breakpoints())
    breakpoints.push_back(json_of_breakpoint(daemon, breakpoint));
  return Json{{"ok", true}, {"breakpoints", std::move(breakpoints)}};
}

void continue_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply) {
  if (is_way_back(message)) return reply(continue_back(daemon, message).dump());
  require_keys(message, {"do", "within", "back"});
  if (!daemon.pacer().standing() || daemon.is_advancing()) throw MessageError(std::string(kRunsByItself));
  keep_course(daemon);
  if (message.contains("within")) {
    const SimTime within = require_duration(daemon, message, "within");
    daemon.advance(within, [&daemon, reply] { reply(time_and_stop(daemon).dump()); });
    return;
  }
  if (daemon.pacer().speed().kind == Speed::Kind::manual && !daemon.is_host_timed())
    throw MessageError("'within' is missing, and the speed is manual; expected a duration");
  daemon.resume();
  reply(Json{{"ok", true}, {"simulated_time_ns", daemon.world().now().count()}}.dump());
}

void step_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply) {
  if (is_way_back(message)) return reply(step_back(daemon, message).dump());
  keep_course(daemon);
  if (!message.contains("what")) {
    require_keys(message, {"do", "ticks", "back"});
    const std::uint64_t ticks =
        message.contains("ticks") ? require_count(message, "ticks", kMaxStepTicks) : 1;
    const SimTime now = daemon.world().now();
    const SimTime end = time_of(tick_at(now) + static_cast<Tick>(ticks));
    if (ticks == 0 || end > kHorizon)
      throw MessageError("ticks: expected 1 to " + std::to_string(kMaxStepTicks));
    const bool begun = daemon.advance(end - now, [&daemon, reply] { reply(time_and_stop(daemon).dump()); });
    if (!begun) throw MessageError(std::string(kRunsByItself));
    return;
  }
  require_keys(message, {"do", "what", "device", "program", "within", "back"});
  const world::StepKind kind = require_step_kind(message);
  world::Debugger& debugger = daemon.observers().debugger;
  if (!daemon.pacer().standing() || daemon.is_advancing()) throw MessageError(std::string(kRunsByItself));
  Json where = message;
  const world::DebugStop* const stop = debugger.stop();
  if (!where.contains("device") && stop != nullptr && !stop->device.empty()) where["device"] = stop->device;
  const std::size_t device = require_device(daemon, where);
  const std::string program = message.contains("program") ? require_text(message, "program") : std::string();
  const SimTime within =
      message.contains("within") ? require_duration(daemon, message, "within") : std::chrono::hours(1);
  debugger.begin_step(kind, device, program);
  const bool begun = daemon.advance(within, [&daemon, reply] {
    daemon.observers().debugger.end_step();
    reply(time_and_stop(daemon).dump());
  });
  if (!begun) {
    debugger.end_step();
    throw MessageError("within: is beyond the end of simulated time; expected a shorter time");
  }
}

/// Returns a stack frame: the source line for a line of the listing, and its first instruction.
static Json json_of_frame(const world::ProgramLines& lines, int listing_line) {
  const int line = lines.source_line(listing_line);
  Json frame{{"line", line}};
  const auto all = lines.at(line);
  if (all.empty()) return frame;
  if (const auto place = lines.place(all.front())) {
    if (!place->program.empty()) frame["program"] = place->program;
    frame["instruction"] = place->number;
  }
  return frame;
}

/// Returns the instructions of each part, including their numbers on the line if the language has them.
static Json json_of_instructions(const Device& device, const world::ProgramLines& lines) {
  std::vector<CellRow> rows;
  if (const ProgramCells* const form = device.model().language->cells()) {
    try {
      rows = form->assemble(lines.text(), device.settings());
    } catch (const ProgramError&) {  // the text of a file may contain more than a program
    }
  }
  const bool has_lines =
      std::any_of(rows.begin(), rows.end(), [](const CellRow& row) { return row.line > 0; });
  std::map<int, std::vector<std::int64_t>> cells;  // keyed by line, or by number if the rows have no lines
  for (std::size_t i = 0; i < rows.size(); ++i)
    cells[has_lines ? rows[i].line : static_cast<int>(i)] = std::move(rows[i].cells);
  Json programs = Json::array();
  for (const ProgramPart& part : lines.parts()) {
    Json instructions = Json::array();
    for (int number = 0; number < static_cast<int>(part.lines.size()); ++number) {
      const auto place = lines.place({part.number, number});
      Json entry{{"line", place->line}, {"code", place->text}};
      if (const auto found = cells.find(has_lines ? place->line : number); found != cells.end())
        entry["cells"] = found->second;
      instructions.push_back(std::move(entry));
    }
    programs.push_back(Json{{"program", part.name}, {"instructions", std::move(instructions)}});
  }
  return programs;
}

Json stack_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "device"});
  daemon.catch_up();
  const Device& device = require_program(daemon, message);
  const world::ProgramLines lines(device);
  Json programs = Json::array();
  for (const ProgramLocation& place : device.user_program()->program_locations()) {
    Json frames = Json::array();
    if (place.line > 0) {
      frames.push_back(json_of_frame(lines, place.line));
      frames.back()["text"] = place.text;
    }
    for (const int caller : place.callers) frames.push_back(json_of_frame(lines, caller));
    Json entry{{"state", state_word(place.state)}};
    if (!place.program.empty()) entry["program"] = place.program;
    if (!place.waits_for.empty()) entry["waits_for"] = place.waits_for;
    entry["frames"] = std::move(frames);
    programs.push_back(std::move(entry));
  }
  Json reply = time_and_stop(daemon);
  if (!lines.source().empty()) reply["source"] = lines.source();
  reply["stacks"] = std::move(programs);
  return reply;
}

Json source_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "device", "instructions"});
  daemon.catch_up();
  const Device& device = require_program(daemon, message);
  const world::ProgramLines lines(device);
  Json reply{{"ok", true}};
  if (!lines.source().empty()) {
    std::error_code error;
    const auto path = std::filesystem::weakly_canonical(lines.source(), error);
    reply["path"] = error ? lines.source() : path.string();
  }
  reply["text"] = lines.text();
  reply["lines"] = lines.lines();
  if (flag_or_false(message, "instructions")) reply["programs"] = json_of_instructions(device, lines);
  return reply;
}

}  // namespace understudy::emulator::serve
