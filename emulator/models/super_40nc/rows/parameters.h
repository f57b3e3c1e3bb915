// SUPER-40NC's parameters by the numbers that its panel shows: C0 to C26, X0 to X61, and likewise for Y, Z
// and U.
#pragma once

#include <span>

#include "emulator/device/model.h"

namespace understudy::emulator::models::super_40nc {

std::span<const NamedParameterRow> named_parameters();

}  // namespace understudy::emulator::models::super_40nc
