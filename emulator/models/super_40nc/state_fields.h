// The fields of a SUPER-40NC's state (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include <cstddef>
#include <string>

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "emulator/device/memory/eeprom_fields.h"
#include "emulator/models/super_40nc/device.h"
#include "interpreter/super_40nc/state_fields.h"
#include "motion/state_fields.h"

namespace understudy {

namespace emulator::models::super_40nc {
/// Returns the name of the register at an image slot: "D9100", "M8000".
std::string register_at_slot(std::size_t slot);
/// Returns the number of fields of a part's state.
template <class T, std::size_t count = 1>
constexpr std::size_t count_members() {
  if constexpr (state_fields::has_members<T, count>()) {
    return count;
  } else {
    return count_members<T, count + 1>();
  }
}
}  // namespace emulator::models::super_40nc

template <>
struct StateOf<emulator::models::super_40nc::Activity> {
  static constexpr auto last = emulator::models::super_40nc::Activity::wheel;
};

template <>
struct StateOf<emulator::models::super_40nc::WheelSource> {
  static constexpr auto last = emulator::models::super_40nc::WheelSource::selector;
};

template <>
struct StateOf<emulator::models::super_40nc::Mover> {
  static constexpr auto last = emulator::models::super_40nc::Mover::hand;
};

template <>
struct StateOf<emulator::models::super_40nc::RestKind> {
  static constexpr auto last = emulator::models::super_40nc::RestKind::home;
};

template <>
struct StateOf<emulator::models::super_40nc::Rest> {
  using Value = emulator::models::super_40nc::Rest;
  static constexpr auto fields =
      FieldList{field<&Value::kind>(),   field<&Value::travel>(),      field<&Value::distance>(),
                field<&Value::search>(), field<&Value::searches>(),    field<&Value::marks_positive>(),
                field<&Value::rpm>(),    field<&Value::limits_count>()};
  static void check(const Value& rest);
};

template <>
struct StateOf<interpreter::super_40nc::Code> {
  static constexpr auto last = interpreter::super_40nc::Code::comparator;
};

template <>
struct StateOf<interpreter::super_40nc::Area> {
  static constexpr auto last = interpreter::super_40nc::Area::plc;
};

template <>
struct StateOf<emulator::models::super_40nc::Contacts> {
  using Value = emulator::models::super_40nc::Contacts;
  static constexpr auto fields = FieldList{field<&Value::flags>()};
};

template <>
struct StateOf<emulator::models::super_40nc::ErrorReport> {
  using Value = emulator::models::super_40nc::ErrorReport;
  static constexpr auto fields =
      FieldList{field<&Value::code>(), field<&Value::step>(), field<&Value::area>(),
                field<&Value::other_step>(), field<&Value::tick>()};
};

template <>
struct StateOf<emulator::models::super_40nc::OrderKey> {
  using Value = emulator::models::super_40nc::OrderKey;
  static constexpr auto fields =
      FieldList{field<&Value::runs>(), field<&Value::order>(), field<&Value::has_failed>()};
};

template <>
struct StateOf<emulator::models::super_40nc::AxisState> {
  using Value = emulator::models::super_40nc::AxisState;
  static constexpr auto fields = FieldList{field<&Value::sent_pulses>(),
                                           field<&Value::followed_pulses>(),
                                           field<&Value::command>(),
                                           field<&Value::counts>(),
                                           field<&Value::latched>(),
                                           field<&Value::index_count>(),
                                           field<&Value::latch_was_on>(),
                                           field<&Value::clears>(),
                                           field<&Value::compares_by_tick>(),
                                           field<&Value::latching>(),
                                           field<&Value::compared>(),
                                           field<&Value::offset_lu>(),
                                           field<&Value::scale_seen>(),
                                           field<&Value::encoder_counts>(),
                                           field<&Value::backlash_seen>(),
                                           field<&Value::path_backlash>(),
                                           field<&Value::arc_backlash>(),
                                           field<&Value::arc_backlash_part>(),
                                           field<&Value::holder>(),
                                           field<&Value::asked_by_contact>(),
                                           field<&Value::mover>(),
                                           field<&Value::awaited>(),
                                           field<&Value::stop_awaited_by>(),
                                           field<&Value::shows_finish>(),
                                           field<&Value::is_held>(),
                                           field<&Value::rest>(),
                                           field<&Value::jog_keys>(),
                                           field<&Value::plc_jog_direction>(),
                                           field<&Value::asked_by_plc>(),
                                           field<&Value::masked>(),
                                           field<&Value::homed>(),
                                           field<&Value::zeroed>(),
                                           field<&Value::has_ended>(),
                                           field<&Value::has_error>(),
                                           field<&Value::order>(),
                                           field<&Value::step_pps>(),
                                           field<&Value::stands_on_target>(),
                                           field<&Value::target_lu>(),
                                           field<&Value::wheel>(),
                                           field<&Value::wheel_lu>(),
                                           field<&Value::wheel_edges>()};
  static void check(const Value& axis);
};

template <>
struct StateOf<emulator::models::super_40nc::UserTable::Runs> {
  static constexpr auto last = emulator::models::super_40nc::UserTable::Runs::table;
};

template <>
struct StateOf<emulator::models::super_40nc::UserTable> {
  using Value = emulator::models::super_40nc::UserTable;
  static constexpr auto fields = FieldList{field<&Value::runs>(), field<&Value::words>()};
};

template <>
struct StateOf<emulator::models::super_40nc::State> {
  using Value = emulator::models::super_40nc::State;
  static constexpr std::size_t members =
      emulator::models::super_40nc::count_members<emulator::models::super_40nc::GroundState>() +
      emulator::models::super_40nc::count_members<emulator::models::super_40nc::AxesState>() +
      emulator::models::super_40nc::count_members<emulator::models::super_40nc::PathState>() +
      emulator::models::super_40nc::count_members<emulator::models::super_40nc::PanelState>() +
      emulator::models::super_40nc::count_members<emulator::models::super_40nc::ProgramState>() +
      emulator::models::super_40nc::count_members<emulator::models::super_40nc::ScanState>();
  static constexpr auto fields =
      FieldList{field<&Value::image>(emulator::models::super_40nc::register_at_slot),
                field<&Value::chips>(),
                field<&Value::environment>(),
                field<&Value::axes>(),
                field<&Value::path>(),
                field<&Value::path_is_held>(),
                field<&Value::path_backlash_ticks>(),
                field<&Value::path_feed_lu_s>(),
                field<&Value::path_feed_scale>(),
                field<&Value::path_limit_lu_s>(),
                field<&Value::plc>(),
                field<&Value::plc_quiet_scans>(),
                field<&Value::steps>(),
                field<&Value::contacts>(),
                field<&Value::error>(),
                field<&Value::touched>(),
                field<&Value::run_switch>(),
                field<&Value::emergency>(),
                field<&Value::has_ticked>(),
                field<&Value::emergency_obeyed>(),
                field<&Value::were_held>(),
                field<&Value::was_inhibited>(),
                field<&Value::wheel_selected>(),
                field<&Value::analog>(),
                field<&Value::wheel_edges>(),
                field<&Value::signal_until>(),
                field<&Value::receive_errors>(),
                field<&Value::homing_by_key>(),
                field<&Value::zeroing_by_key>(),
                field<&Value::logo_at>(),
                field<&Value::logo_over>(),
                field<&Value::file_changed>(),
                field<&Value::shows_file_changed>(),
                field<&Value::file>(),
                field<&Value::file_is_left_out>(),
                field<&Value::recipe>(),
                field<&Value::rpm_at_power_up>(),
                field<&Value::logo_ms>(),
                field<&Value::station>(),
                field<&Value::parameters_in_force>(),
                field<&Value::flash_until>(),
                field<&Value::erc_until>(),
                field<&Value::clears_seen>(),
                field<&Value::latches_seen>(),
                field<&Value::table>(),
                field<&Value::eeprom>(),
                field<&Value::blocks>()};
  static void check(const Value& state);
};

}  // namespace understudy
