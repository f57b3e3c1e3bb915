// The axes of a SUPER-40NC: their numbers, how motions begin and end, and jogs. HOME and ZERO are in
// homes.cpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/marks.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/ownership.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "emulator/models/super_40nc/settings.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/events.h"
#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/homing.h"
#include "motion/ramp.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// The chip's mode of motion (PRMD), and its command to start with a ramp (PRCMD).
constexpr int kModeContinuous = 0x00;
constexpr int kModeNegative = 0x08;  // added for the negative direction
constexpr int kStartWithRamp = 0x53;

std::int32_t in_32_bits(double number) {
  return static_cast<std::int32_t>(std::llround(std::clamp(number, -2147483648.0, 2147483647.0)));
}

}  // namespace

Code code_of(motion::Cause why) {
  switch (why) {
    case motion::Cause::limit_plus: return Code::limit_positive;
    case motion::Cause::limit_minus: return Code::limit_negative;
    case motion::Cause::soft_limit_plus: return Code::soft_limit_positive;
    case motion::Cause::soft_limit_minus: return Code::soft_limit_negative;
    case motion::Cause::alarm: return Code::alarm;
    case motion::Cause::comparator: return Code::comparator;
    case motion::Cause::homing_failed: return Code::home_failed;
    case motion::Cause::none:
    case motion::Cause::arrived:
    case motion::Cause::stopped:
    case motion::Cause::emergency:
    case motion::Cause::servo_off: break;
  }
  return Code::none;
}

// ---- numbers

std::int64_t Super40nc::work_lu(int axis_number) const {
  const AxisState& state = axis(axis_number);
  return registers().scale(axis_number).to_units(machine_pulses(axis_number)).value_or(0) + state.offset_lu;
}

void Super40nc::set_work_lu(int axis_number, std::int64_t position) {
  AxisState& state = axis(axis_number);
  if (state.moves() && chose(option("pset_moving", "void"))) {
    report(Code::axis_taken);
    return;
  }
  state.offset_lu += position - work_lu(axis_number);
  state.stands_on_target = false;
}

std::int32_t Super40nc::counter(int axis_number, int number) const {
  const AxisState& state = axis(axis_number);
  if (number == 0) return static_cast<std::int32_t>(machine_pulses(axis_number));
  return state.counts[static_cast<std::size_t>(number - 1)];
}

void Super40nc::set_counter(int axis_number, int number, std::int32_t pulses) {
  AxisState& state = axis(axis_number);
  if (number > 0) {
    state.counts[static_cast<std::size_t>(number - 1)] = pulses;
    set_comparators(axis_number);
    return;
  }
  state.command.set(pulses, chip(axis_number).travel_pulses);
  state.stands_on_target = false;
  apply_axis_parameters(axis_number, 0);
}

std::int64_t Super40nc::braking_pulses(int axis) const {
  const motion::Axis& motor = chip(axis);
  if (motor.task != motion::Task::move) return 0;
  const motion::RampLaw& down = motor.law.slow_down_reckoned_by.value_or(motor.law.down);
  return std::llround(motion::ramp_distance(down, motor.law.start_speed_u_s, motor.law.top_speed_u_s));
}

// ---- errors

void Super40nc::report(const ErrorReport& error) {
  if (error.code == Code::none || (state_.error.code != Code::none && state_.error.tick == now())) return;
  state_.error = error;
  state_.error.tick = now();
}

void Super40nc::report(Code code, Mover of_its_line) {
  ErrorReport error{.code = code, .step = line_step(of_its_line)};
  if (of_its_line < Mover::plc) {
    const auto area = static_cast<Area>(of_its_line);
    const bool runs = state_.steps.programs[interpreter::super_40nc::index_of(area)].phase !=
                      interpreter::super_40nc::Phase::idle;
    if (runs) error.area = area;
  }
  report(error);
}

/// Called when a program, or a motion by hand or of the PLC, has started.
void Super40nc::error_is_over() {
  if (!chose(option("error_clears", "plc_to_run_alone"))) clear_error();
}

void Super40nc::fail(int axis_number, Code code) {
  axis(axis_number).has_error = true;
  give_erc_behind(axis_number, code);
  report(code, axis(axis_number).mover);
}

// ---- starts

Grant Super40nc::ask(int axis_number, Request request) {
  const Grant given = granted(axis(axis_number).holder, request);
  if (given == Grant::refused) report(Code::axis_taken, Mover::plc);
  return given;
}

