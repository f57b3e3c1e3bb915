// Replaces the references in a macro line with their values.
#pragma once

#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/options.h"

namespace understudy::interpreter::rs_m8194h {

/// Returns Fault::parameter if a value is out of its range. Speeds below 0 become 0.
Fault resolve(Command& command, const Machine& machine, const Options& options = {});

/// Returns the value of an operand, which is a constant or a variable.
std::int32_t value_of(std::uint32_t operand, const Machine& machine);

}  // namespace understudy::interpreter::rs_m8194h
