#include "emulator/world/protocol/modbus_request.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "emulator/device/register_map/row.h"
#include "emulator/world/stations/server.h"

namespace understudy::emulator::world {

namespace {

std::uint16_t word_at(std::span<const std::uint8_t> bytes, std::size_t place) {
  return static_cast<std::uint16_t>(bytes[place] << 8U | bytes[place + 1]);
}

}  // namespace

std::optional<ModbusRequest> parse_request(std::span<const std::uint8_t> pdu) {
  if (pdu.size() < 5) return std::nullopt;
  for (const FunctionRow& row : kModbusFunctions) {
    if (row.code != pdu[0]) continue;
    ModbusRequest request{
        .function = row.code, .table = row.table, .first = word_at(pdu, 1), .count = word_at(pdu, 3)};
    if (row.kind == FunctionRow::Kind::read) return request;
    const bool are_bits = is_table_of_bits(row.table);
    if (row.kind == FunctionRow::Kind::write_one) {
      const std::uint16_t word = word_at(pdu, 3);
      request.words.push_back(are_bits ? static_cast<std::uint16_t>(word != 0) : word);
      request.count = 1;
      return request;
    }
    for (std::size_t i = 0; i < request.count; ++i) {
      const std::size_t place = 6 + (are_bits ? i / 8 : i * 2);
      if (place + (are_bits ? 0 : 1) >= pdu.size()) return std::nullopt;
      request.words.push_back(are_bits ? static_cast<std::uint16_t>(pdu[place] >> i % 8 & 1)
                                       : word_at(pdu, place));
    }
    return request;
  }
  return std::nullopt;
}

}  // namespace understudy::emulator::world
