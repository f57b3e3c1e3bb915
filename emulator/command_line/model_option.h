#pragma once

#include <string>

#include "emulator/model.h"

namespace understudy::emulator {

/// The model of that name. Throws UsageError with the nearest name.
const Model& demand_model(const std::string& name);

}  // namespace understudy::emulator
