#include "emulator/models/super_40nc/path/moves.h"

#include <cstddef>
#include <cstdint>
#include <optional>

#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/path/manual_motions.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "interpreter/super_40nc/error.h"
#include "motion/axis.h"
#include "motion/homing.h"
#include "motion/move.h"

namespace understudy::emulator::models::super_40nc {

void Moves::stop_axis(int axis_number, Code code) {
  AxisState& state = axis(axis_number);
  if (state.holder == Activity::nobody) return;
  if (is_on_path(axis_number)) return paths_.stop_path();
  const Activity held = state.holder;
  chip(axis_number).stop();
  chip(axis_number).homing.phase = -1;
  forget_end(axis_number);
  state.has_ended = true;
  if (held == Activity::home) {
    parts_.homes.home_ended(axis_number, false, code);
  } else if (held == Activity::zero) {
    parts_.homes.zero_failed(axis_number);
  }
  parts_.starts.let_go(axis_number);
}

bool Moves::end_by_ramp(int axis_number, Mover mover) {
  AxisState& state = axis(axis_number);
  if (state.holder == Activity::nobody) return false;
  if (state.holder == Activity::rest || state.holder == Activity::wheel || is_on_path(axis_number)) {
    if (is_on_path(axis_number)) {
      paths_.slow_path();
    } else {
      stop_axis(axis_number);
      return false;
    }
  } else {
    chip(axis_number).slow_down(now());
  }
  state.is_held = false;
  state.stop_awaited_by = mover;
  return true;
}

void Moves::stop_by_command(int axis_number) {
  note_request(axis(axis_number).holder, Request::stop);
  if (!chose(option("stp_stops", "by_its_ramp")) || (is_on_path(axis_number) && axes_.path_is_held)) {
    return stop_axis(axis_number);
  }
  if (!end_by_ramp(axis_number, Mover::hand)) return;
  for (int number = 0; number < kAxisCount; ++number) {
    if (number != axis_number && !(is_on_path(axis_number) && is_on_path(number))) continue;
    axis(number).mover = Mover::hand;
    axis(number).awaited = axis(number).shows_finish = false;
  }
}

void Moves::stop_all_of(Mover mover) {
  for (int number = 0; number < kAxisCount; ++number) {
    if (axis(number).mover == mover) stop_axis(number);
  }
}

void Moves::break_program(Mover mover, int but_for) {
  for (int number = 0; number < kAxisCount; ++number) {
    AxisState& state = axis(number);
    if (number == but_for || state.mover != mover || state.holder == Activity::nobody ||
        state.holder == Activity::wheel) {
      continue;
    }
    const bool ramp = registers().is_on(stored_x(d9x::kOtStop), number) && state.holder != Activity::rest;
    state.is_held = state.awaited = state.shows_finish = false;
    if (ramp) {
      chip(number).slow_down(now());
    } else {
      stop_axis(number);
    }
  }
}

std::optional<Broken> Moves::ended(int axis_number) {
  AxisState& state = axis(axis_number);
  const motion::Axis& motor = chip(axis_number);
  const Activity held = state.holder;
  const motion::Cause why = motor.cause;
  state.has_ended = true;
  if (held == Activity::nobody || held == Activity::rest) return std::nullopt;
  const bool has_found = (motor.events & motion::bit(motion::Event::homed)) != 0;
  // The result of the last search or mark counts, however it ended, until the next one ends.
  const bool is_stopped = why == motion::Cause::stopped;
  if (state.is_held && is_stopped && !has_found) {
    rest_axis(axis_number);
    return std::nullopt;
  }
  if (held == Activity::wheel) {
    parts_.wheel.wheel_ended(axis_number);
    return std::nullopt;
  }

  const Mover mover = state.mover;
  const bool is_awaited = state.awaited;
  Code code = code_of(why);
  if (held == Activity::home) {
    if (!has_found && !is_stopped) code = Code::home_failed;
    parts_.homes.home_ended(axis_number, has_found, code);
  } else if (code != Code::none) {
    parts_.starts.fail(axis_number, code);
  }
  if (held == Activity::zero) {
    state.zeroed = why == motion::Cause::arrived;
    if (!state.zeroed) parts_.homes.zero_failed(axis_number);
  }
  const bool has_arrived = held == Activity::move && code == Code::none && (has_found || !is_stopped);
  const bool is_at_target = has_arrived && state.rest.kind == RestKind::move;
  const bool shows_finish = has_arrived && state.shows_finish;
  parts_.starts.let_go(axis_number);
  state.stands_on_target = is_at_target && distance_to(axis_number, state.target_lu) == 0;
  if (shows_finish) ground_.show_finished(static_cast<std::size_t>(axis_number));
  const bool continues = held == Activity::home && chose(option("home_failure", "the_program_goes_on"));
  if (code == Code::none || mover >= Mover::plc || continues) return std::nullopt;
  return Broken{.mover = mover, .axis = axis_number, .is_awaited = is_awaited, .why = why};
}

void Moves::hold_axis(int axis_number) {
  AxisState& state = axis(axis_number);
  if (state.holder == Activity::wheel || state.holder == Activity::rest) return;
  if (state.holder == Activity::vdrv && chose(option("pause_scope", "not_vdrv_nor_the_wheel"))) return;
  if (state.holder == Activity::home && chose(option("pause_home", "the_search_ends_first"))) return;
  motion::Axis& motor = chip(axis_number);
  if (state.rest.kind == RestKind::mark && motor.homing.active()) {
    const motion::HomingPhase& row = motor.homing.row();
    const bool searches = row.does == motion::HomingPhase::Does::search;
    state.rest.travel =
        motor.homing.began_pulses + (searches ? row.direction * row.within_pulses : row.distance_pulses);
    state.rest.searches = searches;
  }
  if (state.holder == Activity::home) state.rest = {.kind = RestKind::home};
  state.is_held = true;
  motor.slow_down(now());
}

/// Called when a held axis has stopped. It waits at that place.
void Moves::rest_axis(int axis_number) {
  AxisState& state = axis(axis_number);
  if (state.rest.kind == RestKind::mark) {
    const std::int64_t left = state.rest.travel - chip(axis_number).travel_pulses;
    const std::int64_t search = search_pulses(axis_number);
    state.rest.distance = state.rest.searches ? 0 : left;
    state.rest.search = state.rest.searches ? left : search;
  }
  state.holder = Activity::rest;
}

std::optional<Broken> Moves::resume_axis(int axis_number) {
  AxisState& state = axis(axis_number);
  motion::Axis& motor = chip(axis_number);
  if (!state.is_held) return std::nullopt;
  state.is_held = false;
  if (state.holder != Activity::rest && state.rest.kind != RestKind::home &&
      state.rest.kind != RestKind::mark && motor.resume(motor.law, now())) {
    return std::nullopt;
  }
  if (state.holder != Activity::rest) rest_axis(axis_number);
  motor.stop();
  forget_end(axis_number);
  const Rest rest = state.rest;
  const Mover mover = state.mover;
  const bool is_awaited = state.awaited;
  const std::int64_t target_lu = state.target_lu;
  const motion::SpeedLaw law = motor.law;
  state.holder = Activity::nobody;
  switch (rest.kind) {
    case RestKind::none:
    case RestKind::path: break;
    case RestKind::move: {
      const std::int64_t distance = rest.travel - motor.travel_pulses;
      parts_.starts.prepare(axis_number);
      parts_.starts.begun(axis_number, motor.move(distance, law, before_motion()), Activity::move);
      if (state.holder != Activity::move) break;
      state.rest = rest;
      state.target_lu = target_lu;
      state.shows_finish = true;
      if (distance != 0) break;
      parts_.starts.let_go(axis_number);
      state.has_ended = state.stands_on_target = true;
      ground_.show_finished(static_cast<std::size_t>(axis_number));
      return std::nullopt;
    }
    case RestKind::mark:
      if (rest.search != 0)
        parts_.drives.begin_mark(axis_number, rest.distance, rest.search, rest.rpm, mover);
      break;
    case RestKind::turning: parts_.drives.begin_turning(axis_number, rest.rpm, mover); break;
    case RestKind::home: parts_.homes.start_home(axis_number); break;
  }
  if (state.holder == Activity::nobody) return cannot_resume(axis_number, rest, mover, is_awaited);
  state.mover = mover;
  state.awaited = is_awaited;
  return std::nullopt;
}

/// Resets the program, as if the axis had encountered its present signals during the motion.
std::optional<Broken> Moves::cannot_resume(int axis_number, const Rest& rest, Mover mover, bool is_awaited) {
  const motion::Axis& motor = chip(axis_number);
  parts_.starts.let_go(axis_number);
  const bool is_void = rest.kind == RestKind::mark && rest.search == 0;
  const bool may_fail = rest.kind == RestKind::home && chose(option("home_failure", "the_program_goes_on"));
  if (mover >= Mover::plc || is_void || may_fail) return std::nullopt;
  motion::Cause why = parts_.starts.blocked_both_ways(axis_number);
  if (why == motion::Cause::none) {
    const std::int64_t ahead = rest.kind == RestKind::turning ? rest.rpm
                               : rest.kind == RestKind::move  ? rest.travel - motor.travel_pulses
                               : rest.distance != 0           ? rest.distance
                                                              : rest.search;
    why = rest.kind == RestKind::home ? motion::Cause::homing_failed : motor.forbidden(direction_of(ahead));
  }
  return Broken{.mover = mover, .axis = axis_number, .is_awaited = is_awaited, .why = why};
}

std::optional<ManualMotion> Moves::manual_motion(int axis_number) const {
  const AxisState& state = axis(axis_number);
  const bool is_by_order = state.order != 0;
  const bool is_behind_end = state.mover < Mover::plc && !state.awaited;
  if (state.mover < Mover::plc && state.awaited) return std::nullopt;
  switch (state.holder) {
    case Activity::nobody:
    case Activity::rest: return std::nullopt;
    case Activity::jog: return state.asked_by_plc ? ManualMotion::plc_jog : ManualMotion::jog;
    case Activity::home: return is_by_order ? ManualMotion::home_by_order : ManualMotion::home;
    case Activity::zero: return is_by_order ? ManualMotion::zero_by_order : ManualMotion::zero;
    case Activity::move:
    case Activity::vdrv:
    case Activity::wheel: break;
  }
  if (is_behind_end)
    return state.mover == Mover::c ? ManualMotion::behind_end_of_c : ManualMotion::behind_end;
  if (state.holder != Activity::wheel) return ManualMotion::plc_drive;
  return state.wheel == WheelSource::selector ? ManualMotion::selected_wheel : ManualMotion::wheel;
}

void Moves::handle(int axis, ManualEvent event, Code code) {
  const std::optional<ManualMotion> motion = manual_motion(axis);
  if (motion) handle(axis, *motion, event, code);
}

/// Applies the table in manual_motions.h.
void Moves::handle(int axis, ManualMotion motion, ManualEvent event, Code code) {
  switch (answer_of(motion, event)) {
    case ManualAnswer::continues: break;
    case ManualAnswer::slows:
      parts_.jogs.release_jog(
          axis, motion == ManualMotion::plc_jog ? &AxisState::asked_by_plc : &AxisState::asked_by_contact);
      break;
    case ManualAnswer::ends: {
      const bool is_stopped =
          event == ManualEvent::stop || event == ManualEvent::stop_of_c || event == ManualEvent::main_stop;
      is_stopped ? stop_by_command(axis) : stop_axis(axis, code);
      break;
    }
  }
}

}  // namespace understudy::emulator::models::super_40nc
