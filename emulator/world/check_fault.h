// Whether a world can have a fault.
#pragma once

#include <string>

#include "emulator/world/faults/fault.h"

namespace understudy::emulator::world {

class World;

/// Throws NameError for one that it cannot have: a condition that it does not understand, noise on an encoder
/// that does not exist.
void check_fault(const World& world, const Fault& fault);
/// Checks only the condition: throws NameError for one that it does not understand.
void check_condition(const World& world, const std::string& when);

}  // namespace understudy::emulator::world
