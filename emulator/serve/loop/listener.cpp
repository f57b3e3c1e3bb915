#include "emulator/serve/loop/listener.h"

#include <sys/socket.h>
#include <sys/timerfd.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <functional>
#include <system_error>
#include <utility>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::chrono::nanoseconds kRest = std::chrono::milliseconds(250);

}  // namespace

Listener::Listener(EventLoop& loop, Descriptor socket, std::function<void(Descriptor)> admit,
                   EventLoop::Rank rank)
    : loop_(loop),
      socket_(std::move(socket)),
      timer_(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)),
      admit_(std::move(admit)) {
  if (!timer_) throw std::system_error(errno, std::generic_category(), "timerfd_create");
  loop_.watch(
      socket_.get(), EventLoop::readable, [this](std::uint32_t) { accept_all(); }, rank);
  loop_.watch(timer_.get(), EventLoop::readable, [this](std::uint32_t) {
    std::uint64_t ignored = 0;
    if (read(timer_.get(), &ignored, sizeof ignored) > 0) try_again();
  });
}

Listener::~Listener() {
  loop_.unwatch(timer_.get());
  loop_.unwatch(socket_.get());
}

void Listener::accept_all() {
  while (!is_resting_) {
    Descriptor client(accept4(socket_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (client) {
      admit_(std::move(client));
      continue;
    }
    if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) rest();
    return;  // the loop reports the remaining clients again
  }
}

/// Stops listening for a while. Otherwise, the loop would report the waiting clients again and again.
void Listener::rest() {
  is_resting_ = true;
  loop_.change_interest(socket_.get(), 0);
  itimerspec when{};
  when.it_value.tv_nsec = kRest.count();
  timerfd_settime(timer_.get(), 0, &when, nullptr);
}

void Listener::try_again() {
  if (!is_resting_) return;
  is_resting_ = false;
  loop_.change_interest(socket_.get(), EventLoop::readable);
}

}  // namespace understudy::emulator::serve
