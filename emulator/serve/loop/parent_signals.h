// Handles the signals of a process that has a child (child.h).
#pragma once

#include <signal.h>

#include <functional>

#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

/// During its lifetime, signals that ask this process to end and signals about children arrive through a
/// descriptor. Signals that the process must survive (such as SIGPIPE when a reader ends) are ignored. Create
/// this object before any other thread.
class ParentSignals {
 public:
  ParentSignals();
  ~ParentSignals();
  ParentSignals(const ParentSignals&) = delete;
  ParentSignals& operator=(const ParentSignals&) = delete;

  /// Calls `on_signal` with the number of each received signal.
  void watch(EventLoop& loop, std::function<void(int signal_number)> on_signal);
  void unwatch(EventLoop& loop) const { loop.unwatch(descriptor_); }

  /// Restores the original handling of all signals. Called in a child, before it executes another program.
  void restore() const;

 private:
  sigset_t mask_before_{};
  void (*pipe_before_)(int) = nullptr;
  int descriptor_ = -1;
};

}  // namespace understudy::emulator::serve
