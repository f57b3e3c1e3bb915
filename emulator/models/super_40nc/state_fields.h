// The fields of a SUPER-40NC's state (base/state/fields.h), in the order of the bytes.
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
/// Returns the name of the register at a slot of the image: "D9100", "M8000".
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
      FieldList{field("kind", &Value::kind),         field("travel", &Value::travel),
                field("distance", &Value::distance), field("search", &Value::search),
                field("searches", &Value::searches), field("marks_positive", &Value::marks_positive),
                field("rpm", &Value::rpm),           field("limits_count", &Value::limits_count)};
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
  static constexpr auto fields = FieldList{field("flags", &Value::flags)};
};

template <>
struct StateOf<emulator::models::super_40nc::ErrorReport> {
  using Value = emulator::models::super_40nc::ErrorReport;
  static constexpr auto fields =
      FieldList{field("code", &Value::code), field("step", &Value::step), field("area", &Value::area),
                field("other_step", &Value::other_step), field("tick", &Value::tick)};
};

template <>
struct StateOf<emulator::models::super_40nc::OrderKey> {
  using Value = emulator::models::super_40nc::OrderKey;
  static constexpr auto fields = FieldList{field("runs", &Value::runs), field("order", &Value::order),
                                           field("has_failed", &Value::has_failed)};
};

template <>
struct StateOf<emulator::models::super_40nc::AxisState> {
  using Value = emulator::models::super_40nc::AxisState;
  static constexpr auto fields = FieldList{field("sent_pulses", &Value::sent_pulses),
                                           field("followed_pulses", &Value::followed_pulses),
                                           field("command", &Value::command),
                                           field("counts", &Value::counts),
                                           field("latched", &Value::latched),
                                           field("index_count", &Value::index_count),
                                           field("latch_was_on", &Value::latch_was_on),
                                           field("clears", &Value::clears),
                                           field("compares_by_tick", &Value::compares_by_tick),
                                           field("latching", &Value::latching),
                                           field("compared", &Value::compared),
                                           field("offset_lu", &Value::offset_lu),
                                           field("scale_seen", &Value::scale_seen),
                                           field("encoder_counts", &Value::encoder_counts),
                                           field("backlash_seen", &Value::backlash_seen),
                                           field("path_backlash", &Value::path_backlash),
                                           field("arc_backlash", &Value::arc_backlash),
                                           field("arc_backlash_part", &Value::arc_backlash_part),
                                           field("holder", &Value::holder),
                                           field("asked_by_contact", &Value::asked_by_contact),
                                           field("mover", &Value::mover),
                                           field("awaited", &Value::awaited),
                                           field("stop_awaited_by", &Value::stop_awaited_by),
                                           field("shows_finish", &Value::shows_finish),
                                           field("is_held", &Value::is_held),
                                           field("rest", &Value::rest),
                                           field("jog_keys", &Value::jog_keys),
                                           field("plc_jog_way", &Value::plc_jog_direction),
                                           field("asked_by_plc", &Value::asked_by_plc),
                                           field("masked", &Value::masked),
                                           field("homed", &Value::homed),
                                           field("zeroed", &Value::zeroed),
                                           field("has_ended", &Value::has_ended),
                                           field("has_error", &Value::has_error),
                                           field("order", &Value::order),
                                           field("step_pps", &Value::step_pps),
                                           field("stands_on_target", &Value::stands_on_target),
                                           field("target_lu", &Value::target_lu),
                                           field("wheel", &Value::wheel),
                                           field("wheel_lu", &Value::wheel_lu),
                                           field("wheel_edges", &Value::wheel_edges)};
  static void check(const Value& axis);
};

template <>
struct StateOf<emulator::models::super_40nc::UserTable::Runs> {
  static constexpr auto last = emulator::models::super_40nc::UserTable::Runs::table;
};

template <>
struct StateOf<emulator::models::super_40nc::UserTable> {
  using Value = emulator::models::super_40nc::UserTable;
  static constexpr auto fields = FieldList{field("runs", &Value::runs), field("words", &Value::words)};
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
      FieldList{field("image", &Value::image, emulator::models::super_40nc::register_at_slot),
                field("chips", &Value::chips),
                field("here", &Value::environment),
                field("axes", &Value::axes),
                field("path", &Value::path),
                field("path_is_held", &Value::path_is_held),
                field("path_backlash_ticks", &Value::path_backlash_ticks),
                field("path_feed_lu_s", &Value::path_feed_lu_s),
                field("path_feed_scale", &Value::path_feed_scale),
                field("path_limit_lu_s", &Value::path_limit_lu_s),
                field("plc", &Value::plc),
                field("plc_quiet_scans", &Value::plc_quiet_scans),
                field("steps", &Value::steps),
                field("contacts", &Value::contacts),
                field("error", &Value::error),
                field("touched", &Value::touched),
                field("run_switch", &Value::run_switch),
                field("emergency", &Value::emergency),
                field("has_ticked", &Value::has_ticked),
                field("emergency_obeyed", &Value::emergency_obeyed),
                field("were_held", &Value::were_held),
                field("was_inhibited", &Value::was_inhibited),
                field("wheel_selected", &Value::wheel_selected),
                field("analog", &Value::analog),
                field("wheel_edges", &Value::wheel_edges),
                field("signal_until", &Value::signal_until),
                field("receive_errors", &Value::receive_errors),
                field("homing_by_key", &Value::homing_by_key),
                field("zeroing_by_key", &Value::zeroing_by_key),
                field("logo_at", &Value::logo_at),
                field("logo_over", &Value::logo_over),
                field("file_changed", &Value::file_changed),
                field("shows_file_changed", &Value::shows_file_changed),
                field("file", &Value::file),
                field("file_is_left_out", &Value::file_is_left_out),
                field("recipe", &Value::recipe),
                field("rpm_at_power_up", &Value::rpm_at_power_up),
                field("logo_ms", &Value::logo_ms),
                field("station", &Value::station),
                field("parameters_in_force", &Value::parameters_in_force),
                field("flash_until", &Value::flash_until),
                field("erc_until", &Value::erc_until),
                field("clears_seen", &Value::clears_seen),
                field("latches_seen", &Value::latches_seen),
                field("table", &Value::table),
                field("eeprom", &Value::eeprom),
                field("blocks", &Value::blocks)};
  static void check(const Value& state);
};

}  // namespace understudy
