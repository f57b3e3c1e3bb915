// Checks whether a world, or the world that a bench would make, can have a fault.
#pragma once

#include <string>

#include "emulator/world/expression/expression.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/view/inventory.h"

namespace understudy::emulator::world {

/// Throws NameError for an impossible fault, such as a condition with unknown names, or noise on an encoder
/// that does not exist.
void check_fault(const Inventory& inventory, const Fault& fault);
/// Checks only the condition. Throws NameError if it is not valid, or needs values that only scenarios have.
void check_condition(const Inventory& inventory, const std::string& when);
/// Parses a condition for use. Throws ExpressionError, the errors of `names`, or NameError for a duration or
/// a voltage.
Expression parse_condition(const std::string& text, const NameResolver& names);

}  // namespace understudy::emulator::world
