// RS-M8194H: the commands for counters, outputs, homing, single axes and paths (4 to 7.2, 7.4).
#pragma once

#include "emulator/models/rs_m8194h/setting_commands.h"

namespace understudy::emulator::models::rs_m8194h {

/// Sets a counter of the axes in the first parameter.
template <void (*set)(AxisUnit& axis, motion::Axis& motor, std::int32_t value, bool ring_folds)>
Took set_counter(Module& it, const Command& command) {
  const bool ring_folds = it.machine_options().axis.ring_folds;
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    set(it.chip.unit(a), it.chip.motor(a), command.signed_value(1), ring_folds);
    const bool is_of_both = command.verb() == Verb::set_lp || command.verb() == Verb::abs_set_position;
    if (is_of_both && it.chose(option("lp_and_abs", "set_both"))) {
      set_logic_position(it.chip.unit(a), it.chip.motor(a), command.signed_value(1), ring_folds);
      set_absolute_position(it.chip.unit(a), it.chip.motor(a), command.signed_value(1), ring_folds);
    }
    it.chip.rearm(a);
  });
  return Took::done;
}

inline Took frnet_out(Module& it, const Command& command) {
  it.frnet.write(command.values[0] % kFrnetGroups, static_cast<std::uint16_t>(command.values[1]));
  return Took::done;
}
inline Took frnet_write(Module& it, const Command& command) {
  it.frnet.write_bit(command.values[0] % kFrnetGroups, command.values[1] % kFrnetChannels,
                     command.values[2] != 0);
  return Took::done;
}

/// The kind of a quantity, which determines its range.
enum class Speed : std::uint8_t { other, speed, slope, jerk };
/// Returns the value to store: as sent, or limited to the range that follows from the present MAX_V.
template <Speed kind>
std::uint32_t within_range(const Module& it, std::uint32_t given, std::uint32_t max_v) {
  if (kind == Speed::other || it.chose(option("reclamp", "when_a_drive_starts"))) return given;
  const SpeedRange range = speed_range(max_v, it.machine_options().speed);
  const double min = kind == Speed::slope ? range.min_slope : kind == Speed::jerk ? range.min_jerk : 0;
  const double max = kind == Speed::slope ? range.max_slope : kind == Speed::jerk ? kMaxJerk : range.max_v;
  return static_cast<std::uint32_t>(std::clamp<double>(given, min, max));
}

/// Sets a number in the speed settings. It applies from the next drive on.
template <auto member, Speed kind = Speed::other>
Took set_speed(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    AxisUnit& unit = it.chip.unit(a);
    auto& number = unit.speed.*member;
    number = static_cast<std::remove_reference_t<decltype(number)>>(
        within_range<kind>(it, command.values[1], unit.basic.max_v));
  });
  return Took::done;
}
/// Updates the speeds of homing, which uses them from its next phase on.
inline void update_homing(Module& it, std::size_t axis) {
  motion::Homing& homing = it.chip.motor(axis).homing;
  if (!homing.active()) return;
  const AxisUnit& unit = it.chip.unit(axis);
  homing.program.speeds = {it.chip.law_of(axis),
                           law_at(unit, unit.homing.home_pps, it.machine_options().speed)};
}
/// Sets V, which also affects the running drive.
inline Took set_drive_speed(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    AxisUnit& unit = it.chip.unit(a);
    unit.speed.drive_pps = within_range<Speed::speed>(it, command.values[1], unit.basic.max_v);
    it.drives.change_speed(a, {.tick = it.now()});
    update_homing(it, a);
  });
  return Took::done;
}
/// Sets a number in the path's speed settings, which do not belong to an axis.
template <auto member>
Took set_vector(Module& it, const Command& command) {
  auto& number = it.chip.paths().vector.*member;
  number = static_cast<std::remove_reference_t<decltype(number)>>(command.values[0]);
  return Took::done;
}

