#include "emulator/models/slim/motor/jogs.h"

#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/motor/marks.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/motor.h"
#include "motion/axis.h"
#include "motion/move.h"

namespace understudy::emulator::models::slim {

void begin_jog(const Motor& motor, int direction, Tick begin_at) {
  Module& module = motor.module;
  take_off(module, MarkEvent::begins);
  module.activity = Activity::jog;
  module.jog_direction = static_cast<std::int8_t>(direction);
  const int pulse_direction = module.settings.jog_speed < 0 ? -direction : direction;
  const motion::SpeedLaw law = module.jog_law(motor.options);
  if (module.settings.jog_speed == 0) {
    motor.axis.move_at_zero_speed(pulse_direction);
  } else if (law.top_speed_u_s == 0) {
    module.starved = true;
  } else {
    motor.axis.run(pulse_direction, law, begin_at - 1);
  }
}

namespace {

void begin_thrust(const Motor& motor, std::int32_t force, Tick begin_at) {
  Module& module = motor.module;
  if (motor.options.thrust_runs()) begin_jog(motor, +1, begin_at);
  // The motion begins even if its speed is 0.
  if (!motor.axis.moving()) motor.axis.move_at_zero_speed(+1);
  take_off(module, MarkEvent::begins);
  module.activity = Activity::thrust;
  module.jog_direction = 0;
  module.thrust = force;
}

}  // namespace

void begin_next_jog(const Motor& motor, Tick begin_at) {
  const Module& module = motor.module;
  if (module.next_thrust != 0) {
    begin_thrust(motor, module.next_thrust, begin_at);
  } else if (module.next_jog_direction != 0) {
    begin_jog(motor, module.next_jog_direction, begin_at);
  }
}

void order_jog(const Motor& motor, int direction, std::int32_t force) {
  Module& module = motor.module;
  motion::Axis& axis = motor.axis;
  if (!module.jogs_or_pushes()) {
    module.next_jog_direction = static_cast<std::int8_t>(direction);
    module.next_thrust = force;
    if (module.activity == Activity::idle) begin_next_jog(motor, motor.now + 1);
    return;
  }
  if (module.activity == Activity::thrust && direction == 0 && !axis.slowing) {
    module.thrust = force;
    return;
  }
  const bool stands = module.starved || axis.task == motion::Task::hanging;
  const motion::SpeedLaw law = module.jog_law(motor.options);
  if (module.activity == Activity::jog && direction == module.jog_direction &&
      (stands || law.top_speed_u_s > 0)) {
    take_off(module, MarkEvent::continues);
    if (stands) return;
    if (!axis.resume(law, motor.now)) axis.change_speed(law, motor.now);
    return;
  }
  module.next_jog_direction = static_cast<std::int8_t>(direction);
  module.next_thrust = force;
  take_off(module, MarkEvent::stop_requested);
  axis.slow_down(motor.now);
  after_jog(motor, motor.now + 1);
}

void stop_jog(const Motor& motor) {
  Module& module = motor.module;
  take_off(module, MarkEvent::jogs_dropped);
  if (!module.jogs_or_pushes()) return;
  take_off(module, MarkEvent::stop_requested);
  motor.axis.slow_down(motor.now);
  after_jog(motor, motor.now + 1);
}

void hold_jog(const Motor& motor) {
  Module& module = motor.module;
  const bool is_over = motor.axis.slowing && !module.starved;  // true if JG0 has stopped the jog
  std::int8_t direction = module.held_jog_direction;
  std::int32_t force = module.held_thrust;
  if (module.next_jog_direction != 0 || module.next_thrust != 0) {
    direction = module.next_jog_direction;
    force = module.next_thrust;
  } else if (!module.holds_jog() && !is_over) {
    direction = module.jog_direction;
    force = module.thrust;
  }
  stop_jog(motor);
  module.held_jog_direction = direction;
  module.held_thrust = force;
}

void resume_jog(const Motor& motor) {
  Module& module = motor.module;
  if (!module.holds_jog()) return;
  const int direction = module.held_jog_direction;
  const std::int32_t force = module.held_thrust;
  take_off(module, MarkEvent::pause_over);
  order_jog(motor, direction, force);
}

void slow_down_for_good(const Motor& motor) {
  motor.module.activity = Activity::stopping;
  take_off(motor.module, MarkEvent::stop_requested);
  motor.axis.slow_down(motor.now);
  after_jog(motor, motor.now + 1);
}

void after_jog(const Motor& motor, Tick begin_at) {
  Module& module = motor.module;
  const bool is_stopping = module.activity == Activity::stopping;
  if (motor.axis.moving() || !(is_stopping || module.jogs_or_pushes())) return;
  module.place_units = motor.coordinate();
  if (module.activity == Activity::jog && module.starved) return;  // continues when AVM specifies a speed
  take_off(module, MarkEvent::stands);
  begin_next_jog(motor, begin_at);
}

}  // namespace understudy::emulator::models::slim
