#include "emulator/edge/event_loop.h"

#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace understudy::emulator {

namespace {

std::uint32_t epoll_events(std::uint32_t interest) {
  return ((interest & EventLoop::readable) != 0 ? EPOLLIN : 0U) |
         ((interest & EventLoop::writable) != 0 ? EPOLLOUT : 0U);
}

}  // namespace

WallTime wall_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

EventLoop::EventLoop()
    : epoll_(epoll_create1(EPOLL_CLOEXEC)), timer_(timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC)) {
  if (epoll_ < 0) throw std::system_error(errno, std::generic_category(), "epoll_create1");
  if (timer_ < 0) throw std::system_error(errno, std::generic_category(), "timerfd_create");
  // Edge-triggered: an expiration is told once and needs no reading, setting the timer again clears it.
  epoll_event event{};
  event.events = EPOLLIN | EPOLLET;
  event.data.fd = timer_;
  if (epoll_ctl(epoll_, EPOLL_CTL_ADD, timer_, &event) < 0) {
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
}

EventLoop::~EventLoop() {
  close(timer_);
  close(epoll_);
}

void EventLoop::watch(int descriptor, std::uint32_t interest, std::function<void(std::uint32_t)> ready) {
  watches_[descriptor] = {interest, std::make_shared<std::function<void(std::uint32_t)>>(std::move(ready))};
  epoll_event event{};
  event.events = epoll_events(interest);
  event.data.fd = descriptor;
  if (epoll_ctl(epoll_, EPOLL_CTL_ADD, descriptor, &event) < 0) {
    watches_.erase(descriptor);
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
}

void EventLoop::change_interest(int descriptor, std::uint32_t interest) {
  const auto it = watches_.find(descriptor);
  if (it == watches_.end() || it->second.interest == interest) return;
  it->second.interest = interest;
  epoll_event event{};
  event.events = epoll_events(interest);
  event.data.fd = descriptor;
  epoll_ctl(epoll_, EPOLL_CTL_MOD, descriptor, &event);
}

void EventLoop::unwatch(int descriptor) {
  epoll_ctl(epoll_, EPOLL_CTL_DEL, descriptor, nullptr);
  watches_.erase(descriptor);
}

/// A timer that stays set over many waits: a timeout of each wait would set and cancel one every time,
/// which costs several times what serving a request does.
void EventLoop::wake_at(WallTime moment) {
  if (alarm_ == moment) return;
  alarm_ = moment;
  itimerspec setting{};
  setting.it_value.tv_sec = moment.count() / 1'000'000'000;
  setting.it_value.tv_nsec = moment.count() % 1'000'000'000;
  timerfd_settime(timer_, TFD_TIMER_ABSTIME, &setting, nullptr);
}

void EventLoop::wait(std::optional<WallTime> until) {
  const bool only_look = until && *until <= wall_now();
  // A timer that is still set for a moment nobody waits for any more wakes us once, for nothing.
  if (until && !only_look) wake_at(*until);
  std::array<epoll_event, 32> events{};
  const int count = epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), only_look ? 0 : -1);
  for (int i = 0; i < count; ++i) {
    const auto it = watches_.find(events[static_cast<std::size_t>(i)].data.fd);
    if (it == watches_.end()) continue;  // an earlier call has unwatched it
    const std::uint32_t what = events[static_cast<std::size_t>(i)].events;
    std::uint32_t ready = 0;
    if ((what & (EPOLLIN | EPOLLHUP | EPOLLERR)) != 0) ready |= readable;
    if ((what & (EPOLLOUT | EPOLLERR)) != 0) ready |= writable;
    const auto call = it->second.ready;
    (*call)(ready);
  }
}

}  // namespace understudy::emulator
