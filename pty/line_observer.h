// Watches a line without being on it: it is told what goes over the wire, and never answers, so the line and
// its stations do the same with or without it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "pty/station.h"

namespace understudy::pty {

/// One transmission of a station.
struct Speech {
  std::span<const std::uint8_t> bytes;  // as the station said them
  SimTime start{0};                     // of the first character
  bool has_collided = false;            // ran into what another station was saying
  bool is_for_host = true;              // false: no host is there to read it
};

/// A fault that acted on a message.
struct Strike {
  std::uint64_t fault = 0;  // its number
  std::string_view kind;    // "drop"
  std::string_view effect;  // "not said"
};

/// What faults have done to one message.
struct StruckMessage {
  SimTime time{0};
  bool is_reply = false;  // else a request
  bool is_said = false;   // a reply that follows at once, as they have made it
  std::span<const Strike> strikes;
};

class LineObserver {
 public:
  virtual ~LineObserver() = default;

  /// A character from the host has begun; on_character() follows. Only where characters take time.
  virtual void on_start_bit(SimTime at) = 0;
  /// A character from the host is over. `is_heard`: by a station at least.
  virtual void on_character(const TimedByte& character, bool is_heard) = 0;
  /// Nothing more has come for a while although the clock stands (Station::hear_nothing_more).
  virtual void on_nothing_more() = 0;

  // What the host does, when it does it. `bytes` are those that the line takes.
  virtual void on_receive(std::span<const std::uint8_t> /*bytes*/, bool /*is_departed*/) {}
  virtual void on_host_opened() {}
  virtual void on_host_closed() {}
  virtual void on_host_purged() {}
  virtual void on_host_settings(const std::optional<HostSettings>& /*settings*/) {}

  /// A station has begun to talk.
  virtual void on_speech(const Speech& speech) = 0;

  /// What comes next for the host has no room any more, and is lost unless some of what waits is taken now.
  virtual void on_output_full() {}

  /// Faults have acted on a message. For a request this comes after what was heard, for a reply before what
  /// is said.
  virtual void on_strike(const StruckMessage& /*message*/) {}

  /// When run() wants to be called next. At equal times it comes before the stations, so that what they
  /// answer follows what they were asked.
  virtual std::optional<SimTime> due() const = 0;
  virtual void run(SimTime now) = 0;
  /// As Station::quiet_characters().
  virtual std::size_t quiet_characters() const { return 0; }
};

}  // namespace understudy::pty
