// Simulates the timers of a host in simulated time.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "base/simulated_time.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

class HostTimers {
 public:
  struct Expired {
    int process = -1;
    int target = 0;         // the thread that receives the signal; 0: any thread
    int signal_number = 0;  // 0: the timer counts in a descriptor
    std::int64_t value = 0;
    bool operator==(const Expired&) const = default;
  };

  /// Sets or removes the timer in the message. `counter` is empty if the timer sends a signal.
  void set(const host_time::Message& message, Descriptor counter);
  /// Forgets the timers of a process.
  void process_ended(int process);
  std::optional<SimTime> next() const;
  /// Returns the timers that have expired at `now`, ordered by process and number. Increments the counters of
  /// timers with a descriptor.
  std::vector<Expired> expire(SimTime now);

 private:
  struct Timer {
    SimTime next{0};
    SimTime interval{0};
    Expired notice{};
    Descriptor counter;
  };
  std::map<std::pair<int, std::uint32_t>, Timer> timers_;  // keyed by process and number
};

/// Sends the signal of a timer as the kernel does.
void send_signal(const HostTimers::Expired& expired);

}  // namespace understudy::emulator::serve
