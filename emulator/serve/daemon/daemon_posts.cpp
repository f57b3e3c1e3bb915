// Handles work that other threads post to a daemon.
#include <sys/eventfd.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <functional>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/pacer.h"

namespace understudy::emulator::serve {

void Daemon::watch_posts() {
  posted_signal_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (posted_signal_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
  loop_.watch(posted_signal_, EventLoop::readable, [this](std::uint32_t) {
    std::uint64_t ignored = 0;
    [[maybe_unused]] const ssize_t got = read(posted_signal_, &ignored, sizeof ignored);
    std::vector<std::function<void()>> acts;
    {
      const std::lock_guard lock(posted_mutex_);
      acts.swap(posted_);
    }
    catch_up();
    const SimTime before = world_.now();
    for (const auto& act : acts) act();
    if (world_.now() != before) pacer_.moved_to(world_.now(), wall_now());
  });
}

bool Daemon::post(std::function<void()> act) {
  {
    const std::lock_guard lock(posted_mutex_);
    if (is_over_) return false;
    posted_.push_back(std::move(act));
  }
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t put = write(posted_signal_, &one, sizeof one);
  return true;
}

void Daemon::do_aside(std::function<std::function<void()>()> work) {
  helper_->give([this, work = std::move(work)] { post(work()); });
}

bool Daemon::is_over() {
  const std::lock_guard lock(posted_mutex_);
  return is_over_;
}

/// Drops the posted functions. Their destructors notify waiting threads that they will never run.
void Daemon::end_posts() {
  std::vector<std::function<void()>> dropped;
  const std::lock_guard lock(posted_mutex_);
  is_over_ = true;
  dropped.swap(posted_);
}

}  // namespace understudy::emulator::serve
