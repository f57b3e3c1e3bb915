// The page of memory that a host in simulated time reads: the current time, and the terminals of the bench.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/simulated_time.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

class HostPage {
 public:
  /// Creates the file. Throws std::system_error.
  explicit HostPage(const std::string& path);
  ~HostPage();
  HostPage(const HostPage&) = delete;
  HostPage& operator=(const HostPage&) = delete;

  void set_now(SimTime now);
  /// Wakes the threads that wait for this thread's word, which is a futex.
  void wake(int thread);
  void set_line(std::size_t line, int terminal);
  /// `address` is empty for this machine itself.
  void set_door(std::size_t door, std::uint16_t port, const std::string& address);

 private:
  std::string path_;
  host_time::Page* page_ = nullptr;
};

}  // namespace understudy::emulator::serve
