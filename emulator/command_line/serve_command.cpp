#include <signal.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/serving.h"
#include "emulator/device/model.h"
#include "emulator/play/lint/lint.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/loop/readiness.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/port_group.h"
#include "emulator/serve/ports/tcp_door.h"
#include "emulator/world/speech/line_speech.h"

namespace understudy::emulator::command_line {

namespace {

struct Scheme {
  std::string_view text;
  serve::TcpProtocol protocol;
};
constexpr std::array kSchemes{Scheme{"rtu://", serve::TcpProtocol::rtu},
                              Scheme{"modbus-tcp://", serve::TcpProtocol::modbus_tcp}};
constexpr int kLastTcpPort = 65'535;

[[noreturn]] void refuse_listen(const std::string& wish) {
  throw UsageError(
      "--listen: " + understudy::quoted(wish) +
      " is not a place to listen; expected rtu://HOST:PORT or modbus-tcp://HOST:PORT, where there are "
      "several lines after LINE=, such as rtu://127.0.0.1:5020");
}

/// [LINE=]rtu://[HOST]:PORT
struct Listening {
  std::string line;
  serve::TcpAddress address;
};

Listening demand_listening(const std::string& wish) {
  const std::size_t equals = wish.substr(0, wish.find("://")).rfind('=');
  const std::string_view place = std::string_view(wish).substr(equals == std::string::npos ? 0 : equals + 1);
  const auto* const scheme =
      std::ranges::find_if(kSchemes, [&](const Scheme& row) { return place.starts_with(row.text); });
  const std::size_t colon = place.rfind(':');
  if (equals == 0 || scheme == kSchemes.end() || colon < scheme->text.size()) refuse_listen(wish);
  Listening listening{
      .line = equals == std::string::npos ? "" : wish.substr(0, equals),
      .address = {.protocol = scheme->protocol,
                  .host = std::string(place.substr(scheme->text.size(), colon - scheme->text.size()))}};
  serve::TcpAddress& address = listening.address;
  if (address.host.empty()) address.host = "127.0.0.1";
  const char* const end = place.data() + place.size();
  const auto [stop, error] = std::from_chars(place.data() + colon + 1, end, address.port);
  if (error != std::errc{} || stop != end || address.port < 0 || address.port > kLastTcpPort)
    refuse_listen(wish);
  return listening;
}

std::string_view scheme_of(serve::TcpProtocol protocol) {
  return std::ranges::find(kSchemes, protocol, &Scheme::protocol)->text;
}

/// The line that it names, or the only one.
const serve::Port& demand_line(const serve::Daemon& daemon, const std::string& name) {
  if (name.empty() && daemon.ports().size() == 1) return *daemon.ports().front();
  std::string lines;
  for (const auto& port : daemon.ports()) {
    const std::string& its = daemon.world().line(port->line_number()).line.name();
    if (its == name) return *port;
    lines += (lines.empty() ? "" : ", ") + its;
  }
  throw UsageError("--listen: " + (name.empty() ? std::string("names no line") : understudy::quoted(name)) +
                   (name.empty() ? "" : " is not a line") + "; expected LINE=... with one of " + lines);
}

using TcpDoors = std::vector<std::unique_ptr<serve::TcpDoor>>;

TcpDoors open_doors(serve::Daemon& daemon, const std::vector<std::string>& wishes) {
  TcpDoors doors;
  for (const std::string& wish : wishes) {
    const Listening listening = demand_listening(wish);
    const serve::Port& port = demand_line(daemon, listening.line);
    const pty::Line& line = daemon.world().line(port.line_number()).line;
    if (listening.address.protocol == serve::TcpProtocol::modbus_tcp &&
        &daemon.world().line(port.line_number()).speech == &world::text_speech())
      throw UsageError("--listen: " + understudy::quoted(wish) + ": the line " + line.name() +
                       " speaks lines of text, not Modbus; expected rtu://, which carries any bytes");
    doors.push_back(std::make_unique<serve::TcpDoor>(daemon.loop(), port, line.options().settings,
                                                     listening.address, log_line));
    log_line("line " + line.name() + " listens at " + std::string(scheme_of(listening.address.protocol)) +
             doors.back()->address());
  }
  return doors;
}

}  // namespace

int serve(ModelList models, const ServeArguments& arguments) {
  const Serving serving = make_serving(models, arguments, "serve");
  signal(SIGPIPE, SIG_IGN);  // whoever reads the log may go away
  signal(SIGXFSZ, SIG_IGN);  // a capture that may not grow further ends, the devices go on
  serve::Daemon daemon(serving.bench, serving.options, log_line);
  for (const auto& port : daemon.ports()) {
    if (serving.group) serve::share_port(port->terminal().path(), *serving.group);
  }
  const TcpDoors doors = open_doors(daemon, arguments.listen);
  say_ready(daemon);
  std::optional<play::Lint> lint;
  if (arguments.lint) lint.emplace(daemon.world());
  if (arguments.page) {
    if (daemon.control_path().empty())
      throw UsageError("serve: --page: there is no control socket; expected --control");
    start_page_beside(daemon.control_path(), *arguments.page);
  }
  serve::notify_service_manager("READY=1");
  daemon.run();
  serve::notify_service_manager("STOPPING=1");
  if (lint) print_findings(lint->findings());
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
