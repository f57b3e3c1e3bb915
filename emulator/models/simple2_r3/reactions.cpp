#include "emulator/models/simple2_r3/reactions.h"

#include <utility>

#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/marks.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/state.h"
#include "emulator/models/simple2_r3/transitions.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

/// Returns the axis event for a signal that goes on or off.
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
    case Outcome::continues:
    case Outcome::leaves:
    case Outcome::slows_and_waits:
    case Outcome::blocked:
    case Outcome::dropped:
    case Outcome::kept:
    case Outcome::ends:
    case Outcome::begins:
    case Outcome::changes: return;  // slows_and_waits: the limit itself holds the axis
  }
}

void meet_in_pwm(AxisState& axis, Outcome outcome) {
  take_off(axis, outcome);  // the alarm itself holds waiting commands
}

}  // namespace

void AxisReactions::power_up() {
  motion::AxisSettings settings;
  const auto reaction_to = [&](motion::Signal signal) {
    return setup().ignores(signal) ? motion::Reaction::ignore : motion::Reaction::stop_at_once;
  };
  settings.at_limit_plus = settings.at_limit_minus = reaction_to(motion::Signal::limit_plus);
  settings.at_alarm = reaction_to(motion::Signal::alarm);
  settings.needs_servo = servo_matters();
  axis().motor.set(settings);
  axis().motor.servo_on = chose(option("servo_at_power_up", "on"));
}

void AxisReactions::forget_kept() {
  const KeptCommand forgotten = std::exchange(kept(), {});
  if (forgotten.command != Command::none) axis().cut_short = true;  // a line may be waiting for it
}

void AxisReactions::stop(Stopping how) {
  AxisState& axis = this->axis();
  forget_kept();
  if (chose(option("values_after_stop", "zero"))) shared(slots().velocity) = shared(slots().pwm) = 0;
  if (how == Stopping::by_register && reaction(Event::stop) == Outcome::slows) {
    axis.motor.slow_down(now());
    if (axis.motor.moving()) return;
  }
  const Mode mode = axis.mode;
  stop_drive(axis);
  if (mode != Mode::sync && chose(transitions::kModeStays)) axis.mode = mode;
}

void AxisReactions::servo_off() {
  const bool stays = axis().mode == Mode::pwm && reaction(Event::servo_off) == Outcome::continues;
  if (!stays && servo_matters()) stop();
  axis().motor.switch_servo(false);
}

void AxisReactions::begin_following() {
  simple2_r3::follow_encoder(axis(), sync_follower(), followed_count());
  // The axis sends no pulses before its first period begins.
  if (chose(option("sync_period", "every_fifth_tick")))
    axis().motor.follower.phase = static_cast<int>((now() + 1) % kSyncPeriod);
}

void AxisReactions::apply_servo_state() {
  motion::Axis& motor = axis().motor;
  const bool matters = servo_matters();
  if (matters == motor.settings.needs_servo) return;
  motor.settings.needs_servo = matters;
  if (lacks_servo()) stop();
}

void AxisReactions::sample_signals() {
  const bool latches = setup().alarm_latches;
  if (latches) axis().alarm_latched = alarm();
  if (setup().alarm_takes_servo && axis().motor.servo_on && alarm()) servo_off();
  if (!state_.touched && !latches) return;
  apply_servo_state();
  apply_signals(signals().of_motor(number()));
}

/// In position mode, the motor itself follows the table. This records the events that it encounters.
void AxisReactions::note_for_motor(motion::Signals changed, motion::Signals on) const {
  for (const motion::Signal signal :
       {motion::Signal::alarm, motion::Signal::limit_plus, motion::Signal::limit_minus}) {
    const motion::Signals bit = motion::bit(signal);
    if ((changed & bit) == 0 || setup().ignores(signal)) continue;
    const bool is_on = (on & bit) != 0;
    if (((state().motor.signals ^ on) & bit) != 0) {
      (void)reaction(event_of(state(), signal, is_on));
    } else {  // the axis reached the switch during its motion, in the previous tick
      note(is_on ? Phase::moving : Phase::leaving, is_on ? Event::limit_ahead : Event::limit_gone);
    }
  }
}

void AxisReactions::apply_signals(motion::Signals on) {
  AxisState& axis = this->axis();
  if (on == axis.signals.steady) return;
  const auto changed = static_cast<motion::Signals>(on ^ axis.signals.steady);
  if (axis.mode == Mode::position) note_for_motor(changed, on);
  axis.signals.steady = on;
  ++axis.signals.version;
  if (axis.mode == Mode::position) return;
  // The signals take effect one after another, each on the state that the previous signal has left.
  for (const motion::Signal signal :
       {motion::Signal::alarm, motion::Signal::limit_plus, motion::Signal::limit_minus}) {
    if ((changed & motion::bit(signal)) == 0 || setup().ignores(signal)) continue;
    const Outcome outcome = reaction(event_of(axis, signal, (on & motion::bit(signal)) != 0));
    axis.motor.signals = static_cast<motion::Signals>(axis.motor.signals ^ motion::bit(signal));
    switch (axis.mode) {
      case Mode::position: break;
      case Mode::velocity: meet_in_velocity(axis, outcome); break;
      case Mode::pwm: meet_in_pwm(axis, outcome); break;
      case Mode::sync: handle_in_sync(outcome); break;
    }
  }
  axis.motor.signals = on;
  // The motor's direction is that of its last pulse. Before its first pulse in a new direction, it must not
  // stop because of the old direction.
  if (axis.motor.drive.direction != heading(axis)) axis.motor.drive.direction = 0;
}

void AxisReactions::handle_in_sync(Outcome outcome) {
  switch (outcome) {
    case Outcome::blocked: return keep_following(axis());
    case Outcome::leaves: return stop_drive(axis());
    case Outcome::resumes:
      if (axis().motor.task != motion::Task::following) begin_following();
      return;
    case Outcome::continues:
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

void AxisReactions::refresh_signals() {
  apply_servo_state();
  apply_signals(signals().of_motor(number()));
  // A running homing must still detect its edges.
  if (!axis().motor.homing.active()) axis().motor.signals = axis().signals.steady;
}

}  // namespace understudy::emulator::models::simple2_r3
