#include <signal.h>

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
  }
  say_ready(daemon);
  std::optional<Lint> lint;
  if (arguments.lint) lint.emplace(daemon.world());
  notify_service_manager("READY=1");
  daemon.run();
  notify_service_manager("STOPPING=1");
  if (lint) print_findings(lint->findings());
  return kExitWell;
}

}  // namespace understudy::emulator
