#include "emulator/serve/loop/event_loop.h"

#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMaxPieces = 64;  // the most pieces in progress at a time

std::uint32_t epoll_events(std::uint32_t interest) {
  return ((interest & EventLoop::readable) != 0 ? EPOLLIN : 0U) |
         ((interest & EventLoop::writable) != 0 ? EPOLLOUT : 0U) |
         ((interest & EventLoop::departed) != 0 ? EPOLLRDHUP : 0U);
}

}  // namespace

WallTime wall_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

EventLoop::EventLoop()
    : epoll_(epoll_create1(EPOLL_CLOEXEC)),
      later_(epoll_create1(EPOLL_CLOEXEC)),
      timer_(timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC)) {
  if (epoll_ < 0 || later_ < 0) throw std::system_error(errno, std::generic_category(), "epoll_create1");
  if (timer_ < 0) throw std::system_error(errno, std::generic_category(), "timerfd_create");
  // The timer is edge-triggered: the loop is notified of an expiration once and need not read it. Setting the
  // timer again clears it.
  epoll_event event{};
  event.events = EPOLLIN | EPOLLET;
  event.data.fd = timer_;
  if (epoll_ctl(epoll_, EPOLL_CTL_ADD, timer_, &event) < 0) {
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
  event.events = EPOLLIN;
  event.data.fd = later_;
  if (epoll_ctl(epoll_, EPOLL_CTL_ADD, later_, &event) < 0) {
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
}

EventLoop::~EventLoop() {
  close(timer_);
  close(later_);
  close(epoll_);
}

void EventLoop::watch(int descriptor, std::uint32_t interest, std::function<void(std::uint32_t)> ready,
                      Rank rank) {
  const int epoll = rank == Rank::first ? epoll_ : later_;
  watches_[descriptor] = {epoll, interest, interest,
                          std::make_shared<std::function<void(std::uint32_t)>>(std::move(ready)), turn_};
  epoll_event event{};
  event.events = epoll_events(interest);
  event.data.fd = descriptor;
  if (epoll_ctl(epoll, EPOLL_CTL_ADD, descriptor, &event) < 0) {
    watches_.erase(descriptor);
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
}

void EventLoop::change_interest(int descriptor, std::uint32_t interest) {
  const auto it = watches_.find(descriptor);
  if (it == watches_.end() || it->second.interest == interest) return;
  it->second.interest = interest;
  changed_.push_back(descriptor);
}

/// Passes the changed interests to the kernel. This is delayed until the next poll, so that an interest that
/// changes back, as after an immediate reply, costs nothing.
void EventLoop::update_interests() {
  for (const int descriptor : changed_) {
    const auto it = watches_.find(descriptor);
    if (it == watches_.end() || it->second.known == it->second.interest) continue;
    it->second.known = it->second.interest;
    epoll_event event{};
    event.events = epoll_events(it->second.interest);
    event.data.fd = descriptor;
    epoll_ctl(it->second.epoll, EPOLL_CTL_MOD, descriptor, &event);
  }
  changed_.clear();
}

void EventLoop::unwatch(int descriptor) {
  const auto it = watches_.find(descriptor);
  if (it == watches_.end()) return;
  epoll_ctl(it->second.epoll, EPOLL_CTL_DEL, descriptor, nullptr);
  watches_.erase(it);
}

/// Sets a timer that stays set over many waits. A timeout for each wait would set and cancel a timer each
/// time, which takes several times as long as serving a request.
void EventLoop::wake_at(WallTime moment) {
  if (alarm_ == moment) return;
  alarm_ = moment;
  itimerspec setting{};
  setting.it_value.tv_sec = moment.count() / 1'000'000'000;
  setting.it_value.tv_nsec = moment.count() % 1'000'000'000;
  timerfd_settime(timer_, TFD_TIMER_ABSTIME, &setting, nullptr);
}

void EventLoop::do_in_pieces(std::function<bool()> piece) { pieces_.push_back(std::move(piece)); }

bool EventLoop::slice_is_over() const { return slice_end_ != WallTime::max() && wall_now() >= slice_end_; }

/// Prevents descriptors of rank `later` from waking the loop.
void EventLoop::mute_later_ones(bool are_muted) {
  epoll_event event{};
  event.events = are_muted ? 0U : EPOLLIN;
  event.data.fd = later_;
  epoll_ctl(epoll_, EPOLL_CTL_MOD, later_, &event);
}

void EventLoop::wait(std::optional<WallTime> until, WallTime slice) {
  const auto is_due_soon = [&] { return until && *until - wall_now() < kRoom; };
  const bool is_due = until && *until <= wall_now();
  const bool was_put_off = std::exchange(puts_off_, false);
  const bool puts_off = was_put_off && !is_due && is_due_soon();
  // The timer may still be set for a moment that no longer matters. In that case, it wakes the loop once for
  // nothing.
  if (until && !is_due) wake_at(*until);
  if (puts_off) mute_later_ones(true);
  const bool only_looks = is_due || (!pieces_.empty() && !puts_off);
  update_interests();
  std::array<epoll_event, 32> events{};
  const int count = epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), only_looks ? 0 : -1);
  ++turn_;
  if (puts_off) mute_later_ones(false);
  bool later_ones = false;
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = events[static_cast<std::size_t>(i)];
    if (event.data.fd == later_) {
      later_ones = true;
    } else if (!is_new(event.data.fd)) {
      call(event.data.fd, event.events);
    }
  }
  if (was_put_off && (puts_off || is_due)) {  // the due work comes first
    puts_off_ = wall_now() < put_off_until_;
    return;
  }
  if (!later_ones && pieces_.empty()) return;
  if (slice == kLaterSlice && !is_due && !has_put_off_ && is_due_soon()) {
    has_put_off_ = puts_off_ = true;
    put_off_until_ = *until;
    return;
  }
  has_put_off_ = false;
  call_later_ones(later_ones, slice);
}

