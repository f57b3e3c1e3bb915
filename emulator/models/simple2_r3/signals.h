// The terminals as the firmware sees them: their levels, the functions that registers assign to them, and
// STATUS.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/state.h"
#include "motion/environment.h"

namespace understudy::emulator::models::simple2_r3 {

class Signals {
 public:
  Signals(const State& state, const Setup& setup) : state_(state), setup_(setup) {}

  /// Returns DIN 0 to 10 as sampled in the last tick. Before the first tick after power-up, returns the
  /// present levels.
  std::uint16_t inputs() const { return is_just_up() ? setup_.input_levels() : state_.inputs; }
  bool input(int number) const { return ((inputs() >> number) & 1) != 0; }
  std::uint16_t adc(int number) const {
    return is_just_up() ? setup_.adc(number) : state_.adc[static_cast<std::size_t>(number)];
  }
  /// Returns a DIP switch; DIP1 is number 0.
  bool dip_switch(int number) const;
  /// Returns true if the levels have changed since they were sampled.
  bool have_changed() const;

  /// Returns true if the register at `assignment_slot` (0x0A00 to 0x0A0D) assigns a function to its pin.
  bool assigned(std::size_t assignment_slot) const;
  bool alarm(int axis) const;
  bool ready(int axis) const;
  bool upper_limit(int axis) const;
  bool lower_limit(int axis) const;
  bool alarm_clear(int axis) const {
    return setup_.now() < state_.axes[static_cast<std::size_t>(axis)].alarm_clear_until;
  }
  motion::Signals of_motor(int axis) const;
  /// Returns the actual level at DOUT `number`, including special functions.
  bool output(int number) const;
  Value status() const;

 private:
  /// Returns true if no tick has run since power-up.
  bool is_just_up() const { return setup_.now() + 1 + setup_.boot_ticks == state_.first_tick; }
  /// Returns the level of an input if the register at `assignment_slot` assigns the special function to it,
  /// otherwise false.
  bool assigned_input(std::size_t assignment_slot, int number) const {
    return assigned(assignment_slot) && input(number);
  }
  bool shown(bool by_function, std::size_t assignment_slot, int number) const;

  const State& state_;
  const Setup& setup_;
};

void sample_inputs(State& state, const Setup& setup);
/// Sets DOUT n to the level of bit n, for each bit n that is set in `which`.
void write_outputs(State& state, const Setup& setup, std::uint8_t which, std::uint8_t levels);

}  // namespace understudy::emulator::models::simple2_r3
