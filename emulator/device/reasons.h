// Why commands had no effect, for people: "Aaxis_Move_INC: the servo of axis A is off". It is not part of a
// device's state: reading it changes nothing, and it is empty after a restore.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"

namespace understudy::emulator {

class Reasons {
 public:
  static constexpr std::size_t kKept = 32;

  struct Said {
    Tick tick = 0;
    std::string text;
  };

  /// Programs may repeat a command in every tick, so the last reason is not repeated for a second.
  void say(Tick tick, std::string text) {
    const bool is_repeated = !is_new_request_ && !said_.empty() && said_.back().text == text &&
                             tick - said_.back().tick < kQuietTicks;
    is_new_request_ = false;
    if (is_repeated) return;
    if (said_.size() == kKept) said_.pop_front();
    said_.push_back({tick, std::move(text)});
    ++next_number_;
  }
  /// Lets the next reason be given even if it is a repetition, because another request has come.
  void begin_request() { is_new_request_ = true; }

  /// Returns the number of the next reason. Reasons are numbered from 0.
  std::uint64_t next_number() const { return next_number_; }
  /// Returns the reasons that are still kept, from that number on.
  std::vector<Said> since(std::uint64_t number) const {
    const std::uint64_t first = next_number_ - said_.size();
    const std::uint64_t from = number < first ? first : number < next_number_ ? number : next_number_;
    return {said_.begin() + static_cast<std::ptrdiff_t>(from - first), said_.end()};
  }

 private:
  static constexpr Tick kQuietTicks = 1'000;

  std::deque<Said> said_;
  std::uint64_t next_number_ = 0;
  bool is_new_request_ = false;
};

}  // namespace understudy::emulator
