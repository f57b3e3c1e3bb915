// The lines whose bytes a host in simulated time gets announced by a signal (O_ASYNC).
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

class HostWatches {
 public:
  /// Sets or removes the watch that the message names.
  void set(const host_time::Message& message);
  /// Forgets the watches that a process has set.
  void process_ended(int process);
  bool is_any() const { return !watches_.empty(); }
  bool is_watched(int terminal) const;
  /// Sends the signals of a line that has got bytes, in the order of processes and descriptors. Returns true
  /// if there were any.
  bool line_has_news(int terminal) const;

 private:
  std::map<std::pair<int, std::uint32_t>, host_time::Message> watches_;  // keyed by process and descriptor
};

}  // namespace understudy::emulator::serve
