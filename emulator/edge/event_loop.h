// Waiting for descriptors and for a moment, on one thread: epoll in one small class.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>

namespace understudy::emulator {

/// The wall clock of the edge: CLOCK_MONOTONIC. The model never sees it.
using WallTime = std::chrono::nanoseconds;
WallTime wall_now();

class EventLoop {
 public:
  EventLoop();
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  enum Readiness : std::uint32_t { readable = 1, writable = 2 };

  /// Calls `ready` whenever the descriptor is ready for what is in `interest` (or has hung up).
  void watch(int descriptor, std::uint32_t interest, std::function<void(std::uint32_t ready)> ready);
  void change_interest(int descriptor, std::uint32_t interest);
  void unwatch(int descriptor);

  /// Waits until something is ready, or `until` has come (nothing: as long as it takes), and calls what
  /// is ready. A moment in the past only looks.
  void wait(std::optional<WallTime> until);

 private:
  struct Watch {
    std::uint32_t interest = 0;
    std::shared_ptr<std::function<void(std::uint32_t)>> ready;  // outlives an unwatch() from inside
  };
  void wake_at(WallTime moment);

  int epoll_ = -1;
  int timer_ = -1;
  WallTime alarm_{0};  // what the timer is, or was last, set for
  std::map<int, Watch> watches_;
};

}  // namespace understudy::emulator
