// Simple2-R3 as a model: its tables, and how it listens.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::models::simple2_r3 {

const Model& model();

}  // namespace understudy::emulator::models::simple2_r3
