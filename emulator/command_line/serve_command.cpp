#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "emulator/bench/bench_file.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/model_option.h"
#include "emulator/device.h"
#include "emulator/edge/daemon.h"

namespace understudy::emulator {

namespace {

pty::Timing demand_timing(const std::string& timing) {
  if (timing == "wire") return pty::Timing::wire;
  if (timing == "instant") return pty::Timing::instant;
  throw UsageError("--timing: '" + timing + "' is unknown; expected wire or instant");
}

/// One line with one device, from flags.
Bench bench_of_one(const ServeArguments& arguments) {
  Bench bench;
  DeviceSetup device{.model = &demand_model(arguments.model), .settings = {}};
  device.settings.name = "device";
  device.settings.address = arguments.station.value_or(1);
  if (arguments.baud == 0)
    throw UsageError("--baud: 0 is no speed; expected one of the model's, such as 19200 or 115200");
  device.settings.baud = arguments.baud.value_or(0);
  if (!arguments.firmware.empty()) {
    device.settings.firmware = parse_firmware(arguments.firmware);
    if (device.settings.firmware == 0) {
      throw UsageError("--firmware: '" + arguments.firmware + "' is no version; expected one like 1.52");
    }
  }
  bench.devices.push_back(device);
  bench.lines.push_back(
      {.name = "line", .link = arguments.link, .baud = device.settings.baud, .stations = {0}});
  return bench;
}

Bench make_bench(const ServeArguments& arguments) {
  if (arguments.bench.empty() == arguments.model.empty()) {
    throw UsageError("serve: expected either a bench file or --model MODEL");
  }
  const bool flags_of_one =
      arguments.station || arguments.baud || !arguments.firmware.empty() || !arguments.link.empty();
  if (!arguments.bench.empty() && flags_of_one) {
    throw UsageError(
        "serve: --station, --firmware, --baud and --link belong to --model; a bench file says them itself");
  }
  Bench bench = arguments.bench.empty() ? bench_of_one(arguments) : load_bench(arguments.bench);
  if (!arguments.timing.empty()) {
    for (LineSetup& line : bench.lines) line.timing = demand_timing(arguments.timing);
  }
  return bench;
}

/// systemd's readiness protocol: a datagram to the socket that NOTIFY_SOCKET names.
void notify_service_manager(const char* state) {
  const char* const path = std::getenv("NOTIFY_SOCKET");
  if (path == nullptr || (path[0] != '/' && path[0] != '@')) return;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::size_t length = std::strlen(path);
  if (length >= sizeof(address.sun_path)) return;
  std::memcpy(address.sun_path, path, length);
  if (address.sun_path[0] == '@') address.sun_path[0] = '\0';  // an abstract socket
  const int descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return;
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length);
  sendto(descriptor, state, std::strlen(state), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address),
         size);
  close(descriptor);
}

}  // namespace

int serve(const ServeArguments& arguments) {
  const Bench bench = make_bench(arguments);
  DaemonOptions options;
  options.strict_framing = arguments.strict_framing;
  options.enforce_settings = !arguments.ignore_baud;
  options.control_path = arguments.control;
  const auto speed = parse_speed(arguments.speed);
  if (!speed) {
    throw UsageError("--speed: '" + arguments.speed +
                     "' is unknown; expected real, free, manual or a factor such as 10x");
  }
  options.speed = *speed;

  signal(SIGPIPE, SIG_IGN);  // whoever reads the log may go away
  Daemon daemon(bench, options, log_line);
  for (const auto& port : daemon.ports()) {
    std::printf("ready %s %s %s\n", daemon.world().line(port->line_number()).line.name().c_str(),
                port->terminal().path().c_str(), port->terminal().link_path().c_str());
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw pty::PortError("standard output cannot be written; expected to say there which ports are ready");
  }
  notify_service_manager("READY=1");
  daemon.run();
  notify_service_manager("STOPPING=1");
  return kExitWell;
}

}  // namespace understudy::emulator
