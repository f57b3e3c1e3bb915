// Jogs and thrust of one module. They bypass the FIFO. A jog or thrust that is commanded during another
// motion starts after that motion.
#pragma once

#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/motor/motor.h"

namespace understudy::emulator::models::slim {

/// Requests a jog in `direction`, or thrust if `direction` is 0. It replaces a running jog or thrust, or
/// follows another motion.
void order_jog(const Motor& motor, int direction, std::int32_t force);
void begin_jog(const Motor& motor, int direction, Tick begin_at);
/// Begins the jog or thrust that was waiting for the motor to stop, if any.
void begin_next_jog(const Motor& motor, Tick begin_at);
/// Slows down for JG0, and cancels the next jog or thrust.
void stop_jog(const Motor& motor);

/// Stops a jog or thrust for a pause. resume_jog() continues it, or starts the next one.
void hold_jog(const Motor& motor);
void resume_jog(const Motor& motor);

/// Slows down an abandoned move or homing.
void slow_down_for_good(const Motor& motor);

/// If the axis is at rest, performs what follows the end of a jog, a thrust or slow_down_for_good().
void after_jog(const Motor& motor, Tick begin_at);

}  // namespace understudy::emulator::models::slim
