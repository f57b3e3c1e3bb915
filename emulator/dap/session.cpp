// Receives requests, calls the function that answers each, and sends replies and events.
#include "emulator/dap/session.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/one_line.h"
#include "emulator/dap/arguments.h"
#include "emulator/dap/bench_link.h"

namespace understudy::emulator::dap {

namespace {

using Phase = Session::Phase;

constexpr unsigned in(Phase phase) { return 1U << static_cast<unsigned>(phase); }
constexpr unsigned kFresh = in(Phase::fresh);
constexpr unsigned kReady = in(Phase::ready);
constexpr unsigned kConfiguring = in(Phase::configuring);
constexpr unsigned kStopped = in(Phase::stopped);
constexpr unsigned kRunning = in(Phase::running);
constexpr unsigned kThere = kConfiguring | kStopped | kRunning;
constexpr unsigned kAny = kFresh | kReady | kThere | in(Phase::ended);

std::string_view word_of(Phase phase) {
  switch (phase) {
    case Phase::fresh: return "the session is not initialized; expected `initialize` first";
    case Phase::ready: return "no bench has been launched; expected `launch` or `attach` first";
    case Phase::configuring: return "the session is being configured; expected `configurationDone` first";
    case Phase::stopped: return "the bench has stopped; expected it to run";
    case Phase::running: return "the bench is running; expected it to be stopped by `pause`";
    case Phase::ended:
    case Phase::over: return "the bench has ended; expected `disconnect`";
  }
  return {};
}

/// An event that can stop the bench, besides breakpoints on lines and values.
struct Filter {
  const char* name;
  const char* label;
  const char* description;
};
constexpr std::array<Filter, 7> kFilters{
    {{"program-error", "A program fails", "A program stops because of an error"},
     {"exception", "A request is refused", "A device answers a host with a Modbus exception"},
     {"ignored", "A command has no effect", "A device accepts a command but does not execute it"},
     {"dropped", "A frame is not received", "A frame is dropped, or a fault affects it"},
     {"fault", "A fault begins or ends", "An injected fault takes effect, or ends"},
     {"alarm", "A drive has an alarm", "The drive of an axis reports its alarm"},
     {"limit", "A limit switch is reached", "A machine reaches a limit switch"}}};

}  // namespace

std::span<const Session::Row> Session::rows() {
  using S = Session;
  static constexpr std::array<Row, 30> kRows{{
      {"initialize", &S::initialize, kFresh},
      {"launch", &S::launch, kReady},
      {"attach", &S::attach, kReady},
      {"configurationDone", &S::configuration_done, kConfiguring},
      {"setBreakpoints", &S::set_breakpoints, kThere},
      {"breakpointLocations", &S::breakpoint_locations, kThere},
      {"setExceptionBreakpoints", &S::set_exception_breakpoints, kThere},
      {"setDataBreakpoints", &S::set_data_breakpoints, kThere},
      {"dataBreakpointInfo", &S::data_breakpoint_info, kThere},
      {"setInstructionBreakpoints", &S::set_instruction_breakpoints, kThere},
      {"disassemble", &S::disassemble, kThere},
      {"threads", &S::threads, kThere},
      {"stackTrace", &S::stack_trace, kThere},
      {"source", &S::source, kThere},
      {"scopes", &S::scopes, kThere},
      {"variables", &S::variables, kThere},
      {"setVariable", &S::set_variable, kThere},
      {"setExpression", &S::set_expression, kThere},
      {"evaluate", &S::evaluate, kThere},
      {"completions", &S::completions, kThere},
      {"continue", &S::continue_program, kStopped},
      {"next", &S::next, kStopped},
      {"stepIn", &S::step_in, kStopped},
      {"stepOut", &S::step_out, kStopped},
      {"stepBack", &S::step_back, kStopped},
      {"reverseContinue", &S::reverse, kStopped},
      {"pause", &S::pause, kStopped | kRunning},
      {"restart", &S::restart, kStopped | kRunning},
      {"terminate", &S::terminate, kAny},
      {"disconnect", &S::disconnect, kAny},
  }};
  return kRows;
}

void Session::handle(const std::string& text) {
  const Json message = parsed_message(text);
  if (!message.is_object() || !message.contains("seq") || !message["seq"].is_number_integer())
    return print("a message is not a request; expected an object with seq, type and command\n");
  Json reply{{"seq", 0}, {"type", "response"}, {"request_seq", message["seq"]}, {"success", true}};
  std::string command;
  const Phase before = phase_;
  try {
    if (text_or(message, "type") != "request") throw RequestError("type: expected \"request\"");
    command = require_text(message, "command");
    const Json arguments = message.value("arguments", Json());
    if (!arguments.is_object() && !arguments.is_null()) throw RequestError("arguments: expected an object");
    Json body = answer(command, arguments.is_null() ? Json::object() : arguments);
    if (!body.is_null()) reply["body"] = std::move(body);
  } catch (const std::exception& error) {
    const std::string why = (command.empty() ? "" : one_line(command) + ": ") + one_line(error.what());
    reply["success"] = false;
    reply["message"] = why;
    reply["body"] = {{"error", {{"id", 1}, {"format", why}, {"showUser", true}}}};
  }
  reply["command"] = command;
  reply["seq"] = next_sequence_++;
  send_(reply);
  // A client waits for these after the reply.
  if (phase_ == Phase::configuring && before == Phase::ready) event("initialized", nullptr);
  if (before == Phase::configuring && phase_ == Phase::stopped) stop_at_entry();
  if (phase_ == Phase::ended && before != Phase::ended) event("terminated", nullptr);
}

Json Session::answer(const std::string& command, const Json& arguments) {
  const auto all = rows();
  const auto row =
      std::find_if(all.begin(), all.end(), [&](const Row& one) { return one.command == command; });
  if (row == all.end())
    throw RequestError("this request is unknown; expected one that the capabilities list");
  if ((row->phases & in(phase_)) == 0) throw RequestError(std::string(word_of(phase_)));
  return (this->*row->answer)(arguments);
}

void Session::event(std::string_view name, Json body) {
  Json message{{"seq", next_sequence_++}, {"type", "event"}, {"event", name}};
  if (!body.is_null()) message["body"] = std::move(body);
  send_(message);
}

void Session::print(const std::string& text, const char* category) {
  event("output", {{"category", category}, {"output", text}});
}

Json Session::initialize(const Json& arguments) {
  if (text_or(arguments, "pathFormat", "path") != "path")
    throw RequestError("pathFormat: this path format is unknown; expected path");
  line_offset_ = flag_or(arguments, "linesStartAt1", true) ? 0 : 1;
  column_offset_ = flag_or(arguments, "columnsStartAt1", true) ? 0 : 1;
  phase_ = Phase::ready;
  Json filters = Json::array();
  for (const Filter& filter : kFilters) {
    filters.push_back({{"filter", filter.name},
                       {"label", filter.label},
                       {"description", filter.description},
                       {"supportsCondition", true},
                       {"default", std::string_view(filter.name) == "program-error"}});
  }
  Json capabilities{{"exceptionBreakpointFilters", std::move(filters)}};
  for (const char* able :
       {"supportsConfigurationDoneRequest", "supportsConditionalBreakpoints",
        "supportsHitConditionalBreakpoints", "supportsLogPoints", "supportsEvaluateForHovers",
        "supportsSetVariable", "supportsSetExpression", "supportsCompletionsRequest",
        "supportsDataBreakpoints", "supportsSteppingGranularity", "supportsRestartRequest",
        "supportsTerminateRequest", "supportsBreakpointLocationsRequest", "supportsExceptionFilterOptions",
        "supportsValueFormattingOptions", "supportsStepBack", "supportsDisassembleRequest",
        "supportsInstructionBreakpoints"})
    capabilities[able] = true;
  return capabilities;
}

}  // namespace understudy::emulator::dap
