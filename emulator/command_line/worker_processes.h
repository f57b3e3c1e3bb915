// Runs cases in separate processes, because a case with a command needs its own children and signals.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <vector>

#include "base/files/descriptor.h"
#include "emulator/play/performing/suite.h"
#include "emulator/play/results/result.h"

namespace understudy::emulator::command_line {

class WorkerProcesses {
 public:
  /// Starts `count` processes; each makes a Play. Must be called while this process has one thread.
  WorkerProcesses(int count, const std::function<play::Play()>& make_play);
  /// Ends them, and waits until they have ended.
  ~WorkerProcesses();
  WorkerProcesses(const WorkerProcesses&) = delete;
  WorkerProcesses& operator=(const WorkerProcesses&) = delete;

  std::size_t count() const { return workers_.size(); }
  /// Runs a case in that worker, which no other thread may use meanwhile. Throws pty::PortError if the worker
  /// has ended, or with the message of its exception.
  std::vector<play::ScenarioResult> play(std::size_t worker, const play::CaseId& which_case) const;

 private:
  struct Worker {
    pid_t process = -1;
    Descriptor wire;
  };
  std::vector<Worker> workers_;
};

}  // namespace understudy::emulator::command_line
