// Watches a line without taking part: an observer is notified of the traffic on the wire and never answers,
// so the line and its stations behave the same with or without it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "pty/station.h"

namespace understudy::pty {

/// One transmission of a station.
struct Transmission {
  std::span<const std::uint8_t> bytes;  // as the station sent them
  SimTime start{0};                     // the start of the first character
  bool has_collided = false;            // overlapped another station's transmission
  bool is_for_host = true;              // false: no host has the line open
  std::uint64_t last_character = 0;     // of the request that it answers; 0: it answers none
};

/// A request that a station has executed or refused.
struct ServedRequest {
  std::size_t station = 0;  // its number on the line
  SimTime time{0};
  std::uint64_t last_character = 0;  // of the request
  std::span<const std::uint8_t> request;
  std::span<const std::uint8_t> answer;  // without address and checksum, even if the station sends no answer
  std::string_view why{};                // why it had no effect or was refused, as far as the station says so
};

/// A fault that acted on a message.
struct Strike {
  std::uint64_t fault = 0;  // its number
  std::string_view kind;    // "drop"
  std::string_view effect;  // for example "not sent"
};

/// The effects of faults on one message.
struct StruckMessage {
  SimTime time{0};
  bool is_reply = false;  // otherwise a request
  bool is_sent = false;   // a reply that follows at once, as the faults have changed it
  std::span<const Strike> strikes;
};

class LineObserver {
 public:
  virtual ~LineObserver() = default;

  /// A character from the host has begun; on_character() follows. Called only if characters take time.
  virtual void on_start_bit(SimTime at) = 0;
  /// A character from the host has ended. `is_received` is true if at least one station received it.
  virtual void on_character(const TimedByte& character, bool is_received) = 0;
  /// The clock is stopped, and no more characters have arrived for a while (Station::on_idle).
  virtual void on_nothing_more() = 0;

  // These functions report the host's actions when they happen. `bytes` are those that the line takes.
  virtual void on_receive(std::span<const std::uint8_t> /*bytes*/, bool /*is_departed*/) {}
  virtual void on_host_opened() {}
  virtual void on_host_closed() {}
  virtual void on_host_purged() {}
  virtual void on_host_settings(const std::optional<HostSettings>& /*settings*/) {}

  /// A station has begun to transmit.
  virtual void on_transmission(const Transmission& transmission) = 0;

  /// A station has executed or refused a request. Its answer, if it sends one, follows.
  virtual void on_served(const ServedRequest& /*request*/) {}

  /// The buffer for the host is full: the next byte is lost unless the observer takes some of the output
  /// now.
  virtual void on_output_full() {}

  /// Faults have acted on a message. For a request this is called after its characters, for a reply before
  /// its transmission.
  virtual void on_strike(const StruckMessage& /*message*/) {}

  /// Returns when run() wants to be called next. At equal times observers run before stations, so that a
  /// request is captured before its reply.
  virtual std::optional<SimTime> due() const = 0;
  virtual void run(SimTime now) = 0;
  /// See Station::quiet_characters().
  virtual std::size_t quiet_characters() const { return 0; }
};

}  // namespace understudy::pty
