// RS-M8194H: the commands of section 3. Each setting has a row, which defines what the command changes in the
// basic settings of the axes or, with an INITIAL axis code, of the Initial Table.
#pragma once

#include "base/complete_table.h"
#include "emulator/models/rs_m8194h/commands.h"
#include "emulator/models/rs_m8194h/programs/memory.h"

namespace understudy::emulator::models::rs_m8194h {

using lang::Command;
using lang::Verb;
using CommandRow = HandlerRow<Verb, CommandAction>;

inline AxisMask axes_at(const Command& command, std::size_t i) {
  return static_cast<AxisMask>(command.values[i] & kAllAxes);
}

/// Calls `visit(number)` for each axis of a mask.
void for_each_axis(AxisMask axes, auto visit) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (has(axes, a)) visit(a);
  }
}

/// Scales the speeds as if the chip's counts stayed the same while the size of a count changed.
inline void scale_speeds(AxisUnit& unit, std::uint32_t from_max_v, std::uint32_t to_max_v) {
  SpeedSettings& speed = unit.speed;
  for (std::uint32_t* const number :
       {&speed.start_pps, &speed.drive_pps, &speed.acceleration, &speed.deceleration, &speed.jerk_up,
        &speed.jerk_down, &unit.homing.home_pps}) {
    const std::uint64_t scaled = std::uint64_t{*number} * to_max_v / std::max<std::uint32_t>(from_max_v, 1);
    *number = static_cast<std::uint32_t>(std::min<std::uint64_t>(scaled, UINT32_MAX));
  }
}

/// Returns true if a choice prevents soft limits because a ring is enabled, or a ring because soft limits are
/// enabled.
inline bool is_kept_off(const Module& it, const BasicSettings& present, Verb verb) {
  const bool meets =
      (verb == Verb::set_slmt && present.ring) || (verb == Verb::vring_enable && present.soft_limits);
  return meets && it.chose(option("ring_and_soft_limits", "the_earlier_keeps_the_other_off"));
}
/// Copies soft limits to the comparator registers, if a choice makes soft limits use the comparators.
inline void take_comparators(const Module& it, AxisUnit& unit) {
  const BasicSettings& basic = unit.basic;
  if (!basic.soft_limits || !it.chose(option("soft_limits_and_comparators", "become_the_limits"))) return;
  unit.compare = {Compare{.value = basic.forward_soft_limit, .source = basic.soft_limit_source},
                  Compare{.value = basic.reverse_soft_limit, .source = basic.soft_limit_source}};
}

/// Applies a setting of section 3 to the axes in the first parameter. The setting's row is in
/// programs/basic_settings.cpp.
inline Took set_basic(Module& it, const Command& command) {
  const bool is_initial = (command.values[0] & lang::kInitial) != 0;
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    if (is_initial) {
      BasicSettings& kept = it.memory.state().initial_table[a];
      if (!is_kept_off(it, kept, command.verb())) apply_setting(kept, command);
      if (!it.chose(option("initial_acts", "acts_at_once_too"))) return;
    }
    BasicSettings settings = it.chip.unit(a).basic;
    const std::uint32_t max_v = settings.max_v;
    apply_setting(settings, command);
    if (is_kept_off(it, it.chip.unit(a).basic, command.verb())) settings = it.chip.unit(a).basic;
    const bool scales = settings.max_v != max_v && it.chose(option("speeds_at_new_max_v", "scales_them"));
    if (scales) scale_speeds(it.chip.unit(a), max_v, settings.max_v);
    const std::int64_t counted = it.scans.travel(a);
    apply_basic(it.chip.unit(a), it.chip.motor(a), settings, it.machine_options().axis);
    LineScan& scan = it.chip.scan(a);
    // from here on, the encoder counts differently
    if (scan.running) scan.begin += it.scans.travel(a) - counted;
    if (command.verb() == Verb::set_slmt) take_comparators(it, it.chip.unit(a));
    it.chip.rearm(a);
  });
  if (is_initial) it.memory.keep_initial_table();
  return Took::done;
}

template <motion::ExternalDrive::Mode mode>
Took set_external(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    it.external.set(a, mode, mode == motion::ExternalDrive::Mode::off ? 0 : command.values[1]);
  });
  return Took::done;
}

inline Took write_byte_variable(Module& it, const Command& command) {
  it.memory.put(kFirstBvarSlot + lang::byte_variable_number(command.values[0]), byte_at(command, 1));
  return Took::done;
}
inline Took write_variable(Module& it, const Command& command) {
  it.memory.put(kFirstVarSlot + lang::variable_number(command.values[0]), command.values[1]);
  return Took::done;
}
inline Took write_memory(Module& it, const Command& command) {
  const std::size_t number = command.values[0];
  const bool is_real = number >= static_cast<std::size_t>(lang::kFirstRealMemory);
  it.memory.put(kFirstMdSlot + number, command.values[is_real ? 2 : 1]);
  return Took::done;
}

inline Took reset_card(Module& it, const Command&) {
  it.reset_card();
  return Took::done;
}
inline Took clear_buffer(Module& it, const Command&) {
  // A STOP_WAIT that has begun is no longer in the buffer, so it continues.
  it.queue.clear();
  if (it.chose(option("clear_buffer_held_drives", "dropped"))) {
    for (AxisUnit& unit : it.chip.state().units) unit.held_drive = {};
    it.streams.held().clear();
  }
  return Took::done;
}

// clang-format off
inline constexpr CommandRow kSettingCommands[] = {
    {Verb::reset_card,        reset_card},
    {Verb::clear_card_buffer, clear_buffer},
    {Verb::set_pulse_mode,    set_basic},
    {Verb::set_max_v,         set_basic},
    {Verb::set_hlmt,          set_basic},
    {Verb::limitstop_mode,    set_basic},
    {Verb::set_nhome,         set_basic},
    {Verb::set_home_edge,     set_basic},
    {Verb::set_slmt,          set_basic},
    {Verb::clear_slmt,        set_basic},
    {Verb::set_encoder,       set_basic},
    {Verb::servo_on,          set_basic},
    {Verb::servo_off,         set_basic},
    {Verb::set_alarm,         set_basic},
    {Verb::set_inpos,         set_basic},
    {Verb::set_filter,        set_basic},
    {Verb::vring_enable,      set_basic},
    {Verb::vring_disable,     set_basic},
    {Verb::avtri_enable,      set_basic},
    {Verb::avtri_disable,     set_basic},
    {Verb::exd_mp,            set_external<motion::ExternalDrive::Mode::multiply>},
    {Verb::exd_fp,            set_external<motion::ExternalDrive::Mode::fixed>},
    {Verb::exd_cp,            set_external<motion::ExternalDrive::Mode::continuous>},
    {Verb::exd_disable,       set_external<motion::ExternalDrive::Mode::off>},
    {Verb::write_byte_var,    write_byte_variable},
    {Verb::write_var,         write_variable},
    {Verb::write_md,          write_memory},
};
// clang-format on

}  // namespace understudy::emulator::models::rs_m8194h
