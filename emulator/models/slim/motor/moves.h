// The commands that a single module executes at the head of its FIFO (MA, MR and H). Pauses and AVM slow down
// these motions.
#pragma once

#include "base/simulated_time.h"
#include "emulator/models/slim/motor/jogs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/motor.h"

namespace understudy::emulator::models::slim {

/// Both functions start the command at the head of the FIFO, or drop it with a late error. They return true
/// if the FIFO has changed.
bool start_move(const Motor& motor, Tick begin_at);
bool start_home(const Motor& motor, Tick begin_at);

/// Performs what follows the end of a move or homing.
void after_move(const Motor& motor);
/// If the motor has moved alone and is at rest, performs what follows the end of the motion.
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

/// Applies a changed speed to the running move or jog, unless it is paused. Returns false if the motor is
/// stopping or at rest regardless of its speed.
bool refresh_speed(const Motor& motor, bool is_held);

/// Ends the motor's own motion immediately. The running command is dropped.
void cut_motion(const Motor& motor, motion::Cause why);

}  // namespace understudy::emulator::models::slim
