#pragma once

#include <string>
#include <vector>

#include "emulator/world/world.h"

namespace understudy::emulator::play {

/// Returns the state of the devices and their machines at this moment, one line each: status, modes,
/// coordinates; pulses, speed and position of each axis; the terminals that are on; the faults and their
/// hits.
std::vector<std::string> state_text(const world::World& world);

}  // namespace understudy::emulator::play
