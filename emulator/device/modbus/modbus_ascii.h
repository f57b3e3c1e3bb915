// Modbus ASCII, the other framing of Modbus on a serial line.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator {

/// Frames consist of hexadecimal digits. Models with this protocol also have RtuRules and the facet
/// ModbusStation.
inline constexpr Protocol kModbusAscii{"Modbus ASCII"};

inline bool is_modbus_ascii(const Model& model) { return &model.line.protocol == &kModbusAscii; }

}  // namespace understudy::emulator
