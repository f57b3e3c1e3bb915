// Waits for descriptors and timeouts on a single thread with epoll. Urgent descriptors (ports, signals) come
// first in every turn. After that, other requests get a slice of time.
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

/// Time of the wall clock: CLOCK_MONOTONIC. The model never sees it.
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
  /// The rank of a descriptor. Ready descriptors of rank `later` are called last, one after another, for at
  /// most a slice of time. So the urgent descriptors are checked again soon, however many of rank `later`
  /// there are.
  enum class Rank : std::uint8_t { first, later };
  static constexpr WallTime kLaterSlice = std::chrono::microseconds(30);
  /// The slice if nothing can be late, as in virtual time.
  static constexpr WallTime kLongSlice = std::chrono::milliseconds(1);
  /// Work of rank `later` does not begin within this time before something is due, but waits until that is
  /// done.
  static constexpr WallTime kRoom = std::chrono::microseconds(100);

  /// Calls `ready` whenever the descriptor is ready for one of the states in `interest`, or has hung up.
  void watch(int descriptor, std::uint32_t interest, std::function<void(std::uint32_t ready)> ready,
             Rank rank = Rank::first);
  void change_interest(int descriptor, std::uint32_t interest);
  void unwatch(int descriptor);

  /// Runs work piece by piece, alternating with descriptors of rank `later`. Calls `piece` again as long as
  /// it returns true.
  void do_in_pieces(std::function<bool()> piece);
  /// Returns true if work of rank `later` should leave the rest for another turn.
  bool slice_is_over() const;

  /// Waits until a descriptor is ready, or until `until` (nothing: no limit), and calls what is ready. Does
  /// not wait if `until` is in the past.
  void wait(std::optional<WallTime> until, WallTime slice = kLaterSlice);

 private:
  struct Watch {
    int epoll = -1;  // the epoll that contains the descriptor
    std::uint32_t interest = 0;
    std::uint32_t known = 0;                                    // the interest that the kernel knows
    std::shared_ptr<std::function<void(std::uint32_t)>> ready;  // outlives an unwatch() from inside the call
    std::uint64_t turn = 0;                                     // the turn in which it began
  };
  void wake_at(WallTime moment);
  void update_interests();
  bool is_new(int descriptor) const;
  void call(int descriptor, std::uint32_t events);
  void mute_later_ones(bool are_muted);
  void call_later_ones(bool are_ready, WallTime slice);

  int epoll_ = -1;
  int later_ = -1;  // another epoll, inside `epoll_`
  int timer_ = -1;
  WallTime alarm_{0};  // the time for which the timer is or was last set
  std::map<int, Watch> watches_;
  std::uint64_t turn_ = 0;
  std::vector<int> changed_;  // descriptors whose interest must still be passed to the kernel
  std::deque<std::function<bool()>> pieces_;
  bool are_pieces_next_ = false;
  WallTime slice_end_ = WallTime::max();  // for rank `later`; unlimited at other times
  bool puts_off_ = false;                 // rank `later` is waiting until due work is done
  bool has_put_off_ = false;              // rank `later` has waited since it was last called
  WallTime put_off_until_{0};             // when the due work is due
};

}  // namespace understudy::emulator::serve
