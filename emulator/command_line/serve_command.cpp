#include <signal.h>

#include <optional>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/coverage_file.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/serving.h"
#include "emulator/device/model.h"
#include "emulator/play/lint/lint.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/loop/readiness.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/port_group.h"

namespace understudy::emulator::command_line {

int serve(ModelList models, const ServeArguments& arguments) {
  if (arguments.page) require_page_port("serve: --page", *arguments.page);
  const Serving serving = make_serving(models, arguments, "serve");
  signal(SIGPIPE, SIG_IGN);  // the reader of the log may end first
  serve::Daemon daemon(serving.bench, serving.options, log_line);
  ServedCoverage coverage(arguments, daemon);
  for (const auto& port : daemon.ports()) {
    if (serving.group && port->terminal() != nullptr)
      serve::share_port(port->terminal()->path(), *serving.group);
  }
  print_ready(daemon);
  std::optional<play::Lint> lint;
  if (arguments.lint) lint.emplace(daemon.world());
  if (arguments.page) {
    if (daemon.control_path().empty())
      throw UsageError("serve: --page: no control socket is available; expected --control");
    start_page_beside(daemon.control_path(), *arguments.page);
  }
  serve::notify_service_manager("READY=1");
  daemon.run();
  serve::notify_service_manager("STOPPING=1");
  if (lint) print_findings(lint->findings());
  coverage.write();
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
