#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "emulator/world/world.h"

namespace understudy::emulator::play {

/// Returns the present state of the devices and their machines, one line each: status, modes, coordinates;
/// pulses, speed and position of each axis; the terminals that are on; the faults and their hits.
std::vector<std::string> state_text(const world::World& world);
/// The same for one device and its machines, without faults.
std::vector<std::string> device_state_text(const world::World& world, std::size_t number);

}  // namespace understudy::emulator::play
