// Tracks the programs that a host's processes execute, and which of them have loaded the library. Pure: no
// sockets.
#pragma once

#include <map>

#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

class HostGreetings {
 public:
  /// Handles a message of the host. Messages of several connections may arrive in a different order than they
  /// were sent.
  void on_message(const host_time::Message& message);
  /// Returns the first process of the host, or -1 if there is no process yet.
  int first_process() const { return first_process_; }
  /// Returns true if the current program of the process has not greeted the bench.
  bool is_silent(int process) const;
  /// Call this when a silent process has ended. Returns true if it is the first silent process that must be
  /// reported. For the host's first process, use was_reached() instead.
  bool silent_one_ended(int process);
  /// Returns true if the host was in simulated time: its first process had the library at its end, and if
  /// another process did not, at least some thread of the host has waited.
  bool was_reached() const {
    return first_process_ >= 0 && !is_first_silent_ && (has_waited_ || !has_silence_);
  }

 private:
  int first_process_ = -1;
  std::map<int, int> owed_;  // the programs of each process that have not greeted the bench
  bool is_first_silent_ = false;
  bool has_silence_ = false;  // a process other than the first one has been silent
  bool has_waited_ = false;
};

}  // namespace understudy::emulator::serve
