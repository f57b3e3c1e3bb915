// Keeps everything that happened in a run: each request with its reply, and each event. Recordings need this,
// because the logs of a daemon keep only the most recent entries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "base/simulated_time.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

/// A request with its reply, or a frame that does not belong to any other frame.
struct Exchange {
  std::string line;
  SimTime begin{0};
  SimTime end{0};         // the end of its last frame
  std::string request{};  // empty if a station sent something without a request
  std::string reply{};    // empty if there was no reply
  std::string remark{};   // why a frame was dropped, or another remark
  std::optional<SimTime> latency{};
  bool is_refusal = false;
};

class History {
 public:
  /// Beyond these limits, the oldest entries are dropped.
  static constexpr std::size_t kMaxExchanges = 200'000;
  static constexpr std::size_t kMaxEvents = 100'000;

  /// Adds the new entries of the logs. Call this before the logs drop entries.
  void collect(const World& world, const FrameLog& frames, EventLog& events);

  const std::deque<Exchange>& exchanges() const { return exchanges_; }
  const std::deque<Event>& events() const { return events_; }
  std::uint64_t dropped() const { return dropped_; }

 private:
  static constexpr std::size_t kMaxUnanswered = 1'024;

  void take(const World& world, const FrameLog::Decoded& frame);
  Exchange* request_of(const FrameLog::Decoded& frame);

  std::deque<Exchange> exchanges_;
  std::deque<Event> events_;
  std::map<std::string, std::uint64_t> last_requests_;  // by line: the number of its last request
  std::map<std::uint64_t, std::uint64_t> requests_;  // by frame: the number of its exchange, for late replies
  std::uint64_t next_frame_ = 1;
  std::uint64_t next_event_ = 1;
  std::uint64_t dropped_exchanges_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace understudy::emulator::world