/// Returns true if the watch began in this turn. An event of this turn then belongs to another descriptor
/// that had the same number and was closed.
bool EventLoop::is_new(int descriptor) const {
  const auto it = watches_.find(descriptor);
  return it != watches_.end() && it->second.turn == turn_;
}

void EventLoop::call(int descriptor, std::uint32_t events) {
  const auto it = watches_.find(descriptor);
  if (it == watches_.end()) return;  // an earlier call has removed the watch
  std::uint32_t ready = 0;
  if ((events & (EPOLLIN | EPOLLHUP | EPOLLERR)) != 0) ready |= readable;
  if ((events & (EPOLLOUT | EPOLLERR)) != 0) ready |= writable;
  if ((events & (EPOLLRDHUP | EPOLLHUP | EPOLLERR)) != 0) ready |= departed;
  const auto function = it->second.ready;
  (*function)(ready);
}

/// Calls the descriptors of rank `later` one by one. The kernel moves descriptors that stay ready to the end
/// of its list, so all of them get their turn.
void EventLoop::call_later_ones(bool are_ready, WallTime slice) {
  slice_end_ = wall_now() + slice;
  do {
    // With too many pieces of work in progress, new messages wait until some are done.
    const bool are_many = pieces_.size() >= kMaxPieces;
    if (!pieces_.empty() && (are_pieces_next_ || !are_ready || are_many)) {
      are_pieces_next_ = false;
      const std::function<bool()> piece = std::move(pieces_.front());
      pieces_.pop_front();
      if (piece()) pieces_.push_back(piece);
    } else if (are_ready) {
      are_pieces_next_ = true;
      update_interests();
      epoll_event event{};
      are_ready = epoll_wait(later_, &event, 1, 0) == 1;
      if (are_ready) call(event.data.fd, event.events);
    } else {
      break;
    }
  } while (!slice_is_over());
  slice_end_ = WallTime::max();
}

}  // namespace understudy::emulator::serve
