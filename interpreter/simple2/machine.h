// What a running Simple2-R3 program acts on: the device, as an abstract machine.
#pragma once

#include <cstdint>

namespace understudy::interpreter::simple2 {

enum class Axis : std::uint8_t { a, b };

/// What a program can look at.
class MachineView {
 public:
  virtual ~MachineView() = default;

  /// DIN 0 to 10.
  virtual bool input(int din) const = 0;
  /// Bit 0 to 15 of STATUS, as a register read would show it now.
  virtual bool status_bit(int bit) const = 0;
  /// 0 to 255; an undefined one reads 0. 32 bits as they are; 16 bits without a sign, except ENCx_RPM.
  virtual std::int32_t parameter(int number) const = 0;
  /// Whether a position move or homing goes on, from the moment it was accepted until it ended for any
  /// reason.
  virtual bool moving(Axis axis) const = 0;
  /// The same as Wait_Move_* asks for it: whether homing is a move to it is the machine's business.
  virtual bool moving_for_wait(Axis axis) const { return moving(axis); }
  /// Whether the last position move or homing that was accepted has ended before its end.
  virtual bool cut_short(Axis) const { return false; }
};

/// What a line starts is there for the next line at once. Only parameter numbers come unchecked: all others,
/// and the values of the calls, are within what their comments say.
class Machine : public MachineView {
 public:
  /// For each bit 0 to 6 that is set in `which`: DOUT n takes the level of bit n.
  virtual void set_outputs(std::uint8_t which, std::uint8_t levels) = 0;
  /// As a write from outside would, persistence included. A value that a parameter cannot hold is brought to
  /// the nearest end of its range; an undefined parameter or one that can only be read takes nothing.
  virtual void set_parameter(int number, std::int32_t value) = 0;
  /// Timer 1 or 2; its value is a parameter.
  virtual void run_timer(int timer, bool run) = 0;

  virtual void move_incremental(Axis axis, std::int32_t pulses) = 0;
  virtual void move_absolute(Axis axis, std::int32_t pulses) = 0;
  virtual void go_home(Axis axis) = 0;
  /// For the next position move: 0 to 32768 RPM.
  virtual void set_speed(Axis axis, std::int32_t rpm) = 0;
  /// For the next position move: 0 to 3000, in 10 ms.
  virtual void set_ramps(Axis axis, std::int32_t acceleration_10ms, std::int32_t deceleration_10ms) = 0;
  virtual void stop(Axis axis) = 0;
  virtual void switch_servo(Axis axis, bool on) = 0;

  virtual void run_velocity(Axis axis, std::int32_t milli_rpm) = 0;
  /// 0 to 100.
  virtual void output_pwm(Axis axis, std::int32_t percent) = 0;
  virtual void follow_encoder(Axis axis) = 0;
};

/// Parameters that instructions reach without naming them.
inline constexpr int kCordA = 154;
inline constexpr int kCordB = 155;
inline constexpr int kCalcRegister = 158;
inline constexpr int kCounter1 = 171;
inline constexpr int kTimer1 = 173;

}  // namespace understudy::interpreter::simple2
