// Jogs and thrust of one module. They bypass the FIFO; a jog or thrust that is commanded during another
// motion starts after it.
#pragma once

#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/motor/motor.h"

namespace understudy::emulator::models::slim {

/// Orders a jog in `direction`, or thrust if that is 0. It replaces a running one, or follows another motion.
void order_jog(const Motor& motor, int direction, std::int32_t force);
void begin_jog(const Motor& motor, int direction, Tick begin_at);
/// Begins the jog or thrust that has waited for the motor to stop, if there is one.
void begin_next_jog(const Motor& motor, Tick begin_at);
/// Slows down for JG0, and cancels the jog or thrust that was to follow.
void stop_jog(const Motor& motor);

/// Stops a jog or thrust for a pause. resume_jog() continues it, or the one that was to follow.
void hold_jog(const Motor& motor);
void resume_jog(const Motor& motor);

/// Slows down from a move or homing that is abandoned.
void slow_down_for_good(const Motor& motor);

/// Does what the end of a jog, of thrust, or of slow_down_for_good() requires, if the axis is at rest.
void after_jog(const Motor& motor, Tick begin_at);

}  // namespace understudy::emulator::models::slim
