#include "emulator/models/rs_m8194h/drives/drives.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/drives/transition_tables.h"
#include "emulator/models/rs_m8194h/drives/transitions.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "motion/axis.h"
#include "motion/homing.h"
#include "motion/homing_tables.h"
#include "motion/move.h"
#include "motion/pulse_drive.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

int direction_of_step(std::uint8_t step) { return step == 1 ? +1 : step == 2 ? -1 : 0; }

/// Options about homing that the manual leaves open.
struct HomingOptions {
  bool fails_at_limit_in_step_1 = false;
  bool limit_is_near_home = false;
  bool turns_at_soft_limits = false;
};

motion::HomingProgram homing_of(const AxisUnit& unit, const SpeedRules& rules, const HomingOptions& options) {
  motion::Rsm8194hHoming how;
  for (std::size_t i = 0; i < how.directions.size(); ++i)
    how.directions[i] = direction_of_step(unit.homing.steps[i]);
  how.drive = law_of(unit, rules);
  how.home = law_at(unit, unit.homing.home_pps, rules);
  how.offset_pulses = unit.homing.offset_pulses;
  how.limit_is_home = unit.homing.limit_is_home;
  how.limit_is_near_home = unit.homing.limit_is_home && options.limit_is_near_home;
  how.soft_limits_lead_on = options.turns_at_soft_limits;
  motion::HomingProgram program = motion::rsm8194h_homing(how);
  const bool has_step_1 = how.directions[0] != 0;
  if (has_step_1 && options.fails_at_limit_in_step_1) program.phases[0].if_limit = motion::HomingPhase::kFail;
  return program;
}

}  // namespace

Took Drives::drive(AxisMask axes, const Drive& what) {
  AxisMask taken = 0;
  for (std::size_t a = 0; a < kAxes; ++a) {
    const bool may = has(axes, a) && may_start(a, Starter::command) == Start::waits;
    if (may && takes_place_of_endless(a, what)) taken |= mask_of(a);
  }
  axes &= static_cast<AxisMask>(~taken);
  // If this option is selected, each axis starts separately: an axis that is still moving holds the drive and
  // starts it after it has stopped.
  const bool is_each_its_own = chose(option("mask_drive", "axis_by_axis")) && (axes & (axes - 1)) != 0;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    const Start mine = may_start(a, Starter::command);
    const bool takes_it_along =
        mine == Start::waits && is_each_its_own && chip_.unit(a).held_drive.what == Drive::What::none;
    if (takes_it_along) continue;
    if (mine == Start::waits || (mine == Start::is_held && waits_behind_held(mask_of(a)))) return Took::waits;
  }
  if (chose(option("mask_drive", "is_void_if_one_is"))) {
    for (std::size_t a = 0; a < kAxes; ++a) {
      if (!has(axes, a) || may_start(a, Starter::command) != Start::is_void) continue;
      note_obstacles(axes);
      return Took::done;
    }
  }
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    switch (may_start(a, Starter::command)) {
      case Start::starts: start(a, what); break;
      case Start::is_void: note_obstacles(mask_of(a)); break;
      case Start::is_held:
        // Depending on a choice, the later drive replaces the held drive of this axis, or is dropped.
        if (keeps_first_held(mask_of(a))) break;
        chip_.unit(a).held_drive = what;
        if (has(streams_.axes_of_held(), a)) streams_.drop_held();
        break;
      case Start::waits: chip_.unit(a).held_drive = what; break;  // starts after the stop
    }
  }
  return Took::done;
}

/// Returns true if a choice makes a second CONTINUE_MOVE replace the first one and continue at its speed.
/// Otherwise, it waits for a stop.
bool Drives::takes_place_of_endless(std::size_t axis, const Drive& what) {
  motion::Axis& motor = chip_.motor(axis);
  const bool is_again = what.what == Drive::What::endless && chip_.activity(axis) == Activity::single &&
                        motor.task == motion::Task::endless;
  if (!is_again || !chose(option("continue_move_again", "takes_its_place"))) return false;
  const bool is_same_direction =
      !motor.slowing && what.value != 0 && (what.value < 0) == (motor.drive.direction < 0);
  if (is_same_direction) {
    AxisUnit& unit = chip_.unit(axis);
    const auto drive_pps = static_cast<std::uint32_t>(std::abs(std::int64_t{what.value}));
    if (chose(option("continue_move_speed", "yes"))) unit.speed.drive_pps = drive_pps;
    motor.change_speed(law_at(unit, drive_pps, machine_options().speed), now());
  } else {
    motor.slow_down(now());
    chip_.unit(axis).held_drive = what;
  }
  return true;
}

