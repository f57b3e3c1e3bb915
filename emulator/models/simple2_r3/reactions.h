// The tick of an axis, and what stops it: STOP and SVOFF, limits and alarms. For position moves and homing,
// motion/ handles these according to AxisSettings and the homing table; for the other modes, the table in
// transitions.h decides.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_view.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/state.h"
#include "emulator/models/simple2_r3/transitions.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::simple2_r3 {

/// The ways to stop an axis. Instructions and SVOFF stop it forcibly.
enum class Stopping : std::uint8_t { forcibly, by_register };

class AxisReactions : public AxisView {
 public:
  AxisReactions(State& state, const Setup& setup, int number)
      : AxisView(state, setup, number), state_(state) {}

  /// Sets the motor's settings and servo state at power-up.
  void power_up();
  void stop(Stopping how = Stopping::forcibly);
  void servo_off();
  /// Checks the limits and the alarm at the beginning of a tick.
  void sample_signals();

 protected:
  AxisState& axis() { return state_.axes[index()]; }
  std::uint32_t& shared(std::size_t slot) { return state_.image[slot]; }
  KeptCommand& kept() { return state_.kept[index()]; }

  /// Updates the motor's signals before a command that they may forbid.
  void refresh_signals();
  void forget_kept();
  void begin_following();

 private:
  /// Checks again whether SVOFF forbids pulses.
  void apply_servo_state();
  /// Sets the limits and the alarm of the axis, and handles the changes.
  void apply_signals(motion::Signals on);
  void note_for_motor(motion::Signals changed, motion::Signals on) const;
  void handle_in_sync(Outcome outcome);

  State& state_;
};

/// Runs one tick of an axis. A separate call would take an additional tenth of a tick's time.
[[gnu::always_inline]] inline void step_axis(State& state, const Setup& setup, int number, Tick tick) {
  if (state.touched || setup.alarm_latches || setup.alarm_takes_servo) {
    AxisReactions(state, setup, number).sample_signals();
  }
  AxisState& axis = state.axes[static_cast<std::size_t>(number)];
  const AxisView view(state, setup, number);
  const std::int64_t commanded = step_drive(axis, view.drive_settings(), tick);
  axis.pulses_this_tick = view.sent(commanded);
  axis.coordinate_pulses = view.coordinate_after(commanded);
  const bool home_found = (axis.motor.events & motion::bit(motion::Event::homed)) != 0;
  if (home_found && !setup.chose(option("home_coordinate", "kept"))) axis.coordinate_pulses = 0;
}

}  // namespace understudy::emulator::models::simple2_r3
