// What the manual leaves open about modules and their motion, and what to do instead.
#pragma once

#include <cstdint>

namespace understudy::emulator::models::slim {

struct ChainOptions {
  /// PR2 or PR3 differ between the modules of a coordinated command.
  enum class UnequalSpeeds : std::uint8_t { refused, by_module_0 };
  /// TAREDO, TAUPZ, REDO that have nothing to do.
  enum class InVain : std::uint8_t { silent, refused };
  /// FT without a load that anything says more of.
  enum class Thrust : std::uint8_t {
    stands,      // pushes against something
    runs_at_vj,  // forwards, until it is stopped
  };
  /// VM= and VJ= while a motion runs that they are the speed of. (AVM acts at once in any case.)
  enum class NewSpeed : std::uint8_t { next_motion, at_once };
  /// PR3= of a module that is on a path.
  enum class PathSpeedInMotion : std::uint8_t {
    whole_path,  // the path goes at it, whichever of its modules is told
    by_x,        // ... if X is
    next_command
  };
  /// The fz of SAR, where the manual breaks off.
  enum class SarHeight : std::uint8_t { relative, absolute };

  // Ours is false.
  bool coordinate_at_rest_only = false;  // CS is refused while its module has anything to do
  bool reset_clears_coordinate = false;  // RESET
  bool first_bit_is_p4 = false;          // OUTP
  bool triggers_stay_armed = false;      // P1SET ... act each time
  bool pause_is_of_module_0 = false;     // PZ, REDO, CLR BUF: and of what is coordinated with it
  bool one_pause = false;                // PZ is TAPZ, and REDO and CLR BUF end it as TAREDO and TAUPZ do
  bool reset_ends_pause = false;         // RESET of T0, with all that it holds
  bool stops_end_outputs = false;        // TASTOP and RESET: of PLS, PWM and P1SET
  bool jog_ends_move = false;            // a jog or thrust gives up what its module has to do
  bool spiral_growth_in_all = false;     // SPI's L is of the whole sweep, not of a turn
  bool emergency_switches_servo_off = false;  // TASTOP
  bool acceleration_of_next_command = false;  // TVA= in motion; what is issued already keeps its own
  bool second_decides_joint = false;          // CM of the command before it does not matter
  bool late_successor_speeds_up = false;      // goes on from the speed that is left
  bool path_needs_length = false;             // a path of length 0 is out of range
  bool ramps_by_path_acceleration = false;    // PR2 instead of VA for moves of one axis and jogs
  bool homes_forwards = false;                // H
  bool analog_speed_jogs = false;             // AVM begins a jog
  bool only_moves_reserved = false;           // jogs, homing and thrust by number go with a letter, too

  bool arcs_by_radius = false;               // AA: end point and radius, not centre and angle
  bool spiral_to_radius = false;             // SPI's R is the radius at its end, not a sweep
  bool spiral_centre_relative = false;       // SPI's X, Y
  bool lines_of_two_have_own_speed = false;  // PR4 instead of PR3
  bool clear_keeps_half_done = false;        // CLR BUF in a pause, as out of one
  bool analog_leaves_jogs = false;           // AVM is of VM alone
  bool motion_ends_thrust = false;           // a move given behind FT
  bool done_waits_for_all = false;           // DN: for jogs, thrust and pulses of outputs, too

  UnequalSpeeds unequal_speeds = UnequalSpeeds::refused;
  InVain in_vain = InVain::silent;
  Thrust thrust = Thrust::stands;
  NewSpeed new_speed = NewSpeed::next_motion;
  PathSpeedInMotion path_speed_in_motion = PathSpeedInMotion::whole_path;
  SarHeight sar_height = SarHeight::relative;
  bool servo_at_power_up = true;
  std::uint8_t fifo_length = 32;  // 1 .. kFifoLength

  bool operator==(const ChainOptions&) const = default;
};

}  // namespace understudy::emulator::models::slim