motion::Cause Super40nc::blocked_both_ways(int axis) const {
  if (!chose(option("limits_blocking", "both_ways_blocked"))) return motion::Cause::none;
  if (has_signal(axis, motion::Signal::limit_plus)) return motion::Cause::limit_plus;
  return has_signal(axis, motion::Signal::limit_minus) ? motion::Cause::limit_minus : motion::Cause::none;
}

motion::AxisSettings Super40nc::motor_settings(int axis, bool homes) const {
  const Settings settings = registers();
  const auto reaction = [&](Kept kept) {
    return settings.is_on(kept, axis) ? motion::Reaction::slow_down : motion::Reaction::stop_at_once;
  };
  motion::AxisSettings made = chip(axis).settings;
  made.needs_servo = false;
  made.at_limit_plus = made.at_limit_minus = reaction(kept_x(d9x::kOtStop));
  made.at_alarm = reaction(kept_x(d9x::kAlmStop));
  made.soft_limit_plus = made.soft_limit_minus = std::nullopt;
  if (homes && chose(option("home_soft_limits", "ignored"))) return made;
  const std::int64_t counter_lead = machine_pulses(axis) - chip(axis).travel_pulses;
  constexpr Value kSoftLimit = 6;
  constexpr Value kRamp = 2;
  struct Side {
    Kept source, method, action, value;
    std::optional<std::int64_t> motion::AxisSettings::*limit;
  };
  static constexpr Side kSides[] = {
      {kept_x(d9x::kCp1Source), kept_x(d9x::kCp1Method), kept_x(d9x::kCp1Action), kept_d(d8x::kRcmp1),
       &motion::AxisSettings::soft_limit_plus},
      {kept_x(d9x::kCp2Source), kept_x(d9x::kCp2Method), kept_x(d9x::kCp2Action), kept_d(d8x::kRcmp2),
       &motion::AxisSettings::soft_limit_minus}};
  for (const Side& side : kSides) {
    const Value action = settings.of(side.action, axis);
    const bool is_limit = settings.of(side.method, axis) == kSoftLimit &&
                          settings.of(side.source, axis) == 0 && (action == 1 || action == kRamp);
    if (!is_limit) continue;
    made.*side.limit = settings.raw(side.value, axis) - counter_lead;
    const motion::Reaction at_limit =
        action == kRamp ? motion::Reaction::slow_down : motion::Reaction::stop_at_once;
    if (side.limit == &motion::AxisSettings::soft_limit_plus) {
      made.at_soft_limit = at_limit;
    } else {
      made.at_soft_limit_minus = at_limit;
    }
  }
  return made;
}

/// Takes from the parameters what a motion needs when it starts.
void Super40nc::prepare(int axis_number, bool homes) {
  const Settings parameters = registers();
  AxisState& state = axis(axis_number);
  motion::AxisSettings settings = motor_settings(axis_number, homes);
  constexpr Value kSlip = 2;
  const Value correction = parameters.of(kept_x(d9x::kCorrectMode), axis_number);
  settings.backlash_pulses = correction != 0 ? parameters.of(kept_x(d9x::kBacklash), axis_number) : 0;
  settings.slips = correction == kSlip;
  const bool is_first = chip(axis_number).last_direction == 0;
  if (is_first && chose(option("backlash_first_move", "as_behind_a_positive_one"))) {
    chip(axis_number).last_direction = +1;
  }
  settings.waits_for_in_position = chose(option("inp_wait", "single_axes_wait"));
  const auto creep_rpm = static_cast<double>(parameters.of(kept_x(d9x::kCreepSpeed), axis_number));
  settings.backlash_speed_pps =
      std::min(parameters.pps(axis_number, creep_rpm), parameters.top_pps(axis_number));
  chip(axis_number).set(settings);
  state.masked = parameters.is_on(kept_x(d9x::kPulseMask), axis_number);
  // Signals that have come in this tick count; the DOG's edge is left for the latch.
  motion::Axis& motor = chip(axis_number);
  const motion::Signals mark = motion::bit(motion::Signal::mark);
  const motion::Signals seen = environment(axis_number).at(motor.travel_pulses, motor.signals);
  motor.signals = static_cast<motion::Signals>((seen & ~mark) | (motor.signals & mark));
  // A host may have written the high half alone, as the manual's wrong example does: the low half counts.
  const bool is_whole = chose(option("motor_direction", "whole_value"));
  const std::int32_t direction =
      parameters.raw(kept_x(d9x::kPulseMode), axis_number) & (is_whole ? -1 : 0xFFFF);
  const bool inverted = direction == 3 || direction == 6;
  if (inverted != chip(axis_number).inverted) {
    chip(axis_number).inverted = inverted;
    update_environment(axis_number);
  }
}

