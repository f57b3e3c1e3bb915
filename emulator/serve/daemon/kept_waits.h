// Keeps the last waits of a host in simulated time, for observers of a running bench.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"

namespace understudy::emulator::serve {

/// A wait of a thread. Threads are numbered from 1, in the order in which they greeted the bench.
struct HostWait {
  std::size_t thread = 0;
  SimTime begin{0};
  SimTime end{0};
  std::string text{};
  bool operator==(const HostWait&) const = default;
};

class KeptWaits {
 public:
  static constexpr std::size_t kMax = 4'096;

  void keep(HostWait wait) {
    waits_.push_back(std::move(wait));
    if (waits_.size() <= kMax) return;
    waits_.pop_front();
    ++dropped_;
  }
  /// `under_way` returns the waits that have not ended, up to the present time.
  void add_source(std::function<std::vector<HostWait>()> under_way) { under_way_ = std::move(under_way); }

  const std::deque<HostWait>& ended() const { return waits_; }
  std::vector<HostWait> under_way() const { return under_way_ ? under_way_() : std::vector<HostWait>{}; }
  /// Returns how many old waits have been dropped.
  std::uint64_t dropped() const { return dropped_; }

 private:
  std::deque<HostWait> waits_;  // ordered by their end
  std::uint64_t dropped_ = 0;
  std::function<std::vector<HostWait>()> under_way_;
};

}  // namespace understudy::emulator::serve
