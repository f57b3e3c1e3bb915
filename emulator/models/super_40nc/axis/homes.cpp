#include "emulator/models/super_40nc/axis/homes.h"

#include <cstdint>

#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "interpreter/super_40nc/error.h"
#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/homing.h"
#include "motion/homing_tables.h"
#include "motion/move.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// The chip's homing modes (PRMD).
constexpr int kModeGoHome = 0x10;
constexpr int kModeGoHomeBack = 0x18;
constexpr int kModeGoToZero = 0x41;

std::int64_t home_pulses(const motion::UnitScale& scale, std::int64_t lu) {
  return scale.to_pulses(lu).value_or(0);
}

}  // namespace

void Homes::start_home(int axis_number, int order) {
  if (starts_.ask(axis_number, Request::home_or_zero) != Grant::starts) return;
  const Settings settings = registers();
  AxisState& state = axis(axis_number);
  const auto rpm = [&](StoredRegister kept) { return static_cast<double>(settings.of(kept, axis_number)); };
  const int mode = static_cast<int>(settings.of(stored_x(d9x::kHomeMode), axis_number));
  const int direction = settings.is_on(stored_x(d9x::kHomeDirection), axis_number) ? -1 : +1;
  state.homed = false;
  state.order = static_cast<std::int8_t>(order);
  const bool is_by_limit = motion::super40nc_homes_by_limit(mode);
  const bool lacks_limit = inputs_.limit_logic(axis_number, direction) == 0 &&
                           !chose(option("home_without_limit", "runs_until_it_is_stopped"));
  if (is_by_limit && lacks_limit) {
    return home_fails(axis_number);
  }
  starts_.prepare(axis_number, true);
  // With X25 = 0, the axis never leaves a DOG that is ON.
  if (!is_by_limit && has_signal(axis_number, motion::Signal::home) &&
      settings.of(stored_x(d9x::kMoveOff), axis_number) == 0 &&
      chose(option("home_leave_0", "the_search_fails"))) {
    return home_fails(axis_number);
  }
  const motion::Signal ahead = direction > 0 ? motion::Signal::limit_plus : motion::Signal::limit_minus;
  if (is_by_limit && has_signal(axis_number, ahead) && chose(option("home_on_its_limit", "fails"))) {
    return home_fails(axis_number);
  }
  const bool limit_stops_at_once =
      chose(option("home_el_stop", "by_d9x01")) && !settings.is_on(stored_x(d9x::kOtStop), axis_number);
  const motion::SpeedLaw fast = settings.law(axis_number, rpm(stored_x(d9x::kHomeSpeed)));
  const motion::HomingProgram program = motion::super40nc_homing(
      {.mode = mode,
       .direction = direction,
       .fast = fast,
       .creep = settings.law(axis_number, rpm(stored_x(d9x::kCreepSpeed))),
       .index_count = static_cast<std::int32_t>(settings.of(stored_x(d9x::kCNumber), axis_number) + 1),
       .leave_pulses = settings.of(stored_x(d9x::kMoveOff), axis_number),
       .offset_pulses =
           home_pulses(settings.scale(axis_number), settings.of(stored_x(d9x::kHomeOffset), axis_number)),
       .limit_stops_at_once = limit_stops_at_once,
       .leaves_fast = chose(option("home_leave_speed", "home_speed")),
       .offset_creeps = chose(option("home_offset_speed", "creep")),
       .plate_may_be_short = chose(option("home_short_plate", "goes_on_all_the_same")),
       .turns_at_limit = chose(option("home_meets_limit", "turns_round_and_passes_the_dog"))});
  if (chip(axis_number).home(program, before_motion()) != motion::Cause::none) {
    return home_fails(axis_number);
  }
  starts_.begun(axis_number, motion::Cause::none, Activity::home);
  starts_.mirror_start(axis_number, direction < 0 ? kModeGoHomeBack : kModeGoHome, 0, fast);
}

void Homes::home_fails(int axis_number) {
  home_ended(axis_number, false, Code::home_failed);
  starts_.let_go(axis_number);
}

void Homes::zero_failed(int axis_number) {
  if (axis(axis_number).order != 0) axes_.zeroing_by_key.has_failed = true;
}

void Homes::start_zero(int axis_number, int order) {
  if (starts_.ask(axis_number, Request::home_or_zero) != Grant::starts) return;
  const Settings settings = registers();
  AxisState& state = axis(axis_number);
  state.zeroed = false;
  starts_.prepare(axis_number);
  const std::int64_t distance =
      home_pulses(settings.scale(axis_number), -state.offset_lu) - machine_pulses(axis_number);
  const motion::SpeedLaw law =
      settings.law(axis_number, static_cast<double>(settings.of(stored_x(d9x::kZeroSpeed), axis_number)));
  starts_.begun(axis_number, chip(axis_number).move(distance, law, before_motion()), Activity::zero);
  if (state.holder != Activity::zero) {
    axes_.zeroing_by_key.has_failed = axes_.zeroing_by_key.has_failed || order != 0;
    return;
  }
  state.order = static_cast<std::int8_t>(order);
  starts_.mirror_start(axis_number, kModeGoToZero, distance, law);
  if (distance != 0) return;
  starts_.let_go(axis_number);
  state.zeroed = state.has_ended = true;
}

void Homes::home_ended(int axis_number, bool found, Code code) {
  AxisState& state = axis(axis_number);
  const Settings settings = registers();
  const bool ends_contact = chose(option("edge_contacts_fall", "m8x05_behind_its_search"));
  if (ends_contact) ground_.set_contact(of_axis(m8x::kHome, axis_number), false);
  if (!found) {
    if (code != Code::none) starts_.fail(axis_number, code);
    if (state.order != 0) axes_.homing_by_key.has_failed = true;
    return;
  }
  state.homed = true;
  if (settings.is_on(stored_x(d9x::kHomeErc), axis_number)) pins_.give_erc(axis_number);
  const std::int32_t cleared = settings.raw(stored_x(d9x::kHomeResetC), axis_number);
  const std::int64_t home_lu = settings.of(stored_x(d9x::kHomePosition), axis_number);
  const motion::UnitScale scale = settings.scale(axis_number);
  if ((cleared & 1) != 0) {
    parameters_.set_counter(axis_number, 0, static_cast<std::int32_t>(home_pulses(scale, home_lu)));
    state.offset_lu = 0;
  } else if (!chose(option("home_keeps_counter1", "the_display_stays"))) {
    parameters_.set_work_lu(axis_number, home_lu);
  }
  state.clears = static_cast<std::uint8_t>(cleared & 0xE);
}

}  // namespace understudy::emulator::models::super_40nc
