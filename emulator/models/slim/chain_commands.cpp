// Commands of one module.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain.h"
#include "emulator/models/slim/module.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/rules/pauses.h"
#include "motion/axis.h"
#include "motion/move.h"

namespace understudy::emulator::models::slim {

namespace {

constexpr std::int32_t kMaxThrust = 20'000;

bool is_module(int module) { return module >= 0 && module < kModules; }

}  // namespace

Chain::Chain(const ChainOptions& options) : options_(options) {
  modules_[0].linked = true;
  for (motion::Axis& axis : axes_) axis.switch_servo(has_servo_at_power_up());
}

Error Chain::refusal(int module) const {
  return is_module(module) && modules_[at(module)].linked ? Error::none : Error::not_linked;
}

Error Chain::refusal_of_motion(int module, InPause what) const {
  if (const Error why = refusal(module); why != Error::none) return why;
  const PauseResult result = pause_result(options_, pauses_of(module), what);
  if (result.outcome == PauseOutcome::is_refused) return Error::paused;
  return servo_expected(module) ? Error::none : Error::servo_off;
}

bool Chain::mapped(int module) const {
  for (const std::int8_t mine : map_) {
    if (mine == module) return true;
  }
  return false;
}

Error Chain::refusal_by_number(int module, InPause what) const {
  if (const Error why = refusal(module); why != Error::none) return why;
  if (module != 0 && mapped(module)) return Error::axis;
  return refusal_of_motion(module, what);
}

Error Chain::refusal_of_jog(int module) const {
  const Error why = reserves_moves_only() ? refusal_of_motion(module, InPause::jog)
                                          : refusal_by_number(module, InPause::jog);
  if (why != Error::none) return why;
  const Activity activity = modules_[at(module)].activity;
  if (!busy(module) || activity == Activity::jog || activity == Activity::thrust) return Error::none;
  if (!options_.chose(option("jog_while_moving", "ends_the_move"))) return Error::not_allowed;
  // An HON that still waits would be given up, too.
  return axes_[at(module)].servo_on ? Error::none : Error::servo_off;
}

bool Chain::servo_expected(int module) const {
  const auto& fifo = modules_[at(module)].fifo;
  for (std::size_t i = fifo.size(); i-- > 0;) {
    if (fifo[i].kind == Job::Kind::servo) return fifo[i].servo_on;
  }
  return axes_[at(module)].servo_on;
}

double Chain::end_expected(int module) const {
  const Module& mine = modules_[at(module)];
  for (std::size_t i = mine.fifo.size(); i-- > 0;) {
    const Job& job = mine.fifo[i];
    if (!job.moves() && job.kind != Job::Kind::set_coordinate) continue;
    return job.ends[at(job.letter_of(module))];
  }
  return mine.activity == Activity::idle ? mine.place_units : coordinate(module);
}

bool Chain::full(int module) const {
  return modules_[at(module)].fifo.size() >=
         static_cast<std::size_t>(options_.number(numbers("buffer_length")));
}

Error Chain::enqueue(Job job) {
  for (const std::int8_t module : job.module_of) {
    if (module >= 0 && full(module)) return Error::buffer_full;
  }
  for (const std::int8_t module : job.module_of) {
    if (module < 0 || !options_.chose(option("thrust_end", "a_move_too")) || !job.moves()) continue;
    if (modules_[at(module)].activity == Activity::thrust) stop_jog(module);
  }
  job.number = ++last_number_;
  for (const std::int8_t module : job.module_of) {
    if (module >= 0) modules_[at(module)].fifo.push(job);
  }
  serve(now_ + 1);
  return Error::none;
}

Error Chain::enqueue_move(int module, bool absolute, double units) {
  Job job{.kind = Job::Kind::move, .absolute = absolute};
  job.module_of[0] = static_cast<std::int8_t>(module);
  job.units[0] = units;
  job.ends[0] = absolute ? units : end_expected(module) + units;
  if (!modules_[at(module)].reaches(job.ends[0])) return Error::range;
  return enqueue(job);
}

Error Chain::move(int module, bool absolute, double units) {
  if (const Error why = refusal_by_number(module); why != Error::none) return why;
  return enqueue_move(module, absolute, units);
}

Error Chain::move_axis(Letter letter, bool absolute, double units) {
  const int module = map_[static_cast<std::size_t>(letter)];
  if (module < 0) return Error::axis;
  if (const Error why = refusal_of_motion(module); why != Error::none) return why;
  return enqueue_move(module, absolute, units);
}

Error Chain::home(int module) {
  const Error why = reserves_moves_only() ? refusal_of_motion(module) : refusal_by_number(module);
  if (why != Error::none) return why;
  Job job{.kind = Job::Kind::home};
  job.module_of[0] = static_cast<std::int8_t>(module);
  return enqueue(job);
}

Error Chain::set_coordinate(int module, double units) {
  if (const Error why = refusal(module); why != Error::none) return why;
  if (!modules_[at(module)].reaches(units)) return Error::range;
  if (options_.chose(option("coordinate_in_motion", "error_3")) && busy(module)) return Error::not_allowed;
  Job job{.kind = Job::Kind::set_coordinate};
  job.module_of[0] = static_cast<std::int8_t>(module);
  job.units[0] = job.ends[0] = units;
  return enqueue(job);
}

// ---- Jogs and thrust

Error Chain::jog(int module, int direction) {
  if (direction == 0) {
    if (const Error why = refusal(module); why != Error::none) return why;
    stop_jog(module);
    serve(now_ + 1);
    return Error::none;
  }
  return replace_jog(module, direction < 0 ? -1 : +1, 0);
}

Error Chain::thrust(int module, std::int32_t force) {
  if (force < 1 || force > kMaxThrust) return Error::range;
  return replace_jog(module, 0, force);
}

/// A jog in `direction`, or thrust if that is 0.
Error Chain::replace_jog(int module, int direction, std::int32_t force) {
  if (const Error why = refusal_of_jog(module); why != Error::none) return why;
  const Module& mine = modules_[at(module)];
  const bool gives_up = mine.activity != Activity::jog && mine.activity != Activity::thrust;
  if (gives_up) {
    slow_for_discard(module);  // no matter where there is nothing to give up
    forget_queue(module);
  }
  order_jog(module, direction, force);
  if (gives_up) serve(now_ + 1);  // what waited in other FIFOs for a command that is gone
  return Error::none;
}

/// Like the above, if nothing is abandoned for it: it replaces another one, or follows what stops.
void Chain::order_jog(int module, int direction, std::int32_t force) {
  Module& mine = modules_[at(module)];
  motion::Axis& axis = axes_[at(module)];
  if (mine.activity != Activity::jog && mine.activity != Activity::thrust) {
    mine.next_jog_direction = static_cast<std::int8_t>(direction);
    mine.next_thrust = force;
    if (mine.activity == Activity::idle) begin_next(module, now_ + 1);
    return;
  }
  if (mine.activity == Activity::thrust && direction == 0 && !axis.slowing) {
    mine.thrust = force;
    return;
  }
  const bool stands = mine.starved || axis.task == motion::Task::hanging;
  const motion::SpeedLaw law = mine.jog_law(options_);
  if (mine.activity == Activity::jog && direction == mine.jog_direction &&
      (stands || law.top_speed_u_s > 0)) {
    mine.next_jog_direction = 0;
    mine.next_thrust = 0;
    if (stands) return;
    if (!axis.resume(law, now_)) axis.change_speed(law, now_);
    return;
  }
  mine.next_jog_direction = static_cast<std::int8_t>(direction);
  mine.next_thrust = force;
  mine.starved = false;
  axis.slow_down(now_);
  after_motion(module, now_ + 1);
}

void Chain::begin_jog(int module, int direction, Tick begin_at) {
  Module& mine = modules_[at(module)];
  mine.activity = Activity::jog;
  mine.jog_direction = static_cast<std::int8_t>(direction);
  mine.next_jog_direction = 0;
  mine.next_thrust = mine.thrust = 0;
  mine.starved = false;
  const int pulse_direction = mine.settings.jog_speed < 0 ? -direction : direction;
  if (mine.settings.jog_speed == 0) {
    axes_[at(module)].move_at_zero_speed(pulse_direction);
  } else if (mine.jog_law(options_).top_speed_u_s == 0) {
    mine.starved = true;
  } else {
    axes_[at(module)].run(pulse_direction, mine.jog_law(options_), begin_at - 1);
  }
}

void Chain::begin_thrust(int module, std::int32_t force, Tick begin_at) {
  Module& mine = modules_[at(module)];
  if (thrust_runs()) begin_jog(module, +1, begin_at);
  // Also where there is no speed to run at.
  if (!axes_[at(module)].moving()) axes_[at(module)].move_at_zero_speed(+1);
  mine.starved = false;
  mine.activity = Activity::thrust;
  mine.jog_direction = mine.next_jog_direction = 0;
  mine.next_thrust = 0;
  mine.thrust = force;
}

/// What is to follow when the module has stopped.
void Chain::begin_next(int module, Tick begin_at) {
  const Module& mine = modules_[at(module)];
  if (mine.next_thrust != 0) {
    begin_thrust(module, mine.next_thrust, begin_at);
  } else if (mine.next_jog_direction != 0) {
    begin_jog(module, mine.next_jog_direction, begin_at);
  }
}

void Chain::stop_jog(int module) {
  Module& mine = modules_[at(module)];
  mine.next_jog_direction = mine.held_jog_direction = 0;
  mine.next_thrust = mine.held_thrust = 0;
  if (mine.activity != Activity::jog && mine.activity != Activity::thrust) return;
  mine.starved = false;
  axes_[at(module)].slow_down(now_);
  after_motion(module, now_ + 1);
}

/// Stops it for a pause, and keeps what it was about to be: one that JG0 has stopped already is over.
void Chain::hold_jog(int module) {
  Module& mine = modules_[at(module)];
  const bool is_over = axes_[at(module)].slowing && !mine.starved;
  std::int8_t direction = mine.held_jog_direction;
  std::int32_t force = mine.held_thrust;
  if (mine.next_jog_direction != 0 || mine.next_thrust != 0) {
    direction = mine.next_jog_direction;
    force = mine.next_thrust;
  } else if (!mine.holds_jog() && !is_over) {
    direction = mine.jog_direction;
    force = mine.thrust;
  }
  stop_jog(module);
  mine.held_jog_direction = direction;
  mine.held_thrust = force;
}

void Chain::go_on_with_jog(int module) {
  Module& mine = modules_[at(module)];
  if (!mine.holds_jog()) return;
  const int direction = std::exchange(mine.held_jog_direction, std::int8_t{0});
  order_jog(module, direction, std::exchange(mine.held_thrust, 0));
}

// ---- Motor control

Error Chain::set_servo(int module, bool on) {
  if (const Error why = refusal(module); why != Error::none) return why;
  Job job{.kind = Job::Kind::servo, .servo_on = on};
  job.module_of[0] = static_cast<std::int8_t>(module);
  return enqueue(job);
}

Error Chain::set_servo_at_once(int module, bool on) {
  if (const Error why = refusal(module); why != Error::none) return why;
  if (!on) {
    cut(module, motion::Cause::servo_off);
    forget_queue(module);
    modules_[at(module)].analog_speed = false;
  }
  axes_[at(module)].switch_servo(on);
  serve(now_ + 1);
  return Error::none;
}

Error Chain::reset(int module) {
  if (const Error why = refusal(module); why != Error::none) return why;
  if (module == 0) steer(InPause::reset);
  cut(module, motion::Cause::stopped);
  forget_queue(module);
  modules_[at(module)].analog_speed = false;
  modules_[at(module)].late_error = Error::none;
  stop_outputs(module);
  if (triggers_stay()) {
    modules_[at(module)].triggers = {};
    place_triggers(module);
  }
  if (options_.chose(option("reset", "coordinate_too"))) {
    modules_[at(module)].homed = false;
    put_coordinate(module, 0);
  }
  axes_[at(module)].switch_servo(has_servo_at_power_up());
  serve(now_ + 1);
  return Error::none;
}

}  // namespace understudy::emulator::models::slim
