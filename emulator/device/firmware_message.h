// Formats the message for a firmware version that a model does not have.
#pragma once

#include <string>

#include "emulator/device/model.h"

namespace understudy::emulator {

/// Returns "'1.43' is unknown for simple2-r3; expected one of 1.39, 1.40". The text need not be a version
/// number.
std::string why_no_firmware(const Model& model, const std::string& version);

}  // namespace understudy::emulator
