// Commands to an axis: moves, homing, modes, servo and STOP. Registers and program lines use them.
// commands.cpp and transitions.h define when a command is dropped, and how it affects the previous command.
#pragma once

#include <cstdint>

#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/reactions.h"
#include "emulator/models/simple2_r3/state.h"
#include "emulator/models/simple2_r3/transitions.h"

namespace understudy::emulator::models::simple2_r3 {

class AxisCommands : public AxisReactions {
 public:
  using AxisReactions::AxisReactions;

  /// Starts a move (appendix A). The move is dropped while the servo is off, an alarm is active or a limit
  /// blocks its direction.
  void start_move(Command command, const MoveParameters& move);
  /// Starts homing with the axis's Home_Speed, Home_AccTime and GoHome_DIR. Homing is dropped for the same
  /// reasons as moves.
  void go_home(bool by_trigger = false);
  /// These start the other modes. transitions.h defines the effect of each command on the present motion.
  void run_velocity(std::int64_t milli_rpm);
  void output_pwm(std::uint8_t percent);
  void follow_encoder();
  void switch_servo(bool on);
  void clear_alarm();
  /// Applies a write to EncSync, SyncRPM or SyncSlope of the axis.
  void sync_changed();
  /// Applies a write to Speed, AccTime, DecTime or Resoultion of the axis.
  void speed_changed();
  void preset_coordinate(std::int32_t pulses);
  void set_encoder(std::int64_t counts) { count_encoder(axis(), counts, encoder_reversed()); }
  /// These show in DirectmRPM or DirectPWM a command that did not come from a write to that register.
  void show_velocity(std::int32_t milli_rpm);
  void show_pwm(std::uint8_t percent);

 private:
  /// Returns true if a command can begin; otherwise, performs the action for its outcome.
  bool may_begin(Outcome outcome, const KeptCommand& what);
  void carry_out_kept();
  /// Called when a motion has begun.
  void leave_home() {
    if (chose(option("home_bit", "any_motion"))) axis().homed = false;
  }
  /// Returns true if the register does not store the value of a command with that outcome.
  bool is_forgotten(Outcome outcome) const {
    return outcome != Outcome::kept && chose(option("dropped_value", "forgotten"));
  }
  bool shows_command_values() const { return !chose(option("command_values", "not_shown")); }
};

}  // namespace understudy::emulator::models::simple2_r3
