// Simple2-R3 as its program sees it: implements the abstract machine of interpreter/simple2/ with a state and
// a setup.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/device/register_map/register_bank.h"
#include "emulator/models/simple2_r3/commands.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/state.h"
#include "interpreter/simple2/machine.h"

namespace understudy::emulator::models::simple2_r3 {

/// The part of the machine that a program can read. `Seen` is the whole abstract machine or its read-only
/// part.
template <class Seen, class StateSeen, class Bank>
class ProgramStateView : public Seen {
 public:
  using Axis = interpreter::simple2::Axis;

  ProgramStateView(StateSeen& state, const Setup& setup, Bank& bank)
      : state_(state), setup_(setup), bank_(bank) {}

  bool input(int din) const final;
  bool status_bit(int bit) const final;
  std::int32_t parameter(int number) const final;
  bool moving(Axis axis) const final;
  bool moving_for_wait(Axis axis) const final;
  bool cut_short(Axis axis) const final;

 protected:
  static std::size_t number_of(Axis axis) { return axis == Axis::a ? 0 : 1; }

  StateSeen& state_;
  const Setup& setup_;
  Bank& bank_;
};

extern template class ProgramStateView<interpreter::simple2::MachineView, const State, const RegisterBank>;
extern template class ProgramStateView<interpreter::simple2::Machine, State, RegisterBank>;

using ProgramView = ProgramStateView<interpreter::simple2::MachineView, const State, const RegisterBank>;

class ProgramMachine final : public ProgramStateView<interpreter::simple2::Machine, State, RegisterBank> {
 public:
  using ProgramStateView::ProgramStateView;

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

 private:
  AxisCommands commands(Axis axis) { return {state_, setup_, static_cast<int>(number_of(axis))}; }
  /// Returns true if a program's speed and times are separate from those in the axis's registers.
  bool has_speed_of_its_own() const { return setup_.chose(option("program_speed", "of_its_own")); }
  MoveParameters parameters_for(std::size_t axis, std::int64_t distance_pulses) const;
  void show_pulse(std::size_t axis, std::int32_t pulses);
};

}  // namespace understudy::emulator::models::simple2_r3
