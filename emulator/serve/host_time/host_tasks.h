// The processes of a host, and whether the kernel runs any of their threads. A thread may wait for another
// one (a lock, a pipe, a child) without notifying the bench: the kernel knows that it sleeps. The kernel
// wakes such a thread before the one that wakes it continues, so a host whose threads all sleep stays asleep.
// A thread that has told the bench of its wait is no exception: a signal can end its wait, or its process.
//
// Our library tells the bench of most new processes. The kernel's lists of children have the others, such as
// those that libc or a system call of the host's own has forked.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

class HostTasks {
 public:
  /// `ended` is called when a process has ended. Children that this process has already are not the host's.
  HostTasks(EventLoop& loop, std::function<void(int process)> ended);
  ~HostTasks();
  HostTasks(const HostTasks&) = delete;
  HostTasks& operator=(const HostTasks&) = delete;

  void add(int process);
  /// Reports the processes that have ended now, before the loop does.
  void note_ends();
  void set_command(int process);
  /// Returns true if the command itself has ended, which may have left processes behind.
  bool has_command_ended() const;
  bool knows(int process) const { return processes_.contains(process); }
  /// Returns true if the host has a single thread.
  bool is_one_thread();
  /// Returns true if no thread of any process can continue on its own. `speaker` is the only thread that has
  /// sent messages since the host was asleep, if the last of them tells that it waits: it may still be on its
  /// way to sleep.
  bool are_all_asleep(std::optional<int> speaker);
  /// Call this when a thread has been told to continue.
  void continues(int thread) { asleep_.erase(thread); }
  /// Call this when signals may have been sent.
  void any_may_continue() { asleep_.clear(); }

  /// Describes a thread that the kernel runs: "thread 2 of my_host (1234)".
  std::optional<std::string> running_one();
  /// Describes a process that has not ended: "my_host (process 1234)".
  std::optional<std::string> left_one();

 private:
  struct Task {
    char state = 'R';
    std::uint64_t runs = 0;  // how often the kernel has run the thread
    bool operator==(const Task&) const = default;
  };
  using Tasks = std::map<int, Task>;

  /// The kernel's files about a thread. Reading them is much faster if they stay open.
  struct Files {
    Descriptor stat;
    Descriptor schedstat;
    Descriptor children;
  };

  void watch_end(int process, Descriptor descriptor);
  std::vector<int> children_of(int task);
  bool finds_children(int task);
  bool finds_orphans();
  bool finds_strangers(const Tasks& tasks);
  Task look_at(int process, int task);
  bool read_tasks(Tasks& tasks, std::optional<int> except);

  Descriptor command_;  // of its process; reports its end
  EventLoop& loop_;
  std::function<void(int)> ended_;
  std::map<int, Descriptor> processes_;  // each with a descriptor that reports its end
  std::set<int> others_;                 // children of this process that are not the host's
  std::map<int, Files> files_;           // of threads
  Tasks asleep_;                         // threads that have not been told to continue since all slept
};

}  // namespace understudy::emulator::serve
