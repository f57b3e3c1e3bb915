// SUPER-40NC's parameters by their numbers on the panel: C0 to C26, X0 to X61, and the same for Y, Z and U.
#pragma once

#include <span>

#include "emulator/device/model.h"

namespace understudy::emulator::models::super_40nc {

std::span<const NamedParameterRow> named_parameters();

}  // namespace understudy::emulator::models::super_40nc
