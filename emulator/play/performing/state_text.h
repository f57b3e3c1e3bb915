#pragma once

#include <string>
#include <vector>

#include "emulator/world/world.h"

namespace understudy::emulator::play {

/// How the devices and their machines stand at this moment, a line each: status, modes, coordinates; pulses,
/// speed and position of each axis; the terminals that are on; the faults, and what they have done.
std::vector<std::string> state_text(const world::World& world);

}  // namespace understudy::emulator::play
