// Detects which pseudo-terminals hosts have opened and closed. One inotify instance serves all terminals of a
// program, because Linux gives a user only 128 (fs.inotify.max_user_instances).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/files/descriptor.h"

namespace understudy::pty {

class PresenceWatch {
 public:
  /// If the user has no instance left, nothing is watched, and each terminal must check for itself.
  PresenceWatch();
  PresenceWatch(const PresenceWatch&) = delete;
  PresenceWatch& operator=(const PresenceWatch&) = delete;

  /// Returns a descriptor that is readable when collect() has something to do; -1: there is no instance.
  int descriptor() const { return instance_.get(); }
  /// Puts the kernel's events into the queues of the terminals that they are about.
  void collect();

  /// The events of one terminal. It must not outlive the watch.
  class Place {
   public:
    Place() = default;  // watches nothing
    Place(PresenceWatch& watch, const std::string& path);
    ~Place() { leave(); }
    Place(Place&& other) noexcept;
    Place& operator=(Place&& other) noexcept;

    /// Returns false if the kernel does not watch this terminal.
    explicit operator bool() const { return watch_ != nullptr; }
    bool has_events() const;
    /// Takes the events (IN_OPEN, IN_CLOSE and so on) that have been collected, in their order.
    std::vector<std::uint32_t> take_events();

   private:
    void leave();

    PresenceWatch* watch_ = nullptr;
    int number_ = -1;  // the kernel's number of the watch
  };

 private:
  void add(std::vector<std::uint32_t>& events, std::uint32_t mask);

  Descriptor instance_;
  std::map<int, std::vector<std::uint32_t>> events_;
};

}  // namespace understudy::pty