inline Took home_speed(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    AxisUnit& unit = it.chip.unit(a);
    unit.homing.home_pps = within_range<Speed::speed>(it, command.values[1], unit.basic.max_v);
    update_homing(it, a);
  });
  return Took::done;
}
inline Took home_limit(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0),
                [&](std::size_t a) { it.chip.unit(a).homing.limit_is_home = command.values[1] == 1; });
  return Took::done;
}
inline Took home_mode(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    HomeSettings& homing = it.chip.unit(a).homing;
    for (std::size_t i = 0; i < homing.steps.size(); ++i) homing.steps[i] = byte_at(command, 1 + i);
    homing.offset_pulses = command.values[5];
  });
  return Took::done;
}

template <Drive::What what>
Took drive(Module& it, const Command& command) {
  const std::int32_t value = what == Drive::What::home ? 0 : command.signed_value(1);
  return it.drives.drive(axes_at(command, 0), {.what = what, .value = value});
}

/// SET_PULSE: changes the total distance of the running move, counted in the move's direction (7.1.10, A-53).
inline Took set_pulse(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    motion::Axis& motor = it.chip.motor(a);
    if (it.chip.activity(a) != Activity::single || motor.task != motion::Task::move) {
      if (it.chose(option("set_pulse_at_rest", "raises_rint_bit_7"))) it.interrupts.raise(Rint::module);
      return;
    }
    const std::int64_t given = command.signed_value(1);
    const bool is_against = given != 0 && (given < 0) != (motor.drive.direction < 0);
    if (is_against && it.chose(option("set_pulse_sign", "is_ignored"))) return;
    const bool counts = !is_against || it.chose(option("set_pulse_sign", "counts_all_the_same"));
    motor.change_distance(counts ? std::abs(given) : 0, true, it.now());
    it.drives.take_off(a, DiscardEvent::other_drive);  // the rest belongs to this command now
  });
  return Took::done;
}

inline Took axis_assign(Module& it, const Command& command) {
  for (std::size_t i = 0; i < 3; ++i) it.chip.paths().assigned[i] = byte_at(command, i);
  return Took::done;
}

inline Took path(Module& it, const Command& command) { return it.path_starts.follow(command); }

/// INITIAL of a stream: stores the settings for all its CONTINUE commands. INITIAL waits while a stream is
/// running (7.4.2, 7.4.5, 7.4.8).
template <Stream stream>
Took initial(Module& it, const Command& command) {
  Paths& paths = it.chip.paths();
  if (paths.together.engaged && paths.runs == Paths::Runs::stream) return Took::waits;
  constexpr std::size_t kAxesNamed = stream == Stream::line_3d ? 3 : 2;
  constexpr std::size_t kFirstSpeed = stream == Stream::mix_2d ? 3 : kAxesNamed;
  StreamSettings settings{.given = true};
  for (std::size_t i = 0; i < kAxesNamed; ++i) settings.axes[i] = byte_at(command, i);
  settings.constant = stream == Stream::mix_2d && command.values[2] == 0;
  settings.start_pps = command.values[kFirstSpeed];
  settings.drive_pps = command.values[kFirstSpeed + 1];
  settings.acceleration = command.values[kFirstSpeed + 2];
  paths.streams[static_cast<std::size_t>(stream)] = settings;
  paths.open = false;
  it.streams.forget_break(stream);
  it.interrupts.clear(Rint::module);
  if (paths.broken == 0) it.interrupts.clear(Rint::stream);
  return Took::done;
}

/// LINE_SCAN (7.4.12): stores the setting for the next scan, which consumes it. A scan uses C+, so the soft
/// limits are disabled.
inline Took line_scan(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    AxisUnit& unit = it.chip.unit(a);
    LineScan& scan = it.chip.scan(a);
    const bool is_anew = !scan.set;
    scan = {.set = true,
            .type = byte_at(command, 1),
            .pitch = command.signed_value(4),
            .level_before = is_anew ? unit.out.level : scan.level_before,
            .width_before = is_anew ? unit.out.width_code : scan.width_before};
    const bool is_turned = it.chose(option("scan_edge", "high"));
    unit.out.level = static_cast<std::uint8_t>(byte_at(command, 2) ^ (is_turned ? 1U : 0U));
    unit.out.width_code = byte_at(command, 3);
    unit.basic.soft_limits = false;
    it.chip.rearm(a);
  });
  return Took::done;
}
inline Took line_scan_start(Module& it, const Command& command) {
  const AxisMask axes = axes_at(command, 0);
  if (it.drives.drive(axes, {.what = Drive::What::scan, .value = command.signed_value(2)}) == Took::waits) {
    return Took::waits;
  }
  // A held scan begins later.
  AxisMask begun = 0;
  for_each_axis(axes, [&](std::size_t a) {
    if (it.chip.unit(a).held_drive.what != Drive::What::scan) begun |= mask_of(a);
  });
  it.scans.open(begun);
  return Took::done;
}

