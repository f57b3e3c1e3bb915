#include <signal.h>

#include <cstdio>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/serving.h"
#include "emulator/edge/port_group.h"
#include "emulator/edge/readiness.h"
#include "emulator/lint/lint.h"

namespace understudy::emulator {

int serve(const ServeArguments& arguments) {
  const Serving serving = make_serving(arguments, "serve");
  signal(SIGPIPE, SIG_IGN);  // whoever reads the log may go away
  signal(SIGXFSZ, SIG_IGN);  // a capture that may not grow further ends, the devices go on
  Daemon daemon(serving.bench, serving.options, log_line);
  for (const auto& port : daemon.ports()) {
    if (serving.group) share_port(port->terminal().path(), *serving.group);
    std::printf("ready %s %s %s\n", daemon.world().line(port->line_number()).line.name().c_str(),
                port->terminal().path().c_str(), port->terminal().link_path().c_str());
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw pty::PortError("standard output cannot be written; expected to say there which ports are ready");
  }
  std::optional<Lint> lint;
  if (arguments.lint) lint.emplace(daemon.world());
  notify_service_manager("READY=1");
  daemon.run();
  notify_service_manager("STOPPING=1");
  if (lint) print_findings(lint->findings());
  return kExitWell;
}

}  // namespace understudy::emulator
