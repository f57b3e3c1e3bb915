// Simple2-R3 as its program sees it: the abstract machine of interpreter/simple2/, implemented by the device.
#pragma once

#include "emulator/models/simple2_r3/device.h"
#include "interpreter/simple2/dialect.h"
#include "interpreter/simple2/machine.h"

namespace understudy::emulator::models::simple2_r3 {

/// The part of the machine that a program reads. `Seen` is the whole abstract machine, or its read-only part.
template <class Seen, class Of>
class ProgramSight : public Seen {
 public:
  using Axis = interpreter::simple2::Axis;

  explicit ProgramSight(Of& device) : device_(device) {}

  bool input(int din) const final;
  bool status_bit(int bit) const final;
  std::int32_t parameter(int number) const final;
  bool moving(Axis axis) const final;
  bool moving_for_wait(Axis axis) const final;
  bool cut_short(Axis axis) const final;

 protected:
  Of& device_;
};

extern template class ProgramSight<interpreter::simple2::MachineView, const Simple2R3>;
extern template class ProgramSight<interpreter::simple2::Machine, Simple2R3>;

using ProgramView = ProgramSight<interpreter::simple2::MachineView, const Simple2R3>;

class ProgramMachine final : public ProgramSight<interpreter::simple2::Machine, Simple2R3> {
 public:
  using ProgramSight::ProgramSight;

  void set_outputs(std::uint8_t which, std::uint8_t levels) override;
  void set_parameter(int number, std::int32_t value) override;
  void run_timer(int timer, bool run) override;
  void move_incremental(Axis axis, std::int32_t pulses) override;
  void move_absolute(Axis axis, std::int32_t pulses) override;
  void go_home(Axis axis) override;
  void set_speed(Axis axis, std::int32_t rpm) override;
  void set_ramps(Axis axis, std::int32_t acceleration_10ms, std::int32_t deceleration_10ms) override;
  void stop(Axis axis) override;
  void switch_servo(Axis axis, bool on) override;
  void run_velocity(Axis axis, std::int32_t milli_rpm) override;
  void output_pwm(Axis axis, std::int32_t percent) override;
  void follow_encoder(Axis axis) override;
};

/// Returns the language of the device's firmware, with the device's choices.
interpreter::simple2::Dialect dialect_of(const Simple2R3& device);

}  // namespace understudy::emulator::models::simple2_r3
