// What a Simple2-R3 needs in addition to its state: its device, which provides time, inputs and choices, and
// everything that follows from firmware and choices, computed once. All parts of the controller are functions
// on a State and a Setup:
//
//   setup.h, state.h    choices, terminals, time; the state
//   signals.h           inputs, outputs and the functions that registers assign to them; STATUS
//   axis_view.h         an axis with its registers and choices
//   reactions.h         the tick of an axis, and what stops it
//   commands.h          commands to an axis
//   program_machine.h   the controller as its program sees it
//   programs.h          the program
//   memory.h            the persistent memory, and the password
//   power.h             power-up, power-down, factory reset, erasure
//   effects.h           the values and effects of registers
//
// Each part may use the parts above it. device.h combines them into a device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/reasons.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/terminals.h"
#include "interpreter/simple2/dialect.h"
#include "motion/environment.h"

namespace understudy::emulator::models::simple2_r3 {

struct alignas(64) Setup {
  explicit Setup(const Device& of);

  // The members that ticks use, on one cache line.
  const Device& device;
  const interpreter::simple2::Dialect dialect;
  const bool assigned_at_power_up;
  const bool adc_10_bits;
  const bool motion_first;
  const bool limits_physical;
  const bool alarm_latches;
  const bool alarm_takes_servo;
  const bool coordinate_saturates;
  const bool velocity_pulses_first;
  const bool velocity_settings_latched;
  const bool stops_with_encoder;
  const bool sync_follows_other;
  /// True if the coordinate counts in the motor's direction, as it did up to 1.40 (firmware note "1.40
  /// 以前").
  const bool quirk_coordinate_counts_physical_sense;
  const bool timers_stay;
  const std::uint32_t velocity_unit_urpm;  // unit of VelMode_ACC, per 0.5 ms
  const Tick timer_unit;

  const Tick boot_ticks;

  /// Receives why commands had no effect. It is not state.
  mutable Reasons reasons{};

  bool chose(const Option& option) const { return device.chose(option); }
  Tick now() const { return device.now(); }
  /// Returns the time in the unit of the timers.
  Tick timer_time() const { return now() / timer_unit; }
  /// Returns the tick that counts as the last one before a motion that is commanded now.
  Tick tick_before_motion() const { return chose(option("move_begins", "one_tick_in")) ? now() - 1 : now(); }
  /// Returns true if a choice makes this signal (a limit or the alarm) not stop an axis.
  bool ignores(motion::Signal signal) const {
    return chose(signal == motion::Signal::alarm ? option("alarm_reaction", "none")
                                                 : option("limit_reaction", "none"));
  }
  bool keeps(const RegisterRow& row) const {
    // The manual does not mark NEW_PWD with a star (persistent).
    return row.persistent || (chose(option("password_kept", "yes")) && row.name == "NEW_PWD");
  }

  // ---- The present levels at the terminals: bit n for DIN n, and for DIP n + 1
  std::uint16_t input_levels() const;
  std::uint8_t switch_levels() const;
  std::uint16_t adc(int number) const;
};

/// Returns "choice ready_gates = yes", with the option that is in effect, for texts.
std::string choice_words(const Setup& setup, std::size_t choice);

/// Returns the map's policy under the choices of a device.
MapPolicy map_policy_of(const Setup& setup);

}  // namespace understudy::emulator::models::simple2_r3
