#include "emulator/command_line/choose_daemon.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/sockets.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds kPatience{2'000};  // the daemon may be stopped

struct Running {
  std::string socket;
  std::string bench;  // empty: no bench
  struct Port {
    std::string pty;
    std::string link;
  };
  std::vector<Port> ports;
  bool has_answered = false;
};

/// Returns the path with all links resolved.
std::string place_of(const std::string& path) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(path, error);
  return error ? path : place.string();
}

Running identify(const std::string& socket) {
  Running running{.socket = socket, .bench = {}, .ports = {}};
  try {
    const Json daemon =
        Json::parse(serve::ask_control(socket, R"({"do":"identify"})", kPatience)).at("daemon");
    running.bench = daemon.at("bench").get<std::string>();
    for (const Json& line : daemon.at("lines")) {
      running.ports.push_back({line.at("pty").get<std::string>(), line.at("link").get<std::string>()});
    }
    running.has_answered = true;
  } catch (const serve::ControlError&) {
  } catch (const Json::exception&) {
  }
  return running;
}

std::vector<Running> identify_all() {
  std::vector<Running> all;
  for (const std::string& socket : serve::live_control_sockets()) all.push_back(identify(socket));
  return all;
}

std::string text_of(const Running& running) {
  if (!running.has_answered) return running.socket + " (does not answer)";
  std::string text = running.socket + " (" + (running.bench.empty() ? "no bench" : "bench " + running.bench);
  for (const Running::Port& port : running.ports) text += ", port " + port.link;
  return text + ")";
}

std::string list_of(const std::vector<Running>& all) {
  std::string list;
  for (const Running& running : all) list += (list.empty() ? "" : "; ") + text_of(running);
  return list;
}

bool has_port(const Running& running, const std::string& port) {
  const std::string link = fs::absolute(port).lexically_normal().string();
  const std::string place = place_of(port);
  return std::any_of(running.ports.begin(), running.ports.end(),
                     [&](const auto& known) { return known.link == link || known.pty == place; });
}

/// Returns flags such as "--bench feeder.yaml --port feeder.port".
std::string flags_of(const WhichDaemon& which) {
  std::string flags;
  if (!which.bench.empty()) flags += " --bench " + which.bench;
  if (!which.port.empty()) flags += " --port " + which.port;
  return flags.substr(1);
}

std::string only_one(const std::vector<Running>& all, const std::string& what_is_told,
                     const std::string& flags) {
  if (all.size() == 1) return all.front().socket;
  throw UsageError("ctl: " + std::to_string(all.size()) + " " + what_is_told + "; expected " + flags +
                   " for one of: " + list_of(all));
}

std::string find_by(const WhichDaemon& which) {
  const std::vector<Running> all = identify_all();
  std::vector<Running> fitting;
  for (const Running& running : all) {
    const bool fits = (which.bench.empty() || running.bench == place_of(which.bench)) &&
                      (which.port.empty() || has_port(running, which.port));
    if (running.has_answered && fits) fitting.push_back(running);
  }
  if (!fitting.empty()) {
    return only_one(
        fitting, "daemons match " + flags_of(which),
        which.port.empty() ? "an additional --port LINK, or --control SOCKET," : "--control SOCKET");
  }
  const std::string what = which.port.empty()    ? which.bench
                           : which.bench.empty() ? which.port
                                                 : which.bench + " on " + which.port;
  throw serve::ControlError(
      "ctl: no daemon serves " + what + "; " +
      (all.empty() ? "no `understudy serve` is running here" : "running: " + list_of(all)));
}

}  // namespace

std::string choose_daemon(const WhichDaemon& which) {
  if (!which.socket.empty()) return which.socket;
  if (!which.bench.empty() || !which.port.empty()) return find_by(which);
  const char* const from_exec = std::getenv("UNDERSTUDY_CONTROL");
  if (from_exec != nullptr && *from_exec != '\0') return from_exec;  // an empty variable counts as unset
  const std::vector<std::string> live = serve::live_control_sockets();
  if (live.empty()) {
    throw serve::ControlError("ctl: no daemon answers in " + serve::control_folder() +
                              "; expected a running `understudy serve`, or --control SOCKET");
  }
  return live.size() == 1 ? live.front()
                          : only_one(identify_all(), "daemons are running",
                                     "--bench FILE, --port LINK or --control SOCKET");
}

int list_daemons(bool as_json) {
  if (as_json) {
    Json daemons = Json::array();
    for (const Running& running : identify_all()) {
      Json ports = Json::array();
      for (const Running::Port& port : running.ports)
        ports.push_back({{"pty", port.pty}, {"link", port.link}});
      daemons.push_back({{"socket", running.socket},
                         {"answers", running.has_answered},
                         {"bench", running.bench},
                         {"ports", ports}});
    }
    const Json reply{{"ok", true}, {"daemons", daemons}};
    std::printf("%s\n", reply.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
    return kExitWell;
  }
  for (const Running& running : identify_all()) std::printf("%s\n", one_line(text_of(running)).c_str());
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
