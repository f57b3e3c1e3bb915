#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::models::slim {

const Model& model();

}  // namespace understudy::emulator::models::slim
