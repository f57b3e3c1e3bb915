#include "emulator/command_line/worker_processes.h"

#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/state/state_bytes.h"
#include "emulator/play/results/result_state.h"
#include "pty/port_link.h"

namespace understudy::emulator::command_line {

namespace {

/// A worker's reply to a case.
struct Answer {
  std::string error;  // empty: none
  std::vector<play::ScenarioResult> results;
};

/// Returns false if the other side has ended.
bool put(int wire, const void* data, std::size_t size) {
  const auto* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = send(wire, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool take(int wire, void* data, std::size_t size) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = recv(wire, at, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

Answer answer_to(const play::Play& play, const play::CaseId& which_case) {
  try {
    return {.error = {}, .results = play(which_case)};
  } catch (const std::exception& error) {
    return {.error = error.what(), .results = {}};
  }
}

bool put(int wire, const Answer& answer) {
  StateWriter writer;
  writer.write(answer.error);
  writer.write(answer.results);
  const std::vector<std::byte> bytes = writer.take();
  const std::uint64_t size = bytes.size();
  return put(wire, &size, sizeof size) && put(wire, bytes.data(), bytes.size());
}

/// Runs cases until the parent closes the wire or ends.
[[noreturn]] void work(int wire, pid_t parent, const std::function<play::Play()>& make_play) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);
  const play::Play play = make_play();
  play::CaseId which_case;
  while (take(wire, &which_case, sizeof which_case) && put(wire, answer_to(play, which_case))) {
  }
  _exit(0);
}

}  // namespace

WorkerProcesses::WorkerProcesses(int count, const std::function<play::Play()>& make_play) {
  const pid_t parent = getpid();
  for (int i = 0; i < count; ++i) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw std::system_error(errno, std::generic_category(), "socketpair");
    Descriptor ours(ends[0]);
    Descriptor theirs(ends[1]);
    const pid_t process = fork();
    if (process < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (process == 0) {
      ours.close();
      workers_.clear();
      work(theirs.get(), parent, make_play);
    }
    workers_.push_back({process, std::move(ours)});
  }
}

WorkerProcesses::~WorkerProcesses() {
  for (Worker& worker : workers_) worker.wire.close();
  for (const Worker& worker : workers_) {
    while (waitpid(worker.process, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
}

std::vector<play::ScenarioResult> WorkerProcesses::play(std::size_t worker,
                                                        const play::CaseId& which_case) const {
  const int wire = workers_[worker].wire.get();
  std::uint64_t size = 0;
  std::vector<std::byte> bytes;
  const auto take_answer = [&] {
    if (!put(wire, &which_case, sizeof which_case) || !take(wire, &size, sizeof size)) return false;
    bytes.resize(size);
    return take(wire, bytes.data(), bytes.size());
  };
  if (!take_answer()) throw pty::PortError("a worker process ended early; expected it to run its cases");
  StateReader reader(bytes);
  Answer answer;
  reader.read(answer.error);
  reader.read(answer.results);
  if (!answer.error.empty()) throw pty::PortError(answer.error);
  return std::move(answer.results);
}

}  // namespace understudy::emulator::command_line
