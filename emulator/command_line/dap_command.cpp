// Implements `understudy dap`, a debug adapter for editors.
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "base/text/one_line.h"
#include "emulator/command_line/choose_daemon.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/debugged_bench.h"
#include "emulator/command_line/interruption.h"
#include "emulator/command_line/log.h"
#include "emulator/dap/adapter.h"
#include "emulator/dap/arguments.h"
#include "emulator/dap/bench_link.h"
#include "emulator/dap/session.h"
#include "emulator/serve/control/sockets.h"
#include "emulator/serve/ports/tcp_places.h"
#include "emulator/world/bench/listening.h"
#include "pty/port_link.h"

namespace understudy::emulator::command_line {

namespace {

constexpr std::size_t kMaxRefused = 8;  // at a time; further clients are disconnected without a reply
constexpr int kLookMs = 500;            // between checks for signals and ended sessions

std::string text_in(const dap::Json& arguments, const char* key) {
  const std::string text = dap::text_or(arguments, key);
  if (arguments.contains(key) && text.empty())
    throw dap::RequestError(std::string(key) + ": expected a text that is not empty");
  return text;
}

dap::Launched attach(const dap::Json& arguments) {
  const WhichDaemon which{.socket = text_in(arguments, "control"),
                          .bench = text_in(arguments, "bench"),
                          .port = text_in(arguments, "port")};
  return {.link = std::make_unique<dap::SocketLink>(choose_daemon(which))};
}

/// Returns the command line that serves the bench or recording to debug. A scenario has already been
/// recorded.
std::vector<std::string> words_to_serve(const dap::Json& arguments, std::string recording) {
  const std::string bench = text_in(arguments, "bench");
  const std::string model = text_in(arguments, "model");
  if (recording.empty()) recording = text_in(arguments, "recording");
  if (!recording.empty()) return {"replay", recording, "--serve"};
  std::vector<std::string> words{"serve", "--speed", "manual"};
  if (model.empty()) {
    words.push_back(bench);
  } else {
    words.insert(words.end(), {"--model", model});
  }
  if (!arguments.contains("args")) return words;
  for (const dap::Json& word : dap::require_list(arguments, "args")) {
    if (!word.is_string()) throw dap::RequestError("args: expected a list of texts");
    words.push_back(word.get<std::string>());
  }
  return words;
}

dap::Launched launch(const dap::Json& arguments) {
  int given = 0;
  for (const char* what : {"bench", "model", "recording", "scenario"})
    given += text_in(arguments, what).empty() ? 0 : 1;
  if (given != 1) throw dap::RequestError("expected one of bench, model, recording and scenario");
  std::optional<RecordedScenario> recorded;
  if (const std::string scenario = text_in(arguments, "scenario"); !scenario.empty())
    recorded.emplace(scenario);
  const std::string socket = serve::own_control_path();
  const auto started = std::make_shared<DebuggedBench>(
      words_to_serve(arguments, recorded ? recorded->recording() : std::string()), socket);
  return {.link = std::make_unique<dap::SocketLink>(socket),
          .end = [started] { started->end(); },
          .news = [started] { return started->news(); }};
}

dap::Launched launch_or_attach(std::string_view request, const dap::Json& arguments) {
  return request == "launch" ? launch(arguments) : attach(arguments);
}

/// Runs `serve` in a process that ends with this one.
template <class Serve>
pid_t start_beside(const Serve& serve) {
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child != 0) return child;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() == parent) serve();
  _exit(kExitWell);
}

void forget_ended(std::vector<pid_t>& processes) {
  std::erase_if(processes, [](pid_t one) { return waitpid(one, nullptr, WNOHANG) == one; });
}

/// Serves one client after another. Clients that connect in the meantime are refused with a reason.
void serve_clients(const std::vector<Descriptor>& listeners) {
  std::vector<pid_t> serving;
  std::vector<pid_t> refusing;
  std::vector<pollfd> waits;
  for (const Descriptor& one : listeners) waits.push_back({.fd = one.get(), .events = POLLIN, .revents = 0});
  while (!is_interrupted()) {
    if (poll(waits.data(), waits.size(), kLookMs) <= 0) continue;
    for (const pollfd& one : waits) {
      if (one.revents == 0) continue;
      const Descriptor client(accept4(one.fd, nullptr, nullptr, SOCK_CLOEXEC));
      if (client.get() < 0) continue;
      forget_ended(serving);
      forget_ended(refusing);
      if (serving.empty()) {
        serving.push_back(start_beside([&] {
          const std::string why =
              dap::serve_session(client.get(), client.get(), launch_or_attach, is_interrupted);
          if (!why.empty()) log_line("dap: " + why);
        }));
      } else if (refusing.size() < kMaxRefused) {
        refusing.push_back(start_beside([&] {
          dap::refuse_session(client.get(), "another client is connected; expected only one at a time");
        }));
      }
    }
  }
}

constexpr std::string_view kScheme = "rtu://";  // our addresses need one; an editor's addresses have none

/// Returns listening sockets for an address. Throws pty::PortError, with the address in the editor's
/// notation.
std::vector<Descriptor> listeners_at(world::TcpAddress& address) {
  try {
    return serve::listen_at(address);
  } catch (const pty::PortError& error) {
    std::string why = error.what();
    if (const std::size_t at = why.find(kScheme); at != std::string::npos) why.erase(at, kScheme.size());
    throw pty::PortError("dap: " + why);
  }
}

}  // namespace

int serve_debug_adapter(const DapArguments& arguments) {
  std::signal(SIGPIPE, SIG_IGN);
  if (arguments.listen.empty()) {
    if (isatty(STDIN_FILENO) == 1)
      throw UsageError("dap: standard input is a terminal; expected an editor, or --listen HOST:PORT");
    watch_for_interruption();
    const std::string why = dap::serve_session(STDIN_FILENO, STDOUT_FILENO, launch_or_attach, is_interrupted);
    if (why.empty()) return kExitWell;
    log_line("dap: " + why);
    return kExitBadInput;
  }
  world::TcpAddress address;
  try {
    address = world::parse_tcp_address(std::string(kScheme) + arguments.listen);
  } catch (const world::ListeningError& error) {
    throw UsageError("dap: --listen: " + understudy::quoted(arguments.listen) +
                     " is not an address; expected HOST:PORT, such as 127.0.0.1:4711");
  }
  const std::vector<Descriptor> listeners = listeners_at(address);
  std::printf("dap %s\n", world::to_string(address).substr(kScheme.size()).c_str());
  std::fflush(stdout);
  watch_for_interruption();
  serve_clients(listeners);
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
