// The processes of a host, and whether the kernel runs any of their threads. A thread may wait for another
// one (a lock, a pipe, a child) without notifying the bench: the kernel knows that it sleeps. The kernel
// wakes such a thread before the one that wakes it continues, so a host whose threads all sleep stays asleep.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

class HostTasks {
 public:
  /// `ended` is called when a process has ended.
  HostTasks(EventLoop& loop, std::function<void(int process)> ended)
      : loop_(loop), ended_(std::move(ended)) {}
  ~HostTasks();
  HostTasks(const HostTasks&) = delete;
  HostTasks& operator=(const HostTasks&) = delete;

  void add(int process);
  bool knows(int process) const { return processes_.contains(process); }
  /// Returns true if the process exists and is not about to end.
  bool is_alive(int process) const;

  /// Returns true if the host has a single thread.
  bool is_one_thread() const;
  /// Returns true if no thread of any process can continue on its own. `waiting` has the threads that are
  /// known to wait.
  bool are_all_asleep(const std::set<int>& waiting) const;

  /// Describes a thread that the kernel runs: "thread 2 of my_host (1234)".
  std::optional<std::string> running_one() const;

 private:
  struct Task {
    char state = 'R';
    std::uint64_t runs = 0;  // how often the kernel has run it
    bool operator==(const Task&) const = default;
  };
  using Tasks = std::map<int, Task>;

  bool read_tasks(Tasks& tasks, const std::set<int>& waiting) const;

  EventLoop& loop_;
  std::function<void(int)> ended_;
  std::map<int, Descriptor> processes_;  // each with a descriptor that reports its end
};

}  // namespace understudy::emulator::serve
