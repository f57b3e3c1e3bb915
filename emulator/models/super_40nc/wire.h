// How a SUPER-40NC answers requests that its register map would refuse.
#pragma once

#include "emulator/device/device.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator::models::super_40nc {

/// Returns the map's policy with the choices of a device.
MapPolicy chosen_map_policy(const Device& device, MapPolicy policy);

}  // namespace understudy::emulator::models::super_40nc
