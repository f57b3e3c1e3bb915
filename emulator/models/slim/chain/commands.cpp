// Commands for one module.
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/chain/paths.h"
#include "emulator/models/slim/chain/queues.h"
#include "emulator/models/slim/chain/refusals.h"
#include "emulator/models/slim/chain/settings.h"
#include "emulator/models/slim/chain/stops.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/jogs.h"
#include "emulator/models/slim/motor/marks.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/motor.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/rules/pauses.h"
#include "motion/axis.h"

namespace understudy::emulator::models::slim {

namespace {

constexpr std::int32_t kMaxThrust = 20'000;

Error enqueue_move(ChainState& chain, int module, bool absolute, double units) {
  const Module& mine = chain.modules[at(module)];
  Job job = job_of(module, {.kind = Job::Kind::move, .absolute = absolute});
  job.units[0] = units;
  job.ends[0] = absolute ? units : mine.end_expected(module, chain.axes[at(module)]) + units;
  return mine.reaches(job.ends[0]) ? enqueue(chain, job) : Error::range;
}

/// Requests a jog in `direction`, or thrust if `direction` is 0. A choice can make it replace a move.
Error replace_jog(ChainState& chain, int module, int direction, std::int32_t force) {
  if (const Error why = refusal_of_jog(chain, module); why != Error::none) return why;
  const bool gives_up = !chain.modules[at(module)].jogs_or_pushes();
  if (gives_up) {
    slow_for_discard(chain, module);  // does nothing if there is nothing to abandon
    forget_queue(chain, module);
  }
  order_jog(chain.motor(module), direction, force);
  if (gives_up) serve(chain, chain.now + 1);  // starts commands that waited for dropped commands
  return Error::none;
}

}  // namespace

Chain::Chain(const ChainOptions& options) {
  set_options(options);
  state_.modules[0].linked = true;
  for (motion::Axis& axis : state_.axes) axis.switch_servo(options.has_servo_at_power_up());
}

Error Chain::move(int module, bool absolute, double units) {
  if (const Error why = refusal_by_number(state_, module); why != Error::none) return why;
  return enqueue_move(state_, module, absolute, units);
}

Error Chain::move_axis(Letter letter, bool absolute, double units) {
  const int module = state_.map[static_cast<std::size_t>(letter)];
  if (module < 0) return Error::axis;
  if (const Error why = refusal_of_motion(state_, module); why != Error::none) return why;
  return enqueue_move(state_, module, absolute, units);
}

Error Chain::home(int module) {
  const Error why = refusal_of_home(state_, module);
  return why == Error::none ? enqueue(state_, job_of(module, {.kind = Job::Kind::home})) : why;
}

Error Chain::set_coordinate(int module, double units) {
  if (const Error why = refusal(state_, module); why != Error::none) return why;
  if (!module_at(module).reaches(units)) return Error::range;
  const bool is_refused = options().chose(option("coordinate_in_motion", "error_3"));
  if (is_refused && busy(module)) return Error::not_allowed;
  Job job = job_of(module, {.kind = Job::Kind::set_coordinate});
  job.units[0] = job.ends[0] = units;
  return enqueue(state_, job);
}

// ---- Jogs and thrust

Error Chain::jog(int module, int direction) {
  if (direction != 0) return replace_jog(state_, module, direction < 0 ? -1 : +1, 0);
  if (const Error why = refusal(state_, module); why != Error::none) return why;
  stop_jog(state_.motor(module));
  serve(state_, state_.now + 1);
  return Error::none;
}

Error Chain::thrust(int module, std::int32_t force) {
  if (force < 1 || force > kMaxThrust) return Error::range;
  return replace_jog(state_, module, 0, force);
}

Error Chain::set_analog_speed(int module) {
  const bool jogs = options().chose(option("analog_speed", "starts_a_jog"));
  const Error why = jogs ? refusal_of_jog(state_, module) : refusal(state_, module);
  if (why != Error::none) return why;
  state_.modules[at(module)].analog_speed = true;
  refresh_speed(state_, module);
  return jogs ? replace_jog(state_, module, +1, 0) : Error::none;
}

// ---- Motor control

Error Chain::set_servo(int module, bool on) {
  if (const Error why = refusal(state_, module); why != Error::none) return why;
  return enqueue(state_, job_of(module, {.kind = Job::Kind::servo, .servo_on = on}));
}

Error Chain::set_servo_at_once(int module, bool on) {
  if (const Error why = refusal(state_, module); why != Error::none) return why;
  if (!on) {
    cut(state_, module, motion::Cause::servo_off);
    forget_queue(state_, module);
    take_off(state_.modules[at(module)], MarkEvent::servo_off);
  }
  state_.axes[at(module)].switch_servo(on);
  serve(state_, state_.now + 1);
  return Error::none;
}

Error Chain::reset(int module) {
  if (const Error why = refusal(state_, module); why != Error::none) return why;
  if (module == 0) steer(state_, InPause::reset);
  cut(state_, module, motion::Cause::stopped);
  forget_queue(state_, module);
  const Motor motor = state_.motor(module);
  take_off(motor.module, MarkEvent::servo_off);
  motor.module.late_error = Error::none;
  stop_outputs(motor);
  if (options().triggers_stay()) {
    motor.module.triggers = {};
    place_triggers(motor);
  }
  if (options().chose(option("reset", "coordinate_too"))) {
    motor.module.homed = false;
    slim::set_coordinate(motor, 0);
  }
  motor.axis.switch_servo(options().has_servo_at_power_up());
  serve(state_, state_.now + 1);
  return Error::none;
}

}  // namespace understudy::emulator::models::slim
