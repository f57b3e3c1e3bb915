// Runs work in separate processes, because a case with a command needs children and signals, and a process
// has only one set of signal handlers.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "base/files/descriptor.h"

namespace understudy::emulator::command_line {

/// Answers a question. Question and answer are bytes (base/state/state_bytes.h).
using Work = std::function<std::vector<std::byte>(std::span<const std::byte>)>;

class WorkerProcesses {
 public:
  /// Starts `count` processes, each of which creates its own Work. Call this while this process has only one
  /// thread.
  WorkerProcesses(int count, const std::function<Work()>& make_work);
  /// Ends the processes, and waits until they have ended.
  ~WorkerProcesses();
  WorkerProcesses(const WorkerProcesses&) = delete;
  WorkerProcesses& operator=(const WorkerProcesses&) = delete;

  std::size_t count() const { return workers_.size(); }
  /// Sends a question to a worker, and waits for the answer. No other thread may use the worker at the same
  /// time. Throws pty::PortError with the message of the worker's exception, or if the worker has ended.
  std::vector<std::byte> ask(std::size_t worker, std::span<const std::byte> question) const;

 private:
  struct Worker {
    pid_t process = -1;
    Descriptor wire;
  };
  std::vector<Worker> workers_;
};

}  // namespace understudy::emulator::command_line
