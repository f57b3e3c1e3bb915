// SUPER-40NC as data for those that make devices.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::models::super_40nc {

const Model& model();

}  // namespace understudy::emulator::models::super_40nc
