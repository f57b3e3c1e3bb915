// The fields of a Simple2-R3's state (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include <string>

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "emulator/device/memory/eeprom_fields.h"
#include "emulator/models/simple2_r3/state.h"
#include "interpreter/simple2/execution/state_fields.h"
#include "motion/state_fields.h"

namespace understudy {

namespace emulator::models::simple2_r3 {
/// Returns the name of the register at an image slot: "Aaxis_Speed", or "Program+17" for one of several
/// registers.
std::string register_at_slot(std::size_t slot);
}  // namespace emulator::models::simple2_r3

template <>
struct StateOf<emulator::models::simple2_r3::Mode> {
  static constexpr auto last = emulator::models::simple2_r3::Mode::sync;
};

template <>
struct StateOf<emulator::models::simple2_r3::Command> {
  static constexpr auto last = emulator::models::simple2_r3::Command::homing;
};

template <>
struct StateOf<emulator::models::simple2_r3::Timer> {
  using Value = emulator::models::simple2_r3::Timer;
  static constexpr auto fields =
      FieldList{field<&Value::value>(), field<&Value::since>(), field<&Value::running>()};
  static void check(const Value& timer) { require_reach(timer.since); }
};

template <>
struct StateOf<emulator::models::simple2_r3::AxisState> {
  using Value = emulator::models::simple2_r3::AxisState;
  static constexpr auto fields = FieldList{field<&Value::motor>(),
                                           field<&Value::signals>(),
                                           field<&Value::mode>(),
                                           field<&Value::command>(),
                                           field<&Value::homed>(),
                                           field<&Value::has_own_speed>(),
                                           field<&Value::by_trigger>(),
                                           field<&Value::cut_short>(),
                                           field<&Value::alarm_latched>(),
                                           field<&Value::coordinate_pulses>(),
                                           field<&Value::pulses_this_tick>(),
                                           field<&Value::alarm_clear_until>(),
                                           field<&Value::target_urpm>(),
                                           field<&Value::speed_urpm>(),
                                           field<&Value::velocity_resolution>(),
                                           field<&Value::velocity_step_urpm>(),
                                           field<&Value::velocity_phase>(),
                                           field<&Value::pwm_percent>(),
                                           field<&Value::encoder_raw>(),
                                           field<&Value::encoder_counts>(),
                                           field<&Value::encoder_preset>(),
                                           field<&Value::encoder_followed>(),
                                           field<&Value::encoder_history>(),
                                           field<&Value::encoder_changed>()};
  static void check(const Value& axis);
};

template <>
struct StateOf<emulator::models::simple2_r3::ProgramSpeed> {
  using Value = emulator::models::simple2_r3::ProgramSpeed;
  static constexpr auto fields = FieldList{field<&Value::speed_rpm>(), field<&Value::acceleration_10ms>(),
                                           field<&Value::deceleration_10ms>()};
};

template <>
struct StateOf<emulator::models::simple2_r3::MoveParameters> {
  using Value = emulator::models::simple2_r3::MoveParameters;
  static constexpr auto fields = FieldList{
      field<&Value::distance_pulses>(),   field<&Value::speed_rpm>(),   field<&Value::acceleration_10ms>(),
      field<&Value::deceleration_10ms>(), field<&Value::of_the_axis>(), field<&Value::by_trigger>()};
};

template <>
struct StateOf<emulator::models::simple2_r3::KeptCommand> {
  using Value = emulator::models::simple2_r3::KeptCommand;
  static constexpr auto fields = FieldList{field<&Value::mode>(), field<&Value::command>(),
                                           field<&Value::move>(), field<&Value::value>()};
  static void check(const Value& kept);
};

template <>
struct StateOf<emulator::models::simple2_r3::State> {
  using Value = emulator::models::simple2_r3::State;
  static constexpr auto fields =
      FieldList{field<&Value::image>(emulator::models::simple2_r3::register_at_slot),
                field<&Value::axes>(),
                field<&Value::program>(),
                field<&Value::execution>(),
                field<&Value::timers>(),
                field<&Value::eeprom>(),
                field<&Value::first_tick>(),
                field<&Value::switches>(),
                field<&Value::unlocked>(),
                field<&Value::password>(),
                field<&Value::adc>(),
                field<&Value::inputs>(),
                field<&Value::written_outputs>(),
                field<&Value::assignments>(),
                field<&Value::program_speeds>(),
                field<&Value::kept>(),
                field<&Value::touched>()};
  static void check(const Value& state);
};

}  // namespace understudy
