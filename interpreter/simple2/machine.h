// The device on which a running Simple2-R3 program acts, as an abstract interface.
#pragma once

#include <cstdint>

#include "base/program_watch.h"

namespace understudy::interpreter::simple2 {

enum class Axis : std::uint8_t { a, b };

/// The values that a program can read.
class MachineView {
 public:
  virtual ~MachineView() = default;

  /// Returns DIN 0 to 10.
  virtual bool input(int din) const = 0;
  /// Returns bit 0 to 15 of STATUS, as reading the register would show it now.
  virtual bool status_bit(int bit) const = 0;
  /// Returns parameter 0 to 255; undefined parameters are 0. 32-bit values are returned unchanged, 16-bit
  /// values as unsigned numbers, except ENCx_RPM.
  virtual std::int32_t parameter(int number) const = 0;
  /// Returns true while a position move or homing is in progress: from the moment when it was accepted until
  /// it ends for any reason.
  virtual bool moving(Axis axis) const = 0;
  /// Like moving(), for Wait_Move_*: the machine decides whether homing counts as a move.
  virtual bool moving_for_wait(Axis axis) const { return moving(axis); }
  /// Returns true if the last accepted position move or homing ended early.
  virtual bool cut_short(Axis) const { return false; }
};

/// The actions of a program. Each action is already in effect for the next line. All arguments except
/// parameter numbers are within the ranges that the comments state.
class Machine : public MachineView, public Watched {
 public:
  /// Sets DOUT n to the level of bit n, for each bit 0 to 6 that is set in `which`.
  virtual void set_outputs(std::uint8_t which, std::uint8_t levels) = 0;
  /// Writes a parameter as a host would, including persistence. A value outside the parameter's range is
  /// brought into the range or, by choice, ignored. Writes to undefined or read-only parameters have no
  /// effect.
  virtual void set_parameter(int number, std::int32_t value) = 0;
  /// Starts or stops timer 1 or 2; its value is a parameter.
  virtual void run_timer(int timer, bool run) = 0;

  virtual void move_incremental(Axis axis, std::int32_t pulses) = 0;
  virtual void move_absolute(Axis axis, std::int32_t pulses) = 0;
  virtual void go_home(Axis axis) = 0;
  /// Sets the speed of position moves, 0 to 32768 RPM, from the next move on or, by choice, immediately.
  virtual void set_speed(Axis axis, std::int32_t rpm) = 0;
  /// Sets the ramps of position moves; they take effect as in set_speed(). Times are 0 to 3000, in units of
  /// 10 ms.
  virtual void set_ramps(Axis axis, std::int32_t acceleration_10ms, std::int32_t deceleration_10ms) = 0;
  virtual void stop(Axis axis) = 0;
  virtual void switch_servo(Axis axis, bool on) = 0;

  virtual void run_velocity(Axis axis, std::int32_t milli_rpm) = 0;
  /// `percent` is 0 to 100.
  virtual void output_pwm(Axis axis, std::int32_t percent) = 0;
  virtual void follow_encoder(Axis axis) = 0;
};

/// Parameters that instructions use implicitly.
inline constexpr int kCordA = 154;
inline constexpr int kCordB = 155;
inline constexpr int kCalcRegister = 158;
inline constexpr int kCounter1 = 171;
inline constexpr int kTimer1 = 173;

}  // namespace understudy::interpreter::simple2
