// Explains why a device has refused a Modbus request, based on its tables: "feeder.Aaxis_Speed accepts 0 to
// 32768, not 65000".
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "emulator/device/device.h"

namespace understudy::emulator::world {

/// Returns the reason, or an empty text if it is not in the tables because it depended on the state of the
/// device. `request` is the whole frame, and `exception` is the code in the answer.
std::string why_refused(const Device& device, std::span<const std::uint8_t> request, int exception);

}  // namespace understudy::emulator::world