void Super40nc::begun(int axis_number, motion::Cause why_not, Activity holder) {
  AxisState& state = axis(axis_number);
  if (why_not == motion::Cause::none && holder != Activity::home) {
    why_not = blocked_both_ways(axis_number);
    if (why_not != motion::Cause::none) {
      chip(axis_number).stop(why_not);
      forget_end(axis_number);
    }
  }
  if (why_not != motion::Cause::none) {
    fail(axis_number, code_of(why_not));
    return;
  }
  // For a program, only its start clears the error.
  if (state.mover >= Mover::plc) error_is_over();
  take_off(state, MarkEvent::motion_begins);
  state.holder = holder;
  Tick& erc = state_.erc_until[static_cast<std::size_t>(axis_number)];
  if (erc == kNever) erc = 0;  // a level, until the next start
}

motion::SpeedLaw Super40nc::jog_law(int axis) const {
  const Settings settings = registers();
  const std::array<Kept, 3> speeds{kept_x(d9x::kJogLow), kept_x(d9x::kJogMedium), kept_x(d9x::kJogHigh)};
  const bool is_medium = chose(option("jog_selector", "always_medium"));
  const Kept chosen =
      is_medium ? speeds[1] : speeds[static_cast<std::size_t>(settings.of(kept_d(d8::kUserData2)))];
  return settings.law(axis, static_cast<double>(settings.of(chosen, axis)));
}

void Super40nc::change_jog_speed() {
  if (!chose(option("jog_selector", "d8022_also_while_it_runs"))) return;
  for (int number = 0; number < kAxisCount; ++number) {
    const AxisState& state = axis(number);
    const bool is_asked = state.asked_by_contact || state.asked_by_plc;
    if (state.holder == Activity::jog && is_asked) chip(number).change_speed(jog_law(number), now());
  }
}

void Super40nc::start_jog(int axis_number, int direction, bool AxisState::*asked_by) {
  AxisState& state = axis(axis_number);
  const Grant given = ask(axis_number, Request::jog);
  const motion::SpeedLaw law = jog_law(axis_number);
  if (given == Grant::continues_if_same_kind) {
    if (chip(axis_number).last_direction != direction) {
      report(Code::axis_taken);
      return;
    }
    chip(axis_number).resume(law, now());
    state.*asked_by = true;
    return;
  }
  if (given != Grant::starts) return;
  prepare(axis_number);
  begun(axis_number, chip(axis_number).run(direction, law, before_motion()), Activity::jog);
  if (state.holder != Activity::jog) return;
  state.*asked_by = true;
  mirror_start(axis_number, kModeContinuous + (direction < 0 ? kModeNegative : 0), 0, law);
}

/// Stops a jog by its ramp when no request is left.
void Super40nc::release_jog(int axis_number, bool AxisState::*asked_by) {
  AxisState& state = axis(axis_number);
  if (state.holder != Activity::jog || !(state.*asked_by)) return;
  state.*asked_by = false;
  if (!state.asked_by_contact && !state.asked_by_plc) chip(axis_number).slow_down(now());
}

// ---- ends

void Super40nc::let_go(int axis_number) {
  AxisState& state = axis(axis_number);
  const bool looked_for_mark = state.rest.kind == RestKind::mark || state.rest.limits_count;
  take_off(state, MarkEvent::motion_ends);
  if (looked_for_mark) update_environment(axis_number);
}

void Super40nc::stop_axis(int axis_number, Code code) {
  AxisState& state = axis(axis_number);
  if (state.holder == Activity::nobody) return;
  if (is_on_path(axis_number)) return stop_path();
  const Activity held = state.holder;
  chip(axis_number).stop();
  chip(axis_number).homing.phase = -1;
  forget_end(axis_number);
  state.has_ended = true;
  if (held == Activity::home) {
    home_ended(axis_number, false, code);
  } else if (held == Activity::zero && state.order != 0) {
    state_.zeroing_by_key.has_failed = true;
  }
  let_go(axis_number);
}

