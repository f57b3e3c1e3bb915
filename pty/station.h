// What a line needs from a station: something that hears bytes, wakes up when it asked to, and may speak.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "pty/line_settings.h"

namespace understudy::pty {

/// A character on the wire: its start bit begins at `start`, its stop bit is over at `end`.
/// With `Timing::instant` both are the moment at which it arrived.
struct TimedByte {
  SimTime start{0};
  SimTime end{0};
  std::uint8_t value = 0;
  std::uint64_t number = 0;  // characters of a host are numbered as they come, from 1
};

/// Where a station puts what it says. The line takes care of the wire's time.
class Transmitter {
 public:
  /// Something said unasked.
  virtual void transmit(std::span<const std::uint8_t> bytes) = 0;
  /// An answer to what ended with the character of that number. It is for the host that sent it, and goes
  /// nowhere if that one has gone.
  virtual void answer(std::span<const std::uint8_t> bytes, std::uint64_t last_character) = 0;

 protected:
  ~Transmitter() = default;
};

class Station {
 public:
  virtual ~Station() = default;

  /// What it listens to at this moment; a host that set something else finds it deaf.
  virtual LineSettings settings() const = 0;

  /// A character from the host has begun; hear() follows when it is over. Only where characters take
  /// time. Without it a silence rule could not tell a short gap from a long one: the character that
  /// ends the gap is heard a whole character time after its start bit.
  virtual void hear_start_bit(SimTime /*at*/) {}

  /// A byte from the host has wholly arrived.
  virtual void hear(const TimedByte& byte) = 0;

  /// How many more characters it may be given at one and the same moment before due() has to be asked again:
  /// behind the last of them it may be due at that moment, before that it is not. 0: it may be due already.
  virtual std::size_t quiet_characters() const { return 0; }

  /// Another station has begun to talk: the first character of its transmission is over. Once for a
  /// transmission; its bytes are not delivered (see Line).
  virtual void hear_other_station() = 0;

  /// Nothing more has come for a while although the clock stands: what is incomplete is given up.
  virtual void hear_nothing_more() {}

  /// When run() wants to be called next; nothing if it waits for bytes only. Whatever changes it other than
  /// a call from the line must tell the line (Line::due_changed).
  virtual std::optional<SimTime> due() const = 0;

  /// Called at due() (never earlier). A frame that ended is served here, at its own time. Afterwards
  /// due() must have moved on, or the line would call again without end.
  virtual void run(SimTime now, Transmitter& out) = 0;
};

}  // namespace understudy::pty
