// Waiting for descriptors and for a moment, on one thread: epoll in one small class. What must not wait
// (ports, signals) comes first in every turn; after that, requests from others get a slice of time.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace understudy::emulator::serve {

/// The wall clock of the edge: CLOCK_MONOTONIC. The model never sees it.
using WallTime = std::chrono::nanoseconds;
WallTime wall_now();

class EventLoop {
 public:
  EventLoop();
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  /// `departed`: the other side of a socket has closed its sending half, or the connection is broken.
  enum Readiness : std::uint32_t { readable = 1, writable = 2, departed = 4 };
  /// Of everything that is ready, what is `later` is called last, one after the other in turn, and for at
  /// most a slice of time: however many there are, the others are looked at again soon.
  enum class Rank : std::uint8_t { first, later };
  static constexpr WallTime kLaterSlice = std::chrono::microseconds(30);
  /// Where nothing can be late, as when simulated time goes by as fast as it can.
  static constexpr WallTime kLongSlice = std::chrono::milliseconds(1);
  /// What is `later` does not begin so shortly before something is due: it waits for that first.
  static constexpr WallTime kRoom = std::chrono::microseconds(100);

  /// Calls `ready` whenever the descriptor is ready for one of `interest` (or has hung up).
  void watch(int descriptor, std::uint32_t interest, std::function<void(std::uint32_t ready)> ready,
             Rank rank = Rank::first);
  void change_interest(int descriptor, std::uint32_t interest);
  void unwatch(int descriptor);

  /// Work that is done piece by piece, in turn with what is `later`: `piece` is called again as long as it
  /// returns true.
  void do_in_pieces(std::function<bool()> piece);
  /// Asked by what is `later`: whether it should leave what it can for another time.
  bool slice_is_over() const;

  /// Waits until something is ready, or `until` has come (nothing: as long as it takes), and calls what is
  /// ready. With a moment in the past it does not wait.
  void wait(std::optional<WallTime> until, WallTime slice = kLaterSlice);

 private:
  struct Watch {
    int epoll = -1;  // that it is in
    std::uint32_t interest = 0;
    std::uint32_t told = 0;                                     // the interest that the kernel knows of
    std::shared_ptr<std::function<void(std::uint32_t)>> ready;  // outlives an unwatch() from inside
  };
  void wake_at(WallTime moment);
  void tell_interests();
  void call(int descriptor, std::uint32_t events);
  void mute_later_ones(bool are_muted);
  void call_later_ones(bool are_ready, WallTime slice);

  int epoll_ = -1;
  int later_ = -1;  // another epoll, in that one
  int timer_ = -1;
  WallTime alarm_{0};  // what the timer is set for, or was last set for
  std::map<int, Watch> watches_;
  std::vector<int> changed_;  // whose interest the kernel may not know of yet
  std::deque<std::function<bool()>> pieces_;
  bool are_pieces_next_ = false;
  WallTime slice_end_ = WallTime::max();  // of what is `later`; no end outside of it
  bool puts_off_ = false;                 // what is `later` waits for something that is due soon
  bool has_put_off_ = false;              // since it was last called,
  WallTime put_off_until_{0};             // for something due then
};

}  // namespace understudy::emulator::serve
