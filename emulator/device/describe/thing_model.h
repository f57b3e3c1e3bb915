// Writes a model's registers as a W3C Thing Model with the Modbus binding.
#pragma once

#include <string>

#include "emulator/device/model.h"

namespace understudy::emulator {

/// Returns JSON with a final line ending. Its placeholders are HOST, PORT and UNIT. A model without registers
/// has no properties.
std::string thing_model(const Model& model);

}  // namespace understudy::emulator
