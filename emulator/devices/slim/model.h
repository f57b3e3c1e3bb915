#pragma once

#include "emulator/model.h"

namespace understudy::emulator::slim {

const Model& model();

}  // namespace understudy::emulator::slim
