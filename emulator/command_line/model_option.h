#pragma once

#include <string>

#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// The model of that name. Throws UsageError with the nearest name.
const Model& demand_model(ModelList models, const std::string& name);

}  // namespace understudy::emulator::command_line
