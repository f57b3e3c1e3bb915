#include "pty/presence_watch.h"

#include <sys/inotify.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace understudy::pty {
namespace {

/// A terminal that is not served for a while stores at most this many events. Beyond that, it must check for
/// itself.
constexpr std::size_t kMaxEvents = 256;

}  // namespace

PresenceWatch::PresenceWatch() : instance_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {}

void PresenceWatch::collect() {
  if (!instance_) return;
  alignas(inotify_event) std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t size = ::read(instance_.get(), buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) break;
    for (std::size_t at = 0; at < static_cast<std::size_t>(size);) {
      inotify_event event = {};
      std::memcpy(&event, buffer.data() + at, sizeof event);
      at += sizeof event + event.len;
      if ((event.mask & IN_Q_OVERFLOW) != 0) {
        for (auto& [number, events] : events_) add(events, event.mask);
        continue;
      }
      const auto found = events_.find(event.wd);  // the terminal may have been closed
      if (found != events_.end()) add(found->second, event.mask);
    }
  }
}

/// Equal neighbours are merged, as in the kernel's own queue.
void PresenceWatch::add(std::vector<std::uint32_t>& events, std::uint32_t mask) {
  if (!events.empty() && events.back() == mask) return;
  if (events.size() >= kMaxEvents) {
    events.assign(1, IN_Q_OVERFLOW);
    return;
  }
  events.push_back(mask);
}

PresenceWatch::Place::Place(PresenceWatch& watch, const std::string& path) {
  if (!watch.instance_) return;
  number_ =
      ::inotify_add_watch(watch.instance_.get(), path.c_str(), IN_OPEN | IN_CLOSE_WRITE | IN_CLOSE_NOWRITE);
  if (number_ < 0) return;
  watch_ = &watch;
  watch.events_[number_].clear();
}

PresenceWatch::Place::Place(Place&& other) noexcept
    : watch_(std::exchange(other.watch_, nullptr)), number_(std::exchange(other.number_, -1)) {}

PresenceWatch::Place& PresenceWatch::Place::operator=(Place&& other) noexcept {
  if (this == &other) return *this;
  leave();
  watch_ = std::exchange(other.watch_, nullptr);
  number_ = std::exchange(other.number_, -1);
  return *this;
}

void PresenceWatch::Place::leave() {
  if (watch_ == nullptr) return;
  ::inotify_rm_watch(watch_->instance_.get(), number_);
  watch_->events_.erase(number_);
  watch_ = nullptr;
}

bool PresenceWatch::Place::has_events() const {
  return watch_ != nullptr && !watch_->events_.at(number_).empty();
}

std::vector<std::uint32_t> PresenceWatch::Place::take_events() {
  if (watch_ == nullptr) return {};
  return std::exchange(watch_->events_.at(number_), {});
}

}  // namespace understudy::pty