// clang-format off
inline constexpr CommandRow kMotionCommands[] = {
    {Verb::set_lp,                set_counter<set_logic_position>},
    {Verb::set_ep,                set_counter<set_encoder_position>},
    {Verb::abs_set_position,      set_counter<set_absolute_position>},
    {Verb::frnet_out,             frnet_out},
    {Verb::frnet_write,           frnet_write},
    {Verb::set_hv,                home_speed},
    {Verb::home_limit,            home_limit},
    {Verb::set_home_mode,         home_mode},
    {Verb::home_start,            drive<Drive::What::home>},
    {Verb::normal_speed,          set_speed<&SpeedSettings::mode>},
    {Verb::set_sv,                set_speed<&SpeedSettings::start_pps, Speed::speed>},
    {Verb::set_v,                 set_drive_speed},
    {Verb::change_vel_on_fly,     set_drive_speed},
    {Verb::set_a,                 set_speed<&SpeedSettings::acceleration, Speed::slope>},
    {Verb::set_d,                 set_speed<&SpeedSettings::deceleration, Speed::slope>},
    {Verb::set_k,                 set_speed<&SpeedSettings::jerk_up, Speed::jerk>},
    {Verb::set_l,                 set_speed<&SpeedSettings::jerk_down, Speed::jerk>},
    {Verb::set_ao,                set_speed<&SpeedSettings::offset_pulses>},
    {Verb::fixed_move,            drive<Drive::What::fixed>},
    {Verb::set_pulse,             set_pulse},
    {Verb::abs_fixed_move,        drive<Drive::What::absolute>},
    {Verb::continue_move,         drive<Drive::What::endless>},
    {Verb::axis_assign,           axis_assign},
    {Verb::vector_speed,          set_vector<&SpeedSettings::mode>},
    {Verb::set_vsv,               set_vector<&SpeedSettings::start_pps>},
    {Verb::set_vv,                set_vector<&SpeedSettings::drive_pps>},
    {Verb::set_va,                set_vector<&SpeedSettings::acceleration>},
    {Verb::set_vd,                set_vector<&SpeedSettings::deceleration>},
    {Verb::set_vk,                set_vector<&SpeedSettings::jerk_up>},
    {Verb::set_vl,                set_vector<&SpeedSettings::jerk_down>},
    {Verb::set_vao,               set_vector<&SpeedSettings::offset_pulses>},
    {Verb::line_2d,               path},
    {Verb::line_3d,               path},
    {Verb::arc_cw,                path},
    {Verb::arc_ccw,               path},
    {Verb::circle_cw,             path},
    {Verb::circle_ccw,            path},
    {Verb::abs_line_2d,           path},
    {Verb::abs_line_3d,           path},
    {Verb::abs_arc_cw,            path},
    {Verb::abs_arc_ccw,           path},
    {Verb::rectangle,             path},
    {Verb::line_2d_initial,       initial<Stream::line_2d>},
    {Verb::line_2d_continue,      path},
    {Verb::abs_line_2d_continue,  path},
    {Verb::line_3d_initial,       initial<Stream::line_3d>},
    {Verb::line_3d_continue,      path},
    {Verb::abs_line_3d_continue,  path},
    {Verb::mix_2d_initial,        initial<Stream::mix_2d>},
    {Verb::mix_2d_continue,       path},
    {Verb::abs_mix_2d_continue,   path},
    {Verb::helix_3d,              path},
    {Verb::line_scan,             line_scan},
    {Verb::line_scan_start,       line_scan_start},
};
// clang-format on

}  // namespace understudy::emulator::models::rs_m8194h
