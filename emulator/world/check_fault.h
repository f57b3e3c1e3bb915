// Checks whether a fault is possible in a world, or in the world that would be created from a bench.
#pragma once

#include <string>

#include "emulator/world/expression/expression.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/view/inventory.h"

namespace understudy::emulator::world {

/// Throws NameError for an impossible fault, for example a condition that contains unknown names, or noise on
/// an encoder that does not exist.
void check_fault(const Inventory& inventory, const Fault& fault);
/// Checks only the condition. Throws NameError if it is not valid, or if it needs values that only scenarios
/// have.
void check_condition(const Inventory& inventory, const std::string& when);
/// Parses a condition. Throws ExpressionError, the errors of `names`, or NameError if its value is a duration
/// or a voltage.
Expression parse_condition(const std::string& text, const NameResolver& names);

}  // namespace understudy::emulator::world
