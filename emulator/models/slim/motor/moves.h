// The commands that a module executes alone at the head of its FIFO (MA, MR and H). Pauses and AVM slow their
// motion down.
#pragma once

#include "base/simulated_time.h"
#include "emulator/models/slim/motor/jogs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/motor.h"

namespace understudy::emulator::models::slim {

/// Both start the FIFO's head, or drop it with a late error. They return true if the FIFO has changed.
bool start_move(const Motor& motor, Tick begin_at);
bool start_home(const Motor& motor, Tick begin_at);

/// Does what the end of a move or homing requires.
void after_move(const Motor& motor);
/// Does what the end of a motion requires, if the motor has moved alone and is at rest.
inline void after_motion(const Motor& motor, Tick begin_at) {
  const Activity activity = motor.module.activity;
  if (activity == Activity::idle || activity == Activity::group || motor.axis.moving()) return;
  if (activity == Activity::move || activity == Activity::home) {
    after_move(motor);
  } else {
    after_jog(motor, begin_at);
  }
}

/// Called when a pause begins or ends.
void hold_motion(const Motor& motor);
void resume_motion(const Motor& motor);

/// Applies a changed speed to the running move or jog, if no pause holds it. Returns false if the motor stops
/// or is at rest whatever its speed is.
bool refresh_speed(const Motor& motor, bool is_held);

/// Ends the motor's own motion at once; the running command is dropped.
void cut_motion(const Motor& motor, motion::Cause why);

}  // namespace understudy::emulator::models::slim
