// Sets parameters and axis letters while the controller is running, and saves its numbers and program.
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
/// Applies all parameters to a newly created chain.
void apply_all_parameters(State& state, const Setup& setup);
/// Executes DF. It is refused while anything is in progress whose units would change.
Error restore_factory_parameters(State& state, const Setup& setup);
/// Returns the answer to ULC.
std::vector<std::string> parameter_list(const State& state, const Setup& setup);

/// Executes TX= ..., and applies the map in PN37 at power-up.
Error assign_axis(State& state, const Setup& setup, Letter letter, int module);
/// Stores the present axis map in PN37.
void keep_axis_map(State& state);

// These execute SAVE P, SAVE D and SAVE C.
void keep_parameters(State& state);
void keep_data(State& state);
void keep_program(State& state);

}  // namespace understudy::emulator::models::slim
