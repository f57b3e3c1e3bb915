// Starts and ends a session with a bench.
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/one_line.h"
#include "emulator/dap/arguments.h"
#include "emulator/dap/bench_link.h"
#include "emulator/dap/session.h"
#include "emulator/serve/loop/pacer.h"

namespace understudy::emulator::dap {

namespace {

constexpr const char* kAtLaunch = "dap";  // the snapshot to which `restart` returns

/// Returns the timeline of a recording, or null, because only a daemon that serves a recording has a
/// timeline.
Json timeline_of(const BenchLink& link) {
  try {
    return link.ask({{"do", "timeline"}})["timeline"];
  } catch (const GoneError&) {
    throw;
  } catch (const RequestError&) {
    return nullptr;
  }
}

}  // namespace

Json Session::launch(const Json& arguments) {
  speed_ = text_or(arguments, "speed", "manual");
  if (!serve::parse_speed(speed_)) {
    throw RequestError("speed: " + understudy::quoted(speed_) +
                       " is not a speed; expected real, free, manual or a factor");
  }
  open("launch", arguments);
  print_ports();
  return nullptr;
}

Json Session::attach(const Json& arguments) {
  open("attach", arguments);
  return nullptr;
}

void Session::open(std::string_view request, const Json& arguments) {
  stops_at_entry_ = flag_or(arguments, "stopOnEntry", false);
  launched_ = launcher_(request, arguments);
  link_ = std::move(launched_.link);
  try {
    find_devices();
    const Json look = link_->ask({{"do", "look"}, {"events", 0}});
    const Json next = link_->ask({{"do", "events"}, {"last", 0}});
    next_event_ = next.value("next", std::uint64_t{1});
    is_manual_ = look.value("speed", std::string()) == "manual";
    was_paused_ = look.value("paused", false);
    const Json timeline = timeline_of(*link_);
    is_recording_ = !timeline.is_null();
    failure_ = is_recording_ && timeline.contains("story") ? text_or(timeline["story"], "text") : "";
    if (launched_.end && !is_recording_) link_->ask({{"do", "snapshot"}, {"name", kAtLaunch}});
    map_sources(arguments);
  } catch (...) {
    end();
    throw;
  }
  phase_ = Phase::configuring;
}

void Session::find_devices() {
  devices_.clear();
  const Json bench = link_->ask({{"do", "bench"}})["bench"];
  for (const Json& device : bench["devices"]) {
    DeviceInfo info{.name = device["name"].get<std::string>()};
    const Json more = link_->ask({{"do", "bench"}, {"device", info.name}})["device"];
    info.has_program = more.contains("program");
    info.has_many = info.has_program && more["program"].value("at_once", false);
    for (const Json& section : more.value("sections", Json::array())) {
      const std::string english = section.value("english", std::string());
      info.sections.emplace_back(section.value("rows", std::int64_t{0}),
                                 english.empty() ? section.value("name", std::string()) : english);
    }
    devices_.push_back(std::move(info));
  }
}

/// Finds the devices that run the files of the argument `sources`.
void Session::map_sources(const Json& arguments) {
  if (!arguments.contains("sources")) return;
  for (const Json& path : require_list(arguments, "sources")) {
    if (!path.is_string()) throw RequestError("sources: expected a list of paths");
    std::string why_none;
    std::string what_differs;
    devices_with({{"path", path}}, why_none, what_differs);
    if (!why_none.empty()) print("sources: " + why_none + "\n");
  }
}

/// Prints the ports at which hosts can open the lines of a launched bench.
void Session::print_ports() {
  if (is_recording_) return;
  const Json daemon = link_->ask({{"do", "identify"}})["daemon"];
  for (const Json& line : daemon["lines"]) {
    std::string text = line.value("name", std::string());
    for (const char* key : {"pty", "link"}) {
      const std::string where = line.value(key, std::string());
      if (!where.empty()) text += " " + where;
    }
    for (const Json& where : line.value("tcp", Json::array())) {
      if (where.is_string()) text += " " + where.get<std::string>();
    }
    print(one_line(text) + "\n", "console");
  }
}

Json Session::configuration_done(const Json& /*arguments*/) {
  phase_ = Phase::stopped;
  if (is_recording_ && stops_at_entry_) link_->ask({{"do", "seek"}, {"to_ns", 0}});
  if (launched_.end && !is_recording_) {
    if (speed_ != "manual") {
      link_->ask({{"do", "pause"}});
      link_->ask({{"do", "speed"}, {"to", speed_}});
      is_manual_ = false;
    }
    if (!stops_at_entry_) continue_program(Json::object());
  } else if (!is_recording_ && !is_manual_ && !was_paused_) {
    if (stops_at_entry_) {
      link_->ask({{"do", "pause"}});
    } else {
      phase_ = Phase::running;
    }
  }
  return nullptr;
}

/// Reports the first stop, after the configuration. The recording of a failure begins at the failure.
void Session::stop_at_entry() {
  if (failure_.empty() || stops_at_entry_) return report_stop(Json(), "entry");
  print(failure_ + "\n");
  report_stop(Json(), "exception", failure_);
}

Json Session::restart(const Json& /*arguments*/) {
  if (is_recording_) {
    link_->ask({{"do", "seek"}, {"to_ns", 0}});
    report_stop(Json(), "entry");
    return nullptr;
  }
  if (!launched_.end)
    throw RequestError("only a launched bench can be restarted; expected a session that began with `launch`");
  link_->pause();
  phase_ = Phase::stopped;
  delete_from_bench();
  link_->ask({{"do", "restore"}, {"name", kAtLaunch}});
  set_again();
  if (stops_at_entry_) {
    report_stop(Json(), "entry");
  } else {
    event("continued", {{"threadId", 1}, {"allThreadsContinued", true}});
    continue_program(Json::object());
  }
  return nullptr;
}

Json Session::terminate(const Json& /*arguments*/) {
  end();
  phase_ = Phase::ended;
  return nullptr;
}

Json Session::disconnect(const Json& /*arguments*/) {
  end();
  phase_ = Phase::over;
  return nullptr;
}

/// Ends a bench that was launched. Leaves any other bench as it was found: without the session's breakpoints,
/// and with its clock running if it was running before.
void Session::end() {
  if (!link_) return;
  try {
    if (!launched_.end) {
      // A step in progress has stopped the clock too.
      const bool is_held = phase_ == Phase::stopped || link_->is_awaiting();
      if (link_->is_awaiting() && !is_recording_) link_->pause();
      delete_from_bench();
      if (is_held && !is_recording_ && !is_manual_ && !was_paused_) link_->ask({{"do", "resume"}});
    }
  } catch (const RequestError&) {  // it has ended already
  }
  points_.clear();
  link_.reset();
  if (launched_.end) launched_.end();
  launched_ = {};
}

}  // namespace understudy::emulator::dap
