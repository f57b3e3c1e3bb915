// Handles power-up, power-down and the inputs of a SLIM.
#pragma once

#include "base/simulated_time.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"

namespace understudy::emulator::models::slim {

void power_up(State& state, const Setup& setup);
void power_down(State& state, const Setup& setup);
/// Executes RESET H.
void reboot(State& state, const Setup& setup);

void sample_inputs(State& state, const Setup& setup, Tick tick);
/// Returns true if an input has changed since a tick last read it.
bool sees_something_new(const State& state, const Setup& setup);

}  // namespace understudy::emulator::models::slim
