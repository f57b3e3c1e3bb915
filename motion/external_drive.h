// External pulse drive: two inputs that make an axis move, as with EXP+ and EXP- of the MCX314.
//
// Levels are those at the pin: true is high. Source: RS-M8194H manual 3.17.
#pragma once

#include <cstdint>

namespace understudy::motion {

struct ExternalDrive {
  enum class Mode : std::uint8_t {
    off,
    multiply,  // EXP- low: a rising edge of EXP+ sends `pulses` forwards, a falling edge as many backwards
    fixed,  // a falling edge of EXP+ or EXP- sends `pulses` forwards or backwards, unless some are being sent
    continuous,  // moves forwards while EXP+ is low, backwards while EXP- is low; stops when it goes high
                 // again
  };

  Mode mode = Mode::off;
  std::int64_t pulses = 0;
  // State: the levels last seen, and the direction of the continuous run in progress (0: none).
  bool plus_high = true;
  bool minus_high = true;
  std::int8_t running = 0;

  bool operator==(const ExternalDrive&) const = default;
};

/// A request from an input to its axis.
struct DriveOrder {
  enum class What : std::uint8_t { nothing, move, run, slow_down };
  What what = What::nothing;
  std::int64_t pulses = 0;    // the distance of a move, signed
  std::int8_t direction = 0;  // the direction of a run

  bool operator==(const DriveOrder&) const = default;
};

/// Returns the order that follows from the present inputs. Call this once per tick.
DriveOrder watch_inputs(ExternalDrive& drive, bool plus_high, bool minus_high, bool axis_moving);

}  // namespace understudy::motion
