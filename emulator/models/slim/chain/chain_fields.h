// The fields of a chain's state (base/state/fields.h), in the order of the saved bytes.
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
  static constexpr auto fields = FieldList{field<&Value::scale>(),
                                           field<&Value::pulses_per_revolution>(),
                                           field<&Value::speed_unit>(),
                                           field<&Value::working_speed>(),
                                           field<&Value::jog_speed>(),
                                           field<&Value::acceleration>(),
                                           field<&Value::path_acceleration_units_s2>(),
                                           field<&Value::path_speed_units_s>(),
                                           field<&Value::smooth_corner_deg>(),
                                           field<&Value::line_speed_units_s>()};
  static void check(const Value& settings);
};

template <>
struct StateOf<emulator::models::slim::Output> {
  using Value = emulator::models::slim::Output;
  static constexpr auto fields =
      FieldList{field<&Value::mode>(),  field<&Value::on>(),           field<&Value::since>(),
                field<&Value::width>(), field<&Value::frequency_hz>(), field<&Value::duty_percent>()};
  static void check(const Value& output);
};

template <>
struct StateOf<emulator::models::slim::OutputOrder> {
  using Value = emulator::models::slim::OutputOrder;
  static constexpr auto fields =
      FieldList{field<&Value::kind>(),         field<&Value::output>(),       field<&Value::mask>(),
                field<&Value::trigger>(),      field<&Value::trigger_sets>(), field<&Value::width>(),
                field<&Value::frequency_hz>(), field<&Value::duty_percent>(), field<&Value::at_units>()};
  static void check(const Value& order);
};

template <>
struct StateOf<emulator::models::slim::PositionTrigger> {
  using Value = emulator::models::slim::PositionTrigger;
  static constexpr auto fields = FieldList{field<&Value::armed>(), field<&Value::sets>(),
                                           field<&Value::output>(), field<&Value::at_units>()};
  static void check(const Value& trigger);
};

template <>
struct StateOf<emulator::models::slim::Job> {
  using Value = emulator::models::slim::Job;
  static constexpr auto fields = FieldList{field<&Value::kind>(),
                                           field<&Value::number>(),
                                           field<&Value::module_of>(),
                                           field<&Value::units>(),
                                           field<&Value::absolute>(),
                                           field<&Value::height_absolute>(),
                                           field<&Value::sweep_deg>(),
                                           field<&Value::by_radius>(),
                                           field<&Value::growth_units_turn>(),
                                           field<&Value::ends>(),
                                           field<&Value::continuous>(),
                                           field<&Value::smooth_corner_deg>(),
                                           field<&Value::path_acceleration_units_s2>(),
                                           field<&Value::servo_on>(),
                                           field<&Value::begun>(),
                                           field<&Value::output>()};
  static void check(const Value& job);
};

/// Saves only the items that are in the FIFO.
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
  static constexpr auto fields =
      FieldList{field<&Value::settings>(),      field<&Value::linked>(),
                field<&Value::homed>(),         field<&Value::activity>(),
                field<&Value::jog_direction>(), field<&Value::next_jog_direction>(),
                field<&Value::next_thrust>(),   field<&Value::held_jog_direction>(),
                field<&Value::held_thrust>(),   field<&Value::analog_speed>(),
                field<&Value::starved>(),       field<&Value::analog>(),
                field<&Value::thrust>(),        field<&Value::zero_pulses>(),
                field<&Value::place_units>(),   field<&Value::sent_pulses>(),
                field<&Value::late_error>(),    field<&Value::outputs>(),
                field<&Value::triggers>(),      field<&Value::fifo>()};
  static void check(const Value& module);
};

template <>
struct StateOf<emulator::models::slim::Group> {
  using Value = emulator::models::slim::Group;
  static constexpr auto fields =
      FieldList{field<&Value::motion>(), field<&Value::paths>(), field<&Value::end>()};
  // Saves the group only if it is in use.
  static void write(const Value& group, StateWriter& writer);
  static void read(Value& group, StateReader& reader);
};

template <>
struct StateOf<emulator::models::slim::ChainState> {
  using Value = emulator::models::slim::ChainState;
  static constexpr auto fields =
      FieldList{field<&Value::modules>(), field<&Value::axes>(),          field<&Value::environment>(),
                field<&Value::groups>(),  field<&Value::map>(),           field<&Value::continuous>(),
                field<&Value::paused>(),  field<&Value::queues_paused>(), field<&Value::last_number>(),
                field<&Value::now>()};
  static constexpr std::size_t apart = 1;  // the options, which belong to the bench
  static void check(const Value& chain);
};

/// A chain is saved as its state.
template <>
struct StateOf<emulator::models::slim::Chain> {
  using Value = emulator::models::slim::Chain;
  static const emulator::models::slim::ChainState& reported(const Value& chain) { return chain.state_; }
  static void write(const Value& chain, StateWriter& writer) { writer.write(chain.state_); }
  static void read(Value& chain, StateReader& reader) { reader.read(chain.state_); }
};

}  // namespace understudy