void Drives::start(std::size_t axis, const Drive& what, bool without_ramps) {
  AxisUnit& unit = chip_.unit(axis);
  motion::Axis& motor = chip_.motor(axis);
  streams_.on_single_drive(axis);
  take_off(axis, DiscardEvent::other_drive);
  unit.began_pulses = motor.travel_pulses;
  // A command reads the pins as they are now.
  motor.signals = chip_.environment(axis).at(motor.travel_pulses, motor.signals);
  std::int64_t distance = what.value;
  if (what.what == Drive::What::absolute) distance -= absolute_count(unit, motor);
  if (what.what != Drive::What::home && distance == 0) return;
  if (lacks_speed(axis, what.what)) return;
  motion::SpeedLaw law = chip_.law_of(axis);
  if (what.what == Drive::What::endless) {
    const auto drive_pps = static_cast<std::uint32_t>(std::abs(distance));
    law = law_at(unit, drive_pps, machine_options().speed);
    if (chose(option("continue_move_speed", "yes"))) unit.speed.drive_pps = drive_pps;
  }
  if (without_ramps) law.start_speed_u_s = law.top_speed_u_s;
  if (what.what == Drive::What::scan && scans_.is_too_fast(axis, law)) return;
  const int direction = distance < 0 ? -1 : +1;
  motion::Cause refused = motion::Cause::none;
  if (what.what == Drive::What::home) {
    const HomingOptions options{.fails_at_limit_in_step_1 = chose(option("home_step_1_limit", "fails")),
                                .limit_is_near_home = chose(option("home_limit", "home_and_near_home")),
                                .turns_at_soft_limits = chose(option("home_soft_limit", "turns_round"))};
    refused = motor.home(homing_of(unit, machine_options().speed, options), now());
  } else if (what.what == Drive::What::endless) {
    refused = motor.run(direction, law, now());
  } else {
    refused = motor.move(distance, law, now());
  }
  if (refused != motion::Cause::none) {
    // Homing fails at once if its index is on already.
    chip_.add_errors(axis,
                     refused == motion::Cause::homing_failed ? bit_of(ErrorBit::home) : error_of(refused));
    return;
  }
  forget_errors(axis);
  if (motor.homing.active() && !machine_options().axis.homing_obeys_soft_limits) chip_.rearm(axis);
  if (what.what == Drive::What::scan) scans_.begin(axis, distance);
}

void Drives::start_held() {
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = chip_.unit(a);
    if (unit.held_drive.what == Drive::What::none || unit.held) continue;
    const Start outcome = may_start(a, Starter::command);
    if (outcome == Start::waits) continue;
    const Drive what = std::exchange(unit.held_drive, Drive{});
    if (outcome == Start::starts) {
      start(a, what);
    } else {
      note_obstacles(mask_of(a));
    }
  }
}

void Drives::change_speed(std::size_t axis, motion::Instant at) {
  const AxisUnit& unit = chip_.unit(axis);
  const bool keeps_its_own =
      kNormalShapes[unit.speed.mode].s_curve && chose(option("speed_change_in_s", "the_next_drive"));
  if (chip_.activity(axis) != Activity::single || keeps_its_own) return;
  motion::Axis& motor = chip_.motor(axis);
  // The drive keeps its ramps.
  motion::SpeedLaw law = motor.law;
  const double wanted = chip_.law_of(axis).top_speed_u_s;
  law.start_speed_u_s = std::min(law.start_speed_u_s, wanted);
  law.top_speed_u_s = wanted;
  motor.change_speed(law, at);
  if (chip_.unit(axis).external_free_ns != 0) {
    const double left_s = motor.drive.profile.duration_s - motor.drive.elapsed_s(at);
    const auto at_ns = time_of(at.tick).count() + static_cast<std::int64_t>(at.after_s * 1e9);
    chip_.unit(axis).external_free_ns = after(at_ns, left_s);
  }
}

/// Records which marks of the axis the event affects.
void Drives::note_marks(std::size_t axis, DiscardEvent event) const {
  const AxisUnit& unit = chip_.unit(axis);
  const bool is_external =
      unit.external.running != 0 || unit.external_waiting != 0 || unit.external_free_ns != 0;
  const bool is_held =
      std::ranges::any_of(state_.trigger_holds, [&](AxisMask held) { return has(held, axis); });
  const auto meet = [&](Mark mark, bool is_present) {
    if (!is_present) return;
    decisions().meet(kDiscardTable, static_cast<std::size_t>(mark), static_cast<std::size_t>(event));
  };
  meet(Mark::paused_drive, unit.paused_drive.what != Drive::What::none);
  meet(Mark::external_drive, is_external);
  meet(Mark::trigger_hold, is_held);
}

void Drives::take_off(std::size_t axis, DiscardEvent event) {
  AxisUnit& unit = chip_.unit(axis);
  note_marks(axis, event);
  if (takes_off(event, Mark::paused_drive)) unit.paused_drive = {};
  if (takes_off(event, Mark::external_drive)) {
    unit.external.running = 0;
    unit.external_waiting = unit.external_free_ns = 0;
  }
  if (!takes_off(event, Mark::trigger_hold)) return;
  for (AxisMask& held : state_.trigger_holds) held &= static_cast<AxisMask>(~mask_of(axis));
}

void Drives::forget_errors(std::size_t axis) {
  if (chose(option("error_bits_end", "nothing"))) return;
  chip_.unit(axis).error_code &= static_cast<std::uint16_t>(~kClearedByDrive);
}

void Drives::check_paused(std::size_t axis) {
  AxisUnit& unit = chip_.unit(axis);
  const motion::Axis& motor = chip_.motor(axis);
  const bool is_endless = unit.paused_drive.what == Drive::What::endless;
  const std::int64_t rest =
      is_endless ? unit.paused_drive.value : unit.paused_to_pulses - motor.travel_pulses;
  const motion::Cause why = rest == 0 ? motor.forbidden_anywhere() : motor.forbidden(rest < 0 ? -1 : +1);
  if (why == motion::Cause::none) return;
  chip_.add_errors(axis, error_of(why));
  take_off(axis, DiscardEvent::cause);
}

}  // namespace understudy::emulator::models::rs_m8194h
