// Continues, steps and pauses on request, and follows what happens on the bench meanwhile.
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "emulator/dap/arguments.h"
#include "emulator/dap/bench_link.h"
#include "emulator/dap/session.h"

namespace understudy::emulator::dap {

namespace {

constexpr int kMaxPages = 50;  // pages of events in one look

}  // namespace

Json Session::continue_program(const Json& /*arguments*/) {
  goes_back_ = false;
  if (is_recording_) {
    link_->begin({{"do", "continue"}});
  } else if (is_manual_) {
    link_->begin({{"do", "continue"}, {"within", kLongTime}});
  } else {
    link_->ask({{"do", "resume"}});
  }
  phase_ = Phase::running;
  return {{"allThreadsContinued", true}};
}

Json Session::next(const Json& arguments) {
  const bool is_small = text_or(arguments, "granularity") == "instruction";
  return step(arguments, is_small ? "instruction" : "over");
}

Json Session::step_out(const Json& arguments) { return step(arguments, "out"); }

Json Session::step_in(const Json& arguments) {
  const bool is_small = text_or(arguments, "granularity") == "instruction";
  return step(arguments, is_small ? "instruction" : "line");
}

Json Session::step_back(const Json& arguments) {
  return step(arguments, text_or(arguments, "granularity") == "instruction" ? "instruction" : "line", true);
}

Json Session::reverse(const Json& /*arguments*/) {
  goes_back_ = true;
  link_->begin({{"do", "continue"}, {"back", true}});
  phase_ = Phase::running;
  return nullptr;
}

/// A refusal arrives in the reply at the end of the step (look()).
Json Session::step(const Json& arguments, const char* what, bool is_back) {
  const Thread& thread = thread_of(arguments);
  goes_back_ = is_back;
  Json message{{"do", "step"}, {"what", what}, {"device", devices_[thread.device].name}};
  if (is_back) {
    message["back"] = true;
  } else if (!is_recording_) {
    message["within"] = kLongTime;
  }
  if (!thread.program.empty()) message["program"] = thread.program;
  link_->begin(message);
  phase_ = Phase::running;
  return nullptr;
}

/// look() reports the stop. A recording also stops by itself at its end.
Json Session::pause(const Json& /*arguments*/) {
  if (is_recording_) return nullptr;
  link_->ask({{"do", "pause"}});
  wants_pause_ = phase_ == Phase::running;
  return nullptr;
}

/// Returns DAP's word for a stop, and adds the breakpoint.
const char* Session::reason_of(const Json& stop, Json& body) const {
  if (!stop.contains("breakpoint")) return "step";
  for (const SetPoint& point : points_) {
    if (stop["breakpoint"] != point.number) continue;
    body["hitBreakpointIds"] = {point.id};
    if (point.key == kData) return "data breakpoint";
    if (point.key == kInstructions) return "instruction breakpoint";
    if (point.key == kEvents) return "exception";
  }
  return "breakpoint";
}

/// Reports that the bench has stopped: where `stop` says, or for the given reason.
void Session::report_stop(const Json& stop, const char* reason, const std::string& text) {
  phase_ = Phase::stopped;
  wants_pause_ = false;
  stop_ = stop;
  Json body{{"reason", reason}, {"allThreadsStopped", true}};
  std::string reason_text = text;
  std::size_t device = 0;
  while (device + 1 < devices_.size() && !devices_[device].has_program) ++device;
  std::string program;
  if (stop_.is_object()) {
    body["reason"] = reason_of(stop_, body);
    reason_text = stop_.value("text", std::string());
    for (std::size_t d = 0; d < devices_.size(); ++d) {
      if (devices_[d].name == stop_.value("device", std::string())) device = d;
    }
    program = devices_.empty() || !devices_[device].has_many ? "" : text_or(stop_, "program");
  }
  if (!reason_text.empty()) {
    body["description"] = reason_text;
    body["text"] = reason_text;
  }
  if (!devices_.empty()) {
    if (program.empty() && devices_[device].has_many) {  // take the first of its programs
      const Json stacks = stack_of(device)["stacks"];
      if (!stacks.empty()) program = stacks[0].value("program", std::string());
    }
    body["threadId"] = thread_number(device, program);
  }
  event("stopped", std::move(body));
}

/// Shows the output of logpoints. Reports breakpoints that have moved because another program was loaded.
void Session::receive_events(const Json& events) {
  bool may_have_moved = false;
  std::map<int, Json> places;  // of logpoints, by their numbers
  for (const Json& one : events) {
    const std::string what = one.value("what", std::string());
    may_have_moved = may_have_moved || what == "program" || what == "power" || what == "restored";
    if (what != "logpoint") continue;
    Json body{{"category", "console"}, {"output", one.value("text", std::string()) + "\n"}};
    for (const SetPoint& point : points_) {
      if (one.value("value", 0) != point.number || point.line == 0) continue;
      auto [place, is_new] = places.try_emplace(point.number);
      if (is_new) place->second = source_json(point.device);
      body["source"] = place->second;
      body["line"] = point.line - line_offset_;
    }
    event("output", std::move(body));
  }
  if (!may_have_moved || points_.empty()) return;
  for (const Json& reported : link_->ask_for("breakpoints", {{"do", "break"}})) {
    for (SetPoint& point : points_) {
      const int line = reported.value("line", 0);
      if (reported["number"] != point.number || point.line == line) continue;
      point.line = line;
      Json changed{{"id", point.id}, {"verified", line != 0}};
      if (line != 0) changed["line"] = line - line_offset_;
      event("breakpoint", {{"reason", "changed"}, {"breakpoint", std::move(changed)}});
    }
  }
}

/// Handles the new events of the bench, then returns its state.
Json Session::check_bench() {
  Json seen;
  for (int page = 0; page < kMaxPages; ++page) {
    seen = link_->ask({{"do", "look"}, {"events", next_event_}});
    const Json events = seen.value("events", Json::array());
    if (events.empty()) break;
    receive_events(events);
    next_event_ = seen.value("next_event", next_event_);
  }
  if (launched_.news) {
    const std::string news = launched_.news();
    if (!news.empty()) print(news, "stderr");
  }
  is_manual_ = seen.value("speed", std::string()) == "manual";
  return seen;
}

/// Follows a clock that something other than this session has stopped or started.
void Session::follow(const Json& seen) {
  if (link_->is_awaiting()) {
    // The advance may have begun after the `pause`.
    if (wants_pause_ && seen.value("advancing", false)) link_->ask({{"do", "pause"}});
    return;
  }
  const bool is_held = (is_manual_ || seen.value("paused", false)) && !seen.value("advancing", false);
  if (phase_ == Phase::running && is_held) return report_stop(seen.value("stop", Json()), "pause");
  if (phase_ == Phase::stopped && !is_held) {  // somebody else has continued it
    phase_ = Phase::running;
    event("continued", {{"threadId", 1}, {"allThreadsContinued", true}});
  }
}

void Session::has_ended(const std::string& why) {
  print(why + "\n");
  if (launched_.news) print(launched_.news(), "stderr");
  end();
  phase_ = Phase::ended;
  event("terminated", nullptr);
}

void Session::poll() {
  try {
    std::optional<Json> reply;
    std::string refusal;
    try {
      if (link_->is_awaiting()) reply = link_->take_reply();
    } catch (const GoneError&) {
      throw;
    } catch (const RequestError& error) {
      refusal = error.what();
      reply = Json::object();
    }
    // The events before an earlier moment have been reported already.
    if (reply && goes_back_)
      next_event_ = link_->ask({{"do", "events"}, {"last", 0}}).value("next", next_event_);
    const Json seen = check_bench();
    if (!reply) return follow(seen);
    if (!refusal.empty()) print(refusal + "\n");
    std::string text = refusal;
    if (text.empty() && is_recording_)
      text = goes_back_ ? "the recording begins here" : "the recording ends here";
    if (text.empty() && goes_back_) text = "debugging began here";
    if (text.empty() && !wants_pause_) text = "nothing stopped the bench within " + std::string(kLongTime);
    report_stop(reply->value("stop", Json()), refusal.empty() ? "pause" : "step", text);
  } catch (const RequestError& error) {
    has_ended(error.what());
  }
}

}  // namespace understudy::emulator::dap
