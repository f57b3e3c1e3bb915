// The interface of a station on a line: it receives bytes, is woken when it has asked for it, and may
// transmit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "pty/line_settings.h"

namespace understudy::pty {

/// A character on the wire: its start bit begins at `start`, its stop bit ends at `end`. With
/// `Timing::instant` both are the moment at which it arrived.
struct TimedByte {
  SimTime start{0};
  SimTime end{0};
  std::uint8_t value = 0;
  std::uint64_t number = 0;  // a host's characters are numbered from 1 in the order of arrival
};

/// Takes what a station sends. The line adds the wire's time.
class Transmitter {
 public:
  /// Sends bytes that are not an answer.
  virtual void transmit(std::span<const std::uint8_t> bytes) = 0;
  /// Sends an answer to the request whose last character has that number. Only the host that sent the
  /// request receives it; it is dropped if that host has closed the line.
  virtual void answer(std::span<const std::uint8_t> bytes, std::uint64_t last_character) = 0;
  /// Reports to observers that the station has executed or refused that request (ServedRequest).
  virtual void served(std::span<const std::uint8_t> /*request*/, std::span<const std::uint8_t> /*answer*/,
                      std::uint64_t /*last_character*/, std::string_view /*why*/) {}

 protected:
  ~Transmitter() = default;
};

class Station {
 public:
  virtual ~Station() = default;

  /// Returns the settings that the station listens to now. It does not receive from a host with other
  /// settings.
  virtual LineSettings settings() const = 0;

  /// A character from the host has started; receive() follows when it has ended. Called only if characters
  /// take time. Without it a silence rule could not distinguish a short gap from a long one: the character
  /// that ends the gap is received a whole character time after its start bit.
  virtual void on_start_bit(SimTime /*at*/) {}

  /// A character from the host has completely arrived.
  virtual void receive(const TimedByte& byte) = 0;

  /// Returns how many more characters may arrive at one moment before due() has to be asked again: the
  /// station may be due at that moment only after the last of them. 0: it may be due already.
  virtual std::size_t quiet_characters() const { return 0; }

  /// Another station has begun to transmit: its first character has ended. Called once for a transmission;
  /// its bytes are not delivered (see Line).
  virtual void on_other_station() = 0;

  /// The clock is stopped, and no more characters have arrived for a while: the station abandons an
  /// incomplete request.
  virtual void on_idle() {}

  /// Returns when run() wants to be called next, or nothing if the station only waits for bytes. If it
  /// changes for any reason other than a call from the line, call Line::due_changed().
  virtual std::optional<SimTime> due() const = 0;

  /// Called at due() (never earlier). The station serves a complete request here, at its own time.
  /// Afterwards due() must be later, or the line would call again without end.
  virtual void run(SimTime now, Transmitter& out) = 0;
};

}  // namespace understudy::pty
