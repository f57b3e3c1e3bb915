// Simple2-R3 as a model: its tables and its line.
#pragma once

#include <string_view>

#include "emulator/device/model.h"

namespace understudy::emulator::models::simple2_r3 {

inline constexpr std::string_view kName = "simple2-r3";
const Model& model();

}  // namespace understudy::emulator::models::simple2_r3
