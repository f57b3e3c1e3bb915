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
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "pty/port_link.h"

namespace understudy::emulator::command_line {

namespace {

/// Sends the bytes. Returns false if the other process has ended.
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

/// Sends the bytes after a header, which contains their number and whether they are an error message.
bool put(int wire, bool is_error, std::span<const std::byte> bytes) {
  const std::uint64_t size = bytes.size();
  return put(wire, &is_error, sizeof is_error) && put(wire, &size, sizeof size) &&
         put(wire, bytes.data(), bytes.size());
}

bool take(int wire, bool& is_error, std::vector<std::byte>& bytes) {
  std::uint64_t size = 0;
  if (!take(wire, &is_error, sizeof is_error) || !take(wire, &size, sizeof size)) return false;
  bytes.resize(size);
  return take(wire, bytes.data(), bytes.size());
}

bool put_answer(int wire, const Work& work, std::span<const std::byte> question) {
  try {
    return put(wire, false, work(question));
  } catch (const std::exception& error) {
    return put(wire, true, std::as_bytes(std::span(std::string_view(error.what()))));
  }
}

std::string why_not_started(int number, int count) {
  return "process " + std::to_string(number + 1) + " of " + std::to_string(count) + " cannot be started (" +
         std::generic_category().message(errno) + "); expected fewer --jobs";
}

/// Answers questions until the parent ends in any way.
[[noreturn]] void work(int wire, pid_t parent, const std::function<Work()>& make_work) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);
  const Work its_work = make_work();
  bool ignored = false;
  std::vector<std::byte> question;
  while (take(wire, ignored, question) && put_answer(wire, its_work, question)) {
  }
  _exit(0);
}

}  // namespace

WorkerProcesses::WorkerProcesses(int count, const std::function<Work()>& make_work) {
  const pid_t parent = getpid();
  for (int i = 0; i < count; ++i) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw pty::PortError(why_not_started(i, count));
    Descriptor ours(ends[0]);
    Descriptor theirs(ends[1]);
    const pid_t process = fork();
    if (process < 0) throw pty::PortError(why_not_started(i, count));
    if (process == 0) {
      ours.close();
      workers_.clear();
      work(theirs.get(), parent, make_work);
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

std::vector<std::byte> WorkerProcesses::ask(std::size_t worker, std::span<const std::byte> question) const {
  const int wire = workers_[worker].wire.get();
  bool is_error = false;
  std::vector<std::byte> answer;
  if (!put(wire, false, question) || !take(wire, is_error, answer))
    throw pty::PortError("a worker process ended early; expected it to run its cases");
  if (is_error)
    throw pty::PortError(std::string(reinterpret_cast<const char*>(answer.data()), answer.size()));
  return answer;
}

}  // namespace understudy::emulator::command_line
