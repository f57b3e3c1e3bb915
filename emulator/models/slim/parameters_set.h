// Sets parameters and axis letters while the controller runs, and saves its numbers and program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"

namespace understudy::emulator::models::slim {

/// Returns none if the module is linked, otherwise the error.
Error linked(const State& state, int module);

Error set_parameter(State& state, const Setup& setup, int module, std::string_view name, double value);
/// Applies all parameters to a chain that has just been made.
void apply_all_parameters(State& state, const Setup& setup);
/// Executes DF. It is refused while anything is in progress whose units it would change.
Error restore_factory_parameters(State& state, const Setup& setup);
/// Returns the answer to ULC.
std::vector<std::string> parameter_list(const State& state, const Setup& setup);

/// Executes TX= ..., and applies the map of PN37 at power-up.
Error assign_axis(State& state, const Setup& setup, Letter letter, int module);
/// Sets PN37 to the map that is in effect.
void keep_axis_map(State& state);

// Execute SAVE P, SAVE D and SAVE C.
void keep_parameters(State& state);
void keep_data(State& state);
void keep_program(State& state);

}  // namespace understudy::emulator::models::slim
