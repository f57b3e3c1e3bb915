// The variables N#, R#, NS() and RS(), and the clock.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/command.h"

namespace understudy::emulator::models::slim {

/// Returns the value of TM.
std::int64_t clock_s(const State& state, const Setup& setup);
/// Returns the value of an operand, or 0 for a function that shows a query's value.
double value_of(const State& state, const Setup& setup, const lang::Operand& operand);
Error set_variable(State& state, const Setup& setup, const lang::Operand& variable, double value);

}  // namespace understudy::emulator::models::slim
