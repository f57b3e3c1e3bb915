// RS-M8194H: four axes on a motion chip, behind Modbus RTU.
#pragma once

#include <string_view>

#include "emulator/device/model.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr std::string_view kName = "rs-m8194h";
const Model& model();

}  // namespace understudy::emulator::models::rs_m8194h
