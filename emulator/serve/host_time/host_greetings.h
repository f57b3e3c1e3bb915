// The programs that the processes of a host become, and which of them have loaded the library. Pure: it knows
// no sockets.
#pragma once

#include <map>

#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

class HostGreetings {
 public:
  /// Takes a message of the host. Messages of several connections may come in another order than they were
  /// sent.
  void on_message(const host_time::Message& message);
  /// Returns the first process of the host, or -1 if there is none yet.
  int first_process() const { return first_process_; }
  /// Returns true if the program that the process is now has not greeted.
  bool is_silent(int process) const;
  /// Must be called when a silent process has ended. Returns true if it is the first of them that must be
  /// reported: what the first process of the host does is told by was_reached().
  bool silent_one_ended(int process);
  /// Returns true if the host was in simulated time: its first process had the library at its end, and if
  /// another process did not, at least something of the host has waited.
  bool was_reached() const {
    return first_process_ >= 0 && !is_first_silent_ && (has_waited_ || !has_silence_);
  }

 private:
  int first_process_ = -1;
  std::map<int, int> owed_;  // how many programs each process has become, less those that have greeted
  bool is_first_silent_ = false;
  bool has_silence_ = false;  // of another process
  bool has_waited_ = false;
};

}  // namespace understudy::emulator::serve
