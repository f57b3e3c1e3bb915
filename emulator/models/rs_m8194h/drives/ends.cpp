// Handles the ends of motions, and their effect on the error code (4.9.2).
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/drives/edges.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/environment.h"
#include "motion/homing.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// Returns true if the axis of a path has itself met this cause, which may also come from another axis.
bool is_its_own(const motion::Axis& motor, motion::Cause cause) {
  const auto is_on = [&](motion::Signal signal) { return (motor.signals & motion::bit(signal)) != 0; };
  switch (cause) {
    case motion::Cause::limit_plus: return is_on(motion::Signal::limit_plus);
    case motion::Cause::limit_minus: return is_on(motion::Signal::limit_minus);
    case motion::Cause::alarm: return is_on(motion::Signal::alarm);
    case motion::Cause::soft_limit_plus:
      return motor.settings.soft_limit_plus && motor.soft_limit_place() > *motor.settings.soft_limit_plus;
    case motion::Cause::soft_limit_minus:
      return motor.settings.soft_limit_minus && motor.soft_limit_place() < *motor.settings.soft_limit_minus;
    case motion::Cause::none:
    case motion::Cause::arrived:
    case motion::Cause::stopped:
    case motion::Cause::comparator:
    case motion::Cause::emergency:
    case motion::Cause::servo_off:
    case motion::Cause::homing_failed: break;
  }
  return true;
}

/// Returns true if a move has sent its last pulse. It may have reached a limit at that pulse.
bool is_complete(const AxisUnit& unit, const motion::Axis& motor) {
  const std::int64_t gone = std::abs(motor.travel_pulses - unit.began_pulses);
  return motor.target_pulses > 0 && gone == motor.target_pulses;
}

}  // namespace

std::uint16_t error_of(motion::Cause cause) {
  switch (cause) {
    case motion::Cause::soft_limit_plus: return bit_of(ErrorBit::soft_limit_plus);
    case motion::Cause::soft_limit_minus: return bit_of(ErrorBit::soft_limit_minus);
    case motion::Cause::limit_plus: return bit_of(ErrorBit::limit_plus);
    case motion::Cause::limit_minus: return bit_of(ErrorBit::limit_minus);
    case motion::Cause::alarm: return bit_of(ErrorBit::alarm);
    case motion::Cause::emergency: return bit_of(ErrorBit::emergency);
    case motion::Cause::none:
    case motion::Cause::arrived:
    case motion::Cause::stopped:
    case motion::Cause::comparator:
    case motion::Cause::servo_off:
    case motion::Cause::homing_failed: break;
  }
  return 0;
}

void Edges::on_homed(std::size_t axis) {
  AxisUnit& unit = chip_.unit(axis);
  interrupts_.note_factor(axis, Factor::homed);
  if (chose(option("home_error_bit", "also_at_home"))) chip_.add_errors(axis, bit_of(ErrorBit::home));
  if (chose(option("home_clears_counters", "zero"))) {
    set_logic_position(unit, chip_.motor(axis), 0, true);
    set_encoder_position(unit, chip_.motor(axis), 0, true);
    set_absolute_position(unit, chip_.motor(axis), 0, true);
    chip_.rearm(axis);
  }
}

/// Returns true for a limit that a choice does not regard as the cause of an end, because the drive ends
/// there anyway.
bool Edges::is_no_cause(motion::Cause cause, bool is_at_its_end) const {
  const bool is_limit = cause == motion::Cause::limit_plus || cause == motion::Cause::limit_minus;
  return is_limit && is_at_its_end && chose(option("limit_at_the_end", "is_complete"));
}

/// Records the errors at the end of the path: the cause of the end, and the earlier obstacles.
void Edges::note_end_of_path(std::size_t axis) {
  AxisUnit& unit = chip_.unit(axis);
  motion::Axis& motor = chip_.motor(axis);
  const std::uint16_t met = std::exchange(unit.met, std::uint16_t{0});
  if (!is_no_cause(motor.cause, streams_.is_complete())) {
    if (is_its_own(motor, motor.cause)) chip_.add_errors(axis, error_of(motor.cause));
    chip_.add_errors(axis, met);
  }
  // The error is recorded only once, because a host may have cleared it before D-END.
  if (motor.cause != motion::Cause::arrived && motor.task == motion::Task::none)
    motor.cause = motion::Cause::stopped;
}

/// Records the cause of an end in the error code. Returns the events that count with the selected options.
motion::Events Edges::on_axis_end(std::size_t axis, motion::Events events) {
  const motion::Axis& motor = chip_.motor(axis);
  AxisUnit& unit = chip_.unit(axis);
  const bool homed = (events & motion::bit(motion::Event::homed)) != 0;
  if (homed) on_homed(axis);
  constexpr motion::Events kConstant =
      motion::bit(motion::Event::constant_started) | motion::bit(motion::Event::constant_ended);
  const bool has_ramps = motor.law.start_speed_u_s < motor.law.top_speed_u_s;
  if (!machine_options().constant_drives_have_c_sta && !has_ramps) {
    events &= static_cast<motion::Events>(~kConstant);
  }
  if ((events & motion::bit(motion::Event::ended)) == 0) return events;
  motion::Cause cause = motor.cause;
  if (cause != motion::Cause::arrived && cause != motion::Cause::stopped)
    drives_.take_off(axis, DiscardEvent::cause);
  if (!machine_options().axis.homing_obeys_soft_limits) chip_.rearm(axis);
  if (!machine_options().d_end_after_stops && cause != motion::Cause::arrived && !homed) {
    events &= static_cast<motion::Events>(~motion::bit(motion::Event::ended));
  }
  if (cause == motion::Cause::homing_failed) {
    cause = motor.homing.ended_by;
    constexpr std::uint8_t kIndexPhase = 20;
    const auto row = static_cast<std::size_t>(motor.homing.ended_in);
    const bool by_index = cause == motion::Cause::homing_failed && motor.homing.ended_in >= 0 &&
                          motor.homing.program.phases[row].code == kIndexPhase;
    if (by_index) chip_.add_errors(axis, bit_of(ErrorBit::home));
  }
  if (chip_.paths().runs != Paths::Runs::nothing && has(chip_.paths().axes, axis)) {
    note_end_of_path(axis);
  } else if (!is_no_cause(cause, is_complete(unit, motor))) {
    chip_.add_errors(axis, error_of(cause));
  }
  return events;
}

}  // namespace understudy::emulator::models::rs_m8194h
