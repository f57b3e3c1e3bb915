// A view of a module: its state, its axis, and the data that both need. It is created for each command or
// tick.
//
//   motor.h   the coordinate, the outputs, and the places at which outputs switch
//   jogs.h    jogs and thrust, which bypass the FIFO; slowing down from an abandoned motion
//   moves.h   MA, MR and H at the head of the FIFO; what follows the end of a motion
//
// Each header uses only those above it, and none accesses other modules.
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
  Tick now;  // the last tick: a command that starts immediately begins in the next one

  double coordinate() const { return module.coordinate(axis); }
};

/// Sets the coordinate of the present place to `units`. Used for CS and at the end of homing.
void set_coordinate(const Motor& motor, double units);

// ---- Outputs

void carry_out(const Motor& motor, const OutputOrder& order, Tick begin_at);
/// Sets the axis's comparators to the travel at which the triggers are. A trigger at the axis's present place
/// waits until that place is reached again.
void place_triggers(const Motor& motor);
/// Switches the outputs whose positions the axis has just reached.
void pass_triggers(const Motor& motor, motion::Events events);
/// A choice can make a stop end pulses, PWM and triggers. Levels do not change.
void stop_outputs(const Motor& motor);

}  // namespace understudy::emulator::models::slim
