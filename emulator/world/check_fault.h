// Whether a world, or the world that a bench would make, can have a fault.
#pragma once

#include <string>

#include "emulator/world/expression/expression.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/view/inventory.h"

namespace understudy::emulator::world {

/// Throws NameError for one that it cannot have: a condition that it does not understand, noise on an encoder
/// that does not exist.
void check_fault(const Inventory& inventory, const Fault& fault);
/// Checks only the condition: throws NameError for one that it does not understand.
void check_condition(const Inventory& inventory, const std::string& when);
/// The same for use: ExpressionError, or what the names throw.
Expression parse_condition(const std::string& text, const NameResolver& names);

}  // namespace understudy::emulator::world
