// Implements `understudy page`, which shows the live page of running benches, and `serve --page`.
#include <sys/prctl.h>
#include <sys/types.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/log.h"
#include "emulator/page/page.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/sockets.h"

namespace understudy::emulator::command_line {

namespace {

/// Returns the control sockets of all running daemons, or the one in UNDERSTUDY_CONTROL.
std::vector<std::string> daemons_to_show() {
  const char* const from_exec = std::getenv("UNDERSTUDY_CONTROL");
  if (from_exec != nullptr && *from_exec != '\0') return {from_exec};  // an empty variable counts as unset
  std::vector<std::string> live = serve::live_control_sockets();
  if (live.empty()) {
    throw serve::ControlError("page: no daemon answers in " + serve::control_folder() +
                              "; expected a running `understudy serve`, or --control SOCKET");
  }
  return live;
}

}  // namespace

int show_page(const PageArguments& arguments) {
  page::PageOptions options{.address = {.address = arguments.listen},
                            .sockets = arguments.sockets,
                            .hosts = arguments.hosts,
                            .is_read_only = arguments.read_only,
                            .folder = arguments.folder};
  require_page_port("page: --port", arguments.port);
  options.address.port = static_cast<std::uint16_t>(arguments.port);
  if (options.sockets.empty()) options.sockets = daemons_to_show();
  std::signal(SIGPIPE, SIG_IGN);
  for (const std::string& socket : arguments.sockets) {
    if (!serve::is_answered(socket))
      log_line("page: " + socket + ": no daemon answers there yet; the page shows the bench when one does");
  }
  page::Page shown(options);
  std::printf("page %s\n", shown.address().c_str());
  std::fflush(stdout);
  shown.run(true);
  return kExitWell;
}

void require_page_port(const std::string& flag, int port) {
  if (port < 0 || port > 65535)
    throw UsageError(flag + ": '" + std::to_string(port) + "' is not a port; expected 0 to 65535");
}

void start_page_beside(const std::string& control, int port) {
  std::signal(SIGCHLD, SIG_IGN);  // the page may end before this process
  const pid_t parent = getpid();
  std::vector<std::string> words{"understudy", "page", "--control", control, "--port", std::to_string(port)};
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  if (fork() != 0) return;
  // The page ends with this process, however this process ends.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  std::signal(SIGCHLD, SIG_DFL);
  execv("/proc/self/exe", pointers.data());
  _exit(kExitNoResource);
}

}  // namespace understudy::emulator::command_line
