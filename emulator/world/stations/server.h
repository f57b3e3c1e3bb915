// Executes Modbus requests with a device's register map. It handles functions and exceptions, but not frames,
// addresses or time. (MODBUS Application Protocol V1.1b3.)
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "emulator/device/device.h"
#include "emulator/device/register_map/refusal.h"

namespace understudy::emulator::world {

enum class ModbusException : std::uint8_t {
  illegal_function = 1,
  illegal_data_address = 2,
  illegal_data_value = 3,
  device_failure = 4,
  device_busy = 6,
};

/// A function code: its table, its kind of access, and its limit per request.
struct FunctionRow {
  enum class Kind : std::uint8_t { read, write_one, write_several };

  std::uint8_t code = 0;
  Table table = Table::holding;
  Kind kind = Kind::read;
  int max = 1;  // in bits or registers; a model may allow fewer (RtuRules::limits)
};

/// All supported functions; a model supports some of them.
inline constexpr FunctionRow kModbusFunctions[] = {
    {0x01, Table::coil, FunctionRow::Kind::read, 2000},
    {0x02, Table::discrete, FunctionRow::Kind::read, 2000},
    {0x03, Table::holding, FunctionRow::Kind::read, 125},
    {0x04, Table::input, FunctionRow::Kind::read, 125},
    {0x05, Table::coil, FunctionRow::Kind::write_one, 1},
    {0x06, Table::holding, FunctionRow::Kind::write_one, 1},
    {0x0F, Table::coil, FunctionRow::Kind::write_several, 1968},
    {0x10, Table::holding, FunctionRow::Kind::write_several, 123},
};

/// Functions that are not a single access to one table. Only models that list them support them.
enum class OtherFunction : std::uint8_t {
  diagnostics = 0x08,  // sub-function 0: returns the request
  server_id = 0x11,
  mask_write = 0x16,
  read_and_write = 0x17,  // writes before it reads
  identification = 0x2B,  // MEI type 14
};
struct OtherFunctionRow {
  OtherFunction code;
  int max = 1;  // the maximum number of registers to read; the standard allows writing 121
};
inline constexpr OtherFunctionRow kOtherModbusFunctions[] = {{OtherFunction::diagnostics},
                                                             {OtherFunction::server_id},
                                                             {OtherFunction::mask_write},
                                                             {OtherFunction::read_and_write, 125},
                                                             {OtherFunction::identification}};

/// Returns the function that reads or writes a table, or null if there is none, for example for writing
/// inputs.
constexpr const FunctionRow* function_for(Table table, FunctionRow::Kind kind) {
  for (const FunctionRow& row : kModbusFunctions) {
    if (row.table == table && row.kind == kind) return &row;
  }
  return nullptr;
}

inline constexpr std::size_t kModbusMaxPdu = 253;

struct ModbusReply {
  std::array<std::uint8_t, kModbusMaxPdu> pdu{};
  std::size_t size = 0;
  RefusedRequest refused{};  // the refused request and the reason, if the reply is an exception
};

/// Executes a request (function code and data) and creates the reply. A request whose answer is an exception
/// does not change anything. The order of the checks is: function, quantity and byte count, addresses,
/// values, and whether the device accepts the request now.
ModbusReply serve(Device& device, std::span<const std::uint8_t> pdu);

}  // namespace understudy::emulator::world
