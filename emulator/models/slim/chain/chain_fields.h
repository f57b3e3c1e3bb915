// The fields of a chain's state (base/state/fields.h), in the order of the bytes.
#pragma once

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "emulator/models/slim/chain/chain.h"
#include "interpreter/slim/state_fields.h"
#include "motion/state_fields.h"

namespace understudy {

template <>
struct StateOf<emulator::models::slim::SpeedUnit> {
  static constexpr auto last = emulator::models::slim::SpeedUnit::rps;
};

template <>
struct StateOf<emulator::models::slim::Output::Mode> {
  static constexpr auto last = emulator::models::slim::Output::Mode::pwm;
};

template <>
struct StateOf<emulator::models::slim::OutputOrder::Kind> {
  static constexpr auto last = emulator::models::slim::OutputOrder::Kind::arm;
};

template <>
struct StateOf<emulator::models::slim::Job::Kind> {
  static constexpr auto last = emulator::models::slim::Job::Kind::output;
};

template <>
struct StateOf<emulator::models::slim::ContinuousPath> {
  static constexpr auto last = emulator::models::slim::ContinuousPath::by_angle;
};

template <>
struct StateOf<emulator::models::slim::Activity> {
  static constexpr auto last = emulator::models::slim::Activity::stopping;
};

template <>
struct StateOf<emulator::models::slim::ModuleSettings> {
  using Value = emulator::models::slim::ModuleSettings;
  static constexpr auto fields =
      FieldList{field("scale", &Value::scale),
                field("pulses_per_revolution", &Value::pulses_per_revolution),
                field("speed_unit", &Value::speed_unit),
                field("working_speed", &Value::working_speed),
                field("jog_speed", &Value::jog_speed),
                field("acceleration", &Value::acceleration),
                field("path_acceleration_units_s2", &Value::path_acceleration_units_s2),
                field("path_speed_units_s", &Value::path_speed_units_s),
                field("smooth_corner_deg", &Value::smooth_corner_deg),
                field("line_speed_units_s", &Value::line_speed_units_s)};
  static void check(const Value& settings);
};

template <>
struct StateOf<emulator::models::slim::Output> {
  using Value = emulator::models::slim::Output;
  static constexpr auto fields = FieldList{field("mode", &Value::mode),
                                           field("on", &Value::on),
                                           field("since", &Value::since),
                                           field("width", &Value::width),
                                           field("frequency_hz", &Value::frequency_hz),
                                           field("duty_percent", &Value::duty_percent)};
  static void check(const Value& output);
};

template <>
struct StateOf<emulator::models::slim::OutputOrder> {
  using Value = emulator::models::slim::OutputOrder;
  static constexpr auto fields = FieldList{field("kind", &Value::kind),
                                           field("output", &Value::output),
                                           field("mask", &Value::mask),
                                           field("trigger", &Value::trigger),
                                           field("trigger_sets", &Value::trigger_sets),
                                           field("width", &Value::width),
                                           field("frequency_hz", &Value::frequency_hz),
                                           field("duty_percent", &Value::duty_percent),
                                           field("at_units", &Value::at_units)};
  static void check(const Value& order);
};

template <>
struct StateOf<emulator::models::slim::PositionTrigger> {
  using Value = emulator::models::slim::PositionTrigger;
  static constexpr auto fields =
      FieldList{field("armed", &Value::armed), field("sets", &Value::sets), field("output", &Value::output),
                field("at_units", &Value::at_units)};
  static void check(const Value& trigger);
};

template <>
struct StateOf<emulator::models::slim::Job> {
  using Value = emulator::models::slim::Job;
  static constexpr auto fields =
      FieldList{field("kind", &Value::kind),
                field("number", &Value::number),
                field("module_of", &Value::module_of),
                field("units", &Value::units),
                field("absolute", &Value::absolute),
                field("height_absolute", &Value::height_absolute),
                field("sweep_deg", &Value::sweep_deg),
                field("by_radius", &Value::by_radius),
                field("growth_units_turn", &Value::growth_units_turn),
                field("ends", &Value::ends),
                field("continuous", &Value::continuous),
                field("smooth_corner_deg", &Value::smooth_corner_deg),
                field("path_acceleration_units_s2", &Value::path_acceleration_units_s2),
                field("servo_on", &Value::servo_on),
                field("begun", &Value::begun),
                field("output", &Value::output)};
  static void check(const Value& job);
};

/// Writes only the items that are in the FIFO.
template <>
struct StateOf<
    emulator::models::slim::Fifo<emulator::models::slim::Job, emulator::models::slim::kFifoLength>> {
  using Value =
      emulator::models::slim::Fifo<emulator::models::slim::Job, emulator::models::slim::kFifoLength>;
  static void write(const Value& fifo, StateWriter& writer);
  static void read(Value& fifo, StateReader& reader);
};

template <>
struct StateOf<emulator::models::slim::Module> {
  using Value = emulator::models::slim::Module;
  static constexpr auto fields = FieldList{field("settings", &Value::settings),
                                           field("linked", &Value::linked),
                                           field("homed", &Value::homed),
                                           field("activity", &Value::activity),
                                           field("jog_way", &Value::jog_direction),
                                           field("next_jog_way", &Value::next_jog_direction),
                                           field("next_thrust", &Value::next_thrust),
                                           field("held_jog_way", &Value::held_jog_direction),
                                           field("held_thrust", &Value::held_thrust),
                                           field("analog_speed", &Value::analog_speed),
                                           field("starved", &Value::starved),
                                           field("analog", &Value::analog),
                                           field("thrust", &Value::thrust),
                                           field("zero_pulses", &Value::zero_pulses),
                                           field("place_units", &Value::place_units),
                                           field("sent_pulses", &Value::sent_pulses),
                                           field("late_error", &Value::late_error),
                                           field("outputs", &Value::outputs),
                                           field("triggers", &Value::triggers),
                                           field("fifo", &Value::fifo)};
  static void check(const Value& module);
};

template <>
struct StateOf<emulator::models::slim::Group> {
  using Value = emulator::models::slim::Group;
  static constexpr auto fields =
      FieldList{field("motion", &Value::motion), field("paths", &Value::paths), field("end", &Value::end)};
  // Writes the group only if it is in use.
  static void write(const Value& group, StateWriter& writer);
  static void read(Value& group, StateReader& reader);
};

template <>
struct StateOf<emulator::models::slim::ChainState> {
  using Value = emulator::models::slim::ChainState;
  static constexpr auto fields = FieldList{field("modules", &Value::modules),
                                           field("axes", &Value::axes),
                                           field("surroundings", &Value::environment),
                                           field("groups", &Value::groups),
                                           field("map", &Value::map),
                                           field("continuous", &Value::continuous),
                                           field("paused", &Value::paused),
                                           field("queues_paused", &Value::queues_paused),
                                           field("last_number", &Value::last_number),
                                           field("now", &Value::now)};
  static constexpr std::size_t apart = 1;  // the options, which belong to the bench
  static void check(const Value& chain);
};

/// A chain is saved as its state.
template <>
struct StateOf<emulator::models::slim::Chain> {
  using Value = emulator::models::slim::Chain;
  static const emulator::models::slim::ChainState& told(const Value& chain) { return chain.state_; }
  static void write(const Value& chain, StateWriter& writer) { writer.write(chain.state_); }
  static void read(Value& chain, StateReader& reader) { reader.read(chain.state_); }
};

}  // namespace understudy
