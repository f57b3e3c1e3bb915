#pragma once

#include <string_view>

#include "emulator/device/model.h"

namespace understudy::emulator::models::slim {

inline constexpr std::string_view kName = "slim";
const Model& model();

}  // namespace understudy::emulator::models::slim
