// Handles the signals of a process that has a child (child.h).
#pragma once

#include <signal.h>

#include <functional>

#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

/// While it lives, signals that ask this process to end and signals about children arrive through a
/// descriptor, and signals that it must survive (such as SIGPIPE when a reader ends) are ignored. It must be
/// made before any other thread.
class ParentSignals {
 public:
  ParentSignals();
  ~ParentSignals();
  ParentSignals(const ParentSignals&) = delete;
  ParentSignals& operator=(const ParentSignals&) = delete;

  /// Calls `on_signal` with the number of each signal that arrives.
  void watch(EventLoop& loop, std::function<void(int signal_number)> on_signal);
  void unwatch(EventLoop& loop) const { loop.unwatch(descriptor_); }

  /// Restores all signals to their former state. Called in a child, before it becomes another program.
  void restore() const;

 private:
  sigset_t mask_before_{};
  void (*pipe_before_)(int) = nullptr;
  int descriptor_ = -1;
};

}  // namespace understudy::emulator::serve
