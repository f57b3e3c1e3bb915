// The fields of a Simple2-R3's state (base/state/fields.h), in the order of the bytes.
#pragma once

#include <string>

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "emulator/device/memory/eeprom_fields.h"
#include "emulator/models/simple2_r3/device.h"
#include "interpreter/simple2/execution/state_fields.h"
#include "motion/state_fields.h"

namespace understudy {

namespace emulator::models::simple2_r3 {
/// Returns the name of the register at a slot of the image: "Aaxis_Speed", or "Program+17" for one of
/// several.
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
  static constexpr auto fields = FieldList{field("value", &Value::value), field("since", &Value::since),
                                           field("running", &Value::running)};
  static void check(const Value& timer) { require_reach(timer.since); }
};

template <>
struct StateOf<emulator::models::simple2_r3::AxisState> {
  using Value = emulator::models::simple2_r3::AxisState;
  static constexpr auto fields = FieldList{field("motor", &Value::motor),
                                           field("signals", &Value::signals),
                                           field("mode", &Value::mode),
                                           field("command", &Value::command),
                                           field("homed", &Value::homed),
                                           field("has_own_speed", &Value::has_own_speed),
                                           field("by_trigger", &Value::by_trigger),
                                           field("cut_short", &Value::cut_short),
                                           field("alarm_latched", &Value::alarm_latched),
                                           field("coordinate_pulses", &Value::coordinate_pulses),
                                           field("pulses_this_tick", &Value::pulses_this_tick),
                                           field("alarm_clear_until", &Value::alarm_clear_until),
                                           field("target_urpm", &Value::target_urpm),
                                           field("speed_urpm", &Value::speed_urpm),
                                           field("velocity_resolution", &Value::velocity_resolution),
                                           field("velocity_step_urpm", &Value::velocity_step_urpm),
                                           field("velocity_phase", &Value::velocity_phase),
                                           field("pwm_percent", &Value::pwm_percent),
                                           field("encoder_raw", &Value::encoder_raw),
                                           field("encoder_counts", &Value::encoder_counts),
                                           field("encoder_preset", &Value::encoder_preset),
                                           field("encoder_followed", &Value::encoder_followed),
                                           field("encoder_history", &Value::encoder_history),
                                           field("encoder_changed", &Value::encoder_changed)};
  static void check(const Value& axis);
};

template <>
struct StateOf<emulator::models::simple2_r3::ProgramSpeed> {
  using Value = emulator::models::simple2_r3::ProgramSpeed;
  static constexpr auto fields =
      FieldList{field("speed_rpm", &Value::speed_rpm), field("acceleration_10ms", &Value::acceleration_10ms),
                field("deceleration_10ms", &Value::deceleration_10ms)};
};

template <>
struct StateOf<emulator::models::simple2_r3::MoveParameters> {
  using Value = emulator::models::simple2_r3::MoveParameters;
  static constexpr auto fields = FieldList{field("distance_pulses", &Value::distance_pulses),
                                           field("speed_rpm", &Value::speed_rpm),
                                           field("acceleration_10ms", &Value::acceleration_10ms),
                                           field("deceleration_10ms", &Value::deceleration_10ms),
                                           field("of_the_axis", &Value::of_the_axis),
                                           field("by_trigger", &Value::by_trigger)};
};

template <>
struct StateOf<emulator::models::simple2_r3::KeptCommand> {
  using Value = emulator::models::simple2_r3::KeptCommand;
  static constexpr auto fields = FieldList{field("mode", &Value::mode), field("command", &Value::command),
                                           field("move", &Value::move), field("value", &Value::value)};
  static void check(const Value& kept);
};

template <>
struct StateOf<emulator::models::simple2_r3::State> {
  using Value = emulator::models::simple2_r3::State;
  static constexpr auto fields =
      FieldList{field("image", &Value::image, emulator::models::simple2_r3::register_at_slot),
                field("axes", &Value::axes),
                field("program", &Value::program),
                field("execution", &Value::execution),
                field("timers", &Value::timers),
                field("eeprom", &Value::eeprom),
                field("first_tick", &Value::first_tick),
                field("switches", &Value::switches),
                field("unlocked", &Value::unlocked),
                field("password", &Value::password),
                field("adc", &Value::adc),
                field("inputs", &Value::inputs),
                field("written_outputs", &Value::written_outputs),
                field("assignments", &Value::assignments),
                field("program_speeds", &Value::program_speeds),
                field("kept", &Value::kept),
                field("touched", &Value::touched)};
  static void check(const Value& state);
};

}  // namespace understudy