/// Called when the motor has come to rest without a command.
void Super40nc::ended(int axis_number) {
  AxisState& state = axis(axis_number);
  const motion::Axis& motor = chip(axis_number);
  const Activity held = state.holder;
  const motion::Cause why = motor.cause;
  state.has_ended = true;
  if (held == Activity::nobody || held == Activity::rest) return;
  const bool has_found = (motor.events & motion::bit(motion::Event::homed)) != 0;
  // The result of the last search or mark counts, however it ended; it stays until the next one.
  const bool is_stopped = why == motion::Cause::stopped;
  if (state.is_held && is_stopped && !has_found) return rest_axis(axis_number);
  if (held == Activity::wheel) return wheel_ended(axis_number);

  const Mover mover = state.mover;
  const bool is_awaited = state.awaited;
  Code code = code_of(why);
  if (held == Activity::home) {
    if (!has_found && !is_stopped) code = Code::home_failed;
    home_ended(axis_number, has_found, code);
  } else if (code != Code::none) {
    fail(axis_number, code);
  }
  if (held == Activity::zero) {
    state.zeroed = why == motion::Cause::arrived;
    if (!state.zeroed && state.order != 0) state_.zeroing_by_key.has_failed = true;
  }
  const bool has_arrived = held == Activity::move && code == Code::none && (has_found || !is_stopped);
  const bool is_at_target = has_arrived && state.rest.kind == RestKind::move;
  const bool shows_finish = has_arrived && state.shows_finish;
  let_go(axis_number);
  state.stands_on_target = is_at_target && distance_to(axis_number, state.target_lu) == 0;
  if (shows_finish) show_finished(static_cast<std::size_t>(axis_number));
  const bool goes_on = held == Activity::home && chose(option("home_failure", "the_program_goes_on"));
  if (code != Code::none && mover < Mover::plc && !goes_on)
    program_broken(mover, axis_number, is_awaited, why);
}

// ---- what a start leaves in the chip's registers

void Super40nc::mirror_start(int axis_number, int mode, std::int64_t distance_pulses,
                             const motion::SpeedLaw& law) {
  const Settings settings = registers();
  AxisState& state = axis(axis_number);
  const double top = std::max(law.top_speed_u_s, 1.0);
  const double step = settings.multiplier(axis_number, top);
  state.step_pps = step;
  if (chose(option("chip_mirror", "plain_registers"))) return;
  const auto rate = [&](const motion::RampLaw& ramp) {
    constexpr double kClock = 19'660'800;
    if (!(ramp.acceleration_u_s2 > 0)) return 0;
    return in_32_bits(std::clamp(std::round(step * kClock / (4 * ramp.acceleration_u_s2)) - 1, 1.0, 65535.0));
  };
  const double creep_pps =
      settings.pps(axis_number, static_cast<double>(settings.of(kept_x(d9x::kCreepSpeed), axis_number)));
  struct Shown {
    int offset;  // from PRCMD
    std::int32_t value;
  };
  const Shown shown[] = {{0, kStartWithRamp},
                         {1, static_cast<std::int32_t>(distance_pulses)},
                         {2, in_32_bits(law.start_speed_u_s / step)},
                         {3, in_32_bits(law.top_speed_u_s / step)},
                         {4, rate(law.up)},
                         {5, rate(law.down)},
                         {6, in_32_bits(300 / step) - 1},
                         {7, 0},
                         {8, mode},
                         {9, 0},
                         {10, settings.raw(kept_x(d9x::kSAcceleration), axis_number)},
                         {11, settings.raw(kept_x(d9x::kSDeceleration), axis_number)}};
  static constexpr Kept kFirst = kept_d(d8x::kPrcmd);
  static constexpr Kept kFirstWorking = kept_d(d8x::kRmv);  // RMV; the other registers follow
  const auto show = [&](Kept first, int offset, std::int32_t value) {
    const auto slot = first.slot + static_cast<std::size_t>(offset * kAxisCount + axis_number);
    state_.image[slot] = static_cast<std::uint32_t>(value);
  };
  for (const Shown& each : shown) {
    show(kFirst, each.offset, each.value);
    if (each.offset > 0) show(kFirstWorking, each.offset - 1, each.value);
  }
  show(kept_d(d8x::kRfa), 0, in_32_bits(creep_pps / step));
  show(kept_d(d8x::kPrci), 0, 0);
  show(kept_d(d8x::kRcmp5), 0, settings.raw(kept_d(d8x::kPrcmp5), axis_number));
  show(kept_d(d8x::kRci), 0, 0);
}

}  // namespace understudy::emulator::models::super_40nc
