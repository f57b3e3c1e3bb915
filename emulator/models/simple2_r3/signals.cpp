// What limits and alarms do to velocity, PWM and sync mode, by the table in transitions.h. Position moves and
// homing meet them in motion/, by AxisSettings and the homing's own table.
#include <cstddef>

#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/marks.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/transitions.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

/// A signal that has come on or gone, as the axis meets it.
Event event_of(const AxisState& axis, motion::Signal signal, bool on) {
  if (signal == motion::Signal::alarm) return on ? Event::alarm : Event::alarm_gone;
  if (!on) return Event::limit_gone;
  const int side = signal == motion::Signal::limit_plus ? +1 : -1;
  return heading(axis) == -side ? Event::limit_behind : Event::limit_ahead;
}

void meet_in_velocity(AxisState& axis, Outcome outcome) {
  switch (outcome) {
    case Outcome::stops: axis.motor.stop(); return take_off(axis, outcome);
    case Outcome::waits: return halt_velocity(axis);
    case Outcome::slows: return take_off(axis, outcome);
    case Outcome::turns: halt_velocity(axis); return resume_velocity(axis);
    case Outcome::resumes: return resume_velocity(axis);
    case Outcome::goes_on:
    case Outcome::leaves:
    case Outcome::slows_and_waits:
    case Outcome::blocked:
    case Outcome::dropped:
    case Outcome::kept:
    case Outcome::ends:
    case Outcome::begins:
    case Outcome::changes: return;  // slows_and_waits: the limit itself holds it
  }
}

void meet_in_pwm(AxisState& axis, Outcome outcome) {
  take_off(axis, outcome);  // what waits is held by the alarm itself
}

}  // namespace

Outcome Simple2R3::reaction(int axis_number, Event event) const {
  const AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const bool needs_servo = has(transitions::kCommands, event) &&
                           !(has(transitions::kDuties, event) && chose(transitions::kPwmNeedsNoServo));
  const bool is_held = needs_servo && lacks_servo(axis_number);
  const Transition* row =
      reaction_row(activity(axis), is_held ? Phase::servo_off : phase_of(axis, now()), event);
  if (row == nullptr) return Outcome::goes_on;
  for (const OtherOutcome& other : {row->other, row->another}) {
    if (other.is_there && chose(other.chosen)) return other.outcome;
  }
  return row->outcome;
}

void Simple2R3::apply_signals(int axis_number, motion::Signals on) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  if (on == axis.signals.steady) return;
  const auto changed = static_cast<motion::Signals>(on ^ axis.signals.steady);
  axis.signals.steady = on;
  ++axis.signals.version;
  if (axis.mode == Mode::position) return;
  // One after the other: what the first has made of the axis is what the next one meets.
  for (const motion::Signal signal :
       {motion::Signal::alarm, motion::Signal::limit_plus, motion::Signal::limit_minus}) {
    if ((changed & motion::bit(signal)) == 0 || ignores(signal)) continue;
    const Outcome outcome = reaction(axis_number, event_of(axis, signal, (on & motion::bit(signal)) != 0));
    axis.motor.signals = static_cast<motion::Signals>(axis.motor.signals ^ motion::bit(signal));
    switch (axis.mode) {
      case Mode::position: break;
      case Mode::velocity: meet_in_velocity(axis, outcome); break;
      case Mode::pwm: meet_in_pwm(axis, outcome); break;
      case Mode::sync: handle_in_sync(axis_number, outcome); break;
    }
  }
  axis.motor.signals = on;
  // The motor's way is that of its last pulse; before the first one of a new way it must not stop for the old
  // one.
  if (axis.motor.drive.direction != heading(axis)) axis.motor.drive.direction = 0;
}

void Simple2R3::handle_in_sync(int axis_number, Outcome outcome) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  switch (outcome) {
    case Outcome::blocked: return keep_following(axis);
    case Outcome::leaves: return stop_drive(axis);
    case Outcome::resumes:
      if (axis.motor.task != motion::Task::following) begin_following(axis_number);
      return;
    case Outcome::goes_on:
    case Outcome::stops:
    case Outcome::waits:
    case Outcome::turns:
    case Outcome::slows:
    case Outcome::slows_and_waits:
    case Outcome::dropped:
    case Outcome::kept:
    case Outcome::ends:
    case Outcome::begins:
    case Outcome::changes: return;  // waits: the alarm itself stops the motor
  }
}

bool Simple2R3::ignores(motion::Signal signal) const {
  return chose(signal == motion::Signal::alarm ? option("alarm_reaction", "none")
                                               : option("limit_reaction", "none"));
}

void Simple2R3::refresh_signals(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  apply_servo_state(axis_number);
  apply_signals(axis_number, signals_of(axis_number));
  // A homing that goes on has yet to see its edges.
  if (!axis.motor.homing.active()) axis.motor.signals = axis.signals.steady;
}

}  // namespace understudy::emulator::models::simple2_r3
