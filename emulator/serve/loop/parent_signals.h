// The signals of a process that has a child to look after (child.h).
#pragma once

#include <signal.h>

#include <functional>

#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

/// While it lives, signals that ask us to end and signals about children come through a descriptor, and those
/// that an edge must survive (a reader that goes away) are ignored. Make it before any other thread.
class ParentSignals {
 public:
  ParentSignals();
  ~ParentSignals();
  ParentSignals(const ParentSignals&) = delete;
  ParentSignals& operator=(const ParentSignals&) = delete;

  /// Calls `on_signal` with the number of each signal that comes.
  void watch(EventLoop& loop, std::function<void(int signal_number)> on_signal);
  void unwatch(EventLoop& loop) const { loop.unwatch(descriptor_); }

  /// In a child, before it becomes another program: restores all signals to what they were before.
  void restore() const;

 private:
  sigset_t mask_before_{};
  void (*pipe_before_)(int) = nullptr;
  int descriptor_ = -1;
};

}  // namespace understudy::emulator::serve
