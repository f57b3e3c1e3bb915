// Jogs and thrust of one module. They pass by the FIFO; one that comes during another motion follows it.
#pragma once

#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/motor/motor.h"

namespace understudy::emulator::models::slim {

/// Orders a jog in `direction`, or thrust if that is 0. It replaces another one, or follows what stops.
void order_jog(const Motor& motor, int direction, std::int32_t force);
void begin_jog(const Motor& motor, int direction, Tick begin_at);
/// Begins the jog or thrust that has waited for the motor to stop, if there is one.
void begin_next_jog(const Motor& motor, Tick begin_at);
/// JG0: slows down, and forgets what was to follow.
void stop_jog(const Motor& motor);

/// Stops it for a pause. resume_jog() continues what it was about to be.
void hold_jog(const Motor& motor);
void resume_jog(const Motor& motor);

/// Slows down from a move or homing that is given up.
void slow_down_for_good(const Motor& motor);

/// Does what the end of a jog, of thrust, or of slow_down_for_good() requires, if the axis is at rest.
void after_jog(const Motor& motor, Tick begin_at);

}  // namespace understudy::emulator::models::slim
