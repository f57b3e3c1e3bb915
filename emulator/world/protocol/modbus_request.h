// The content of a Modbus request: the registers or bits that it reads and writes, and the values that it
// writes. All observers of requests use this, so they all support the same functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator::world {

/// Consecutive registers or bits.
struct RegisterSpan {
  Table table = Table::holding;
  std::uint16_t first = 0;
  std::size_t count = 0;
};

/// The effect of a mask on a register: (present value AND `kept`) OR (`set` AND NOT `kept`).
struct RegisterMask {
  std::uint16_t kept = 0;
  std::uint16_t set = 0;
};

struct ModbusRequest {
  std::uint8_t function = 0;
  std::optional<RegisterSpan> reads{};
  std::optional<RegisterSpan> writes{};
  std::vector<std::uint16_t> words{};  // the values of a write, except for a mask; bits are 0 or 1
  std::optional<RegisterMask> mask{};
  /// True if its length and all other properties of its form are correct. Otherwise, it has no values.
  bool is_well_formed = false;
};

/// Parses a request from its function code to the end, without the checksum. There are no spans if the
/// function accesses no registers or is unknown, or if its addresses are incomplete.
ModbusRequest parse_request(std::span<const std::uint8_t> pdu);
/// The same, for a whole frame.
ModbusRequest parse_request_frame(std::span<const std::uint8_t> frame);

/// Returns the size of the reply frame if the request is not refused. For a function without registers, it is
/// the maximum size.
std::size_t reply_size(const ModbusRequest& request);

/// Returns the table that the bank uses for a span. A bank without input registers uses holding registers
/// instead.
Table table_in(const RegisterBank& bank, Table table);

/// Returns the values that the request writes. A mask is applied to the register's present value; the result
/// is the same before and after the write. Returns none if the register cannot be read.
std::vector<std::uint16_t> written_words(const RegisterBank& bank, const ModbusRequest& request);

}  // namespace understudy::emulator::world
