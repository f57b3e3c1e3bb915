// A module's four outputs, with levels, single pulses and pulse width modulation.
#pragma once

#include <cstdint>

#include "base/simulated_time.h"

namespace understudy::emulator::models::slim {

/// The unit of PLS's width.
inline constexpr Tick kPulseUnit = 4;

/// One output, P1 .. P4.
struct Output {
  enum class Mode : std::uint8_t {
    level,
    pulse,  // on from `since` until `since` + `width`, then off
    pwm,    // on for the first `duty_percent` of each period, beginning at `since`
  };
  Mode mode = Mode::level;
  bool on = false;  // in mode `level`, the level; in the other modes, the level before `since`
  Tick since = 0;
  Tick width = 0;  // the width of a single pulse
  double frequency_hz = 0;
  double duty_percent = 0;

  bool operator==(const Output&) const = default;

  /// Returns the level at a tick. If the frequency is too high for ticks (above 500 Hz), it is the level that
  /// prevails.
  bool level_at(Tick tick) const;
  /// Returns the first tick after `done` in which the level may change without a command, or kNever.
  Tick next_change(Tick done) const;
};

/// A command for outputs.
struct OutputOrder {
  enum class Kind : std::uint8_t { set, clear, toggle, pulse, pwm, all, arm };
  Kind kind = Kind::set;
  std::uint8_t output = 0;   // the output; 0 is P1
  std::uint8_t mask = 0;     // for `all`: bit 0 is P1
  std::uint8_t trigger = 0;  // for `arm`: the trigger, 0 or 1
  bool trigger_sets = false;
  Tick width = 0;
  double frequency_hz = 0;
  double duty_percent = 0;
  double at_units = 0;  // for `arm`: the coordinate

  bool operator==(const OutputOrder&) const = default;
};

/// P1SET, P1CLR (trigger 0), P2SET, P2CLR (trigger 1): triggers when the coordinate is reached from either
/// side.
struct PositionTrigger {
  bool armed = false;
  bool sets = false;
  std::uint8_t output = 0;
  double at_units = 0;

  bool operator==(const PositionTrigger&) const = default;
};

/// Executes all kinds except `arm`. Pulses and PWM begin in tick `begin_at`, so they last whole ticks.
void carry_out(Output& output, const OutputOrder& order, Tick begin_at);

}  // namespace understudy::emulator::models::slim
