// One module at work: its state, its axis, and the data that both look up. A view, made for a command or a
// tick.
//
//   motor.h   the coordinate, the outputs, and the places at which they switch
//   jogs.h    jogs and thrust, which bypass the FIFO; slowing down from an abandoned motion
//   moves.h   MA, MR and H, at the FIFO's head; what the end of each motion requires
//
// Each uses only those above it, and none accesses another module.
#pragma once

#include "base/simulated_time.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/outputs.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::slim {

struct Motor {
  Module& module;
  motion::Axis& axis;
  const motion::Environment& environment;
  const ChainOptions& options;
  Tick now;  // the last tick: a command that starts at once starts with the next one

  double coordinate() const { return module.coordinate(axis); }
};

/// Sets the coordinate of the present place to `units`, for CS and at the end of a homing.
void set_coordinate(const Motor& motor, double units);

// ---- Outputs

void carry_out(const Motor& motor, const OutputOrder& order, Tick begin_at);
/// Sets the axis's comparators to where the triggers are in its travel. A trigger at the axis's own place
/// waits until the place is reached again.
void place_triggers(const Motor& motor);
/// Switches the outputs whose positions the axis has just reached.
void pass_triggers(const Motor& motor, motion::Events events);
/// If so chosen, ends what continues on its own at a stop: pulses, PWM and triggers. Levels stay.
void stop_outputs(const Motor& motor);

}  // namespace understudy::emulator::models::slim
