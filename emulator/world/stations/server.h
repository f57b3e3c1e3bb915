// Serves Modbus requests from a device's register map. Knows functions and exceptions, but not frames,
// addresses or time. (MODBUS Application Protocol V1.1b3.)
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "emulator/device/device.h"

namespace understudy::emulator::world {

enum class ModbusException : std::uint8_t {
  illegal_function = 1,
  illegal_data_address = 2,
  illegal_data_value = 3,
};

inline constexpr std::size_t kModbusMaxPdu = 253;

struct ModbusReply {
  std::array<std::uint8_t, kModbusMaxPdu> pdu{};
  std::size_t size = 0;
};

/// Carries out one request (function code and data) and makes its reply. A request that gets an exception has
/// changed nothing. It is tested in this order: function, quantity and byte count, addresses, values.
ModbusReply serve(Device& device, std::span<const std::uint8_t> pdu);

}  // namespace understudy::emulator::world
