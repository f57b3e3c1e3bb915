// SUPER-40NC as a model, from which devices are created.
#pragma once

#include <string_view>

#include "emulator/device/model.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr std::string_view kName = "super-40nc";
const Model& model();

}  // namespace understudy::emulator::models::super_40nc
