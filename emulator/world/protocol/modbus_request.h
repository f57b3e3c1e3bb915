// The content of a Modbus request: its registers or bits, and the values that it writes to them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "emulator/device/register_map/row.h"

namespace understudy::emulator::world {

struct ModbusRequest {
  std::uint8_t function = 0;
  Table table = Table::holding;
  std::uint16_t first = 0;
  std::size_t count = 0;
  std::vector<std::uint16_t> words{};  // the values of a write; bits are 0 or 1

  bool is_write() const { return !words.empty(); }
};

/// Reads a request from its function code to the end, without checksum. Returns nothing if it is incomplete,
/// or has a different function.
std::optional<ModbusRequest> parse_request(std::span<const std::uint8_t> pdu);

}  // namespace understudy::emulator::world
