#include "emulator/world/protocol/modbus_request.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/world/stations/server.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kAddressed = 5;  // the size of a function code, an address and a count or value

std::uint16_t word_at(Bytes bytes, std::size_t place) {
  return static_cast<std::uint16_t>(bytes[place] << 8U | bytes[place + 1]);
}

/// Reads `count` values, which follow their byte count at `at`. The request must end after them.
void take_values(ModbusRequest& request, Bytes pdu, std::size_t at) {
  const std::size_t count = request.writes->count;
  const bool are_bits = is_table_of_bits(request.writes->table);
  const std::size_t bytes = are_bits ? (count + 7) / 8 : 2 * count;
  request.is_well_formed = count > 0 && pdu.size() == at + 1 + bytes && pdu[at] == bytes;
  if (!request.is_well_formed) return;
  const Bytes values = pdu.subspan(at + 1);
  for (std::size_t i = 0; i < count; ++i) {
    request.words.push_back(are_bits ? static_cast<std::uint16_t>(values[i / 8] >> i % 8 & 1)
                                     : word_at(values, 2 * i));
  }
}

void take_single(ModbusRequest& request, Bytes pdu) {
  constexpr std::uint16_t kOn = 0xFF00;
  if (pdu.size() != kAddressed) return;
  const bool is_bit = is_table_of_bits(request.writes->table);
  const std::uint16_t word = word_at(pdu, 3);
  request.is_well_formed = !is_bit || word == kOn || word == 0;
  if (!request.is_well_formed) return;
  request.words.push_back(is_bit ? static_cast<std::uint16_t>(word == kOn ? 1 : 0) : word);
}

void take_mask(ModbusRequest& request, Bytes pdu) {
  constexpr std::size_t kSize = 7;
  request.writes = {.first = word_at(pdu, 1), .count = 1};
  request.is_well_formed = pdu.size() == kSize;
  if (request.is_well_formed) request.mask = {.kept = word_at(pdu, 3), .set = word_at(pdu, 5)};
}

void take_read_and_write(ModbusRequest& request, Bytes pdu) {
  constexpr std::size_t kByteCount = 9;
  request.reads = {.first = word_at(pdu, 1), .count = word_at(pdu, 3)};
  if (pdu.size() < kByteCount) return;
  request.writes = {.first = word_at(pdu, 5), .count = word_at(pdu, 7)};
  take_values(request, pdu, kByteCount);
}

}  // namespace

ModbusRequest parse_request(Bytes pdu) {
  ModbusRequest request{.function = pdu.empty() ? std::uint8_t{0} : pdu[0]};
  constexpr std::size_t kNamed = 3;  // the size of a function code and an address
  if (pdu.size() < kNamed) return request;
  if (request.function == static_cast<std::uint8_t>(OtherFunction::mask_write)) {
    take_mask(request, pdu);
    return request;
  }
  for (const FunctionRow& row : kModbusFunctions) {
    if (row.code != request.function || row.kind != FunctionRow::Kind::write_one) continue;
    request.writes = {.table = row.table, .first = word_at(pdu, 1), .count = 1};
    take_single(request, pdu);
    return request;
  }
  if (pdu.size() < kAddressed) return request;
  if (request.function == static_cast<std::uint8_t>(OtherFunction::read_and_write)) {
    take_read_and_write(request, pdu);
    return request;
  }
  for (const FunctionRow& row : kModbusFunctions) {
    if (row.code != request.function) continue;
    const RegisterSpan span{.table = row.table, .first = word_at(pdu, 1), .count = word_at(pdu, 3)};
    switch (row.kind) {
      case FunctionRow::Kind::read:
        request.reads = span;
        request.is_well_formed = pdu.size() == kAddressed;
        break;
      case FunctionRow::Kind::write_one: break;  // handled above
      case FunctionRow::Kind::write_several:
        request.writes = span;
        take_values(request, pdu, kAddressed);
        break;
    }
  }
  return request;
}

ModbusRequest parse_request_frame(Bytes frame) {
  constexpr std::size_t kAddressAndChecksum = 3;
  if (frame.size() <= kAddressAndChecksum) return {};
  return parse_request(frame.subspan(1, frame.size() - kAddressAndChecksum));
}

std::size_t reply_size(const ModbusRequest& request) {
  constexpr std::size_t kAroundData = 5;
  constexpr std::size_t kEcho = 8;
  constexpr std::size_t kEchoOfMask = 10;
  if (request.mask) return kEchoOfMask;
  if (!request.reads) return request.writes ? kEcho : pty::kRtuMaxFrame;
  const std::size_t count = request.reads->count;
  const std::size_t data = is_table_of_bits(request.reads->table) ? (count + 7) / 8 : 2 * count;
  return std::min(kAroundData + data, pty::kRtuMaxFrame);
}

Table table_in(const RegisterBank& bank, Table table) {
  return table == Table::input && !bank.map().has(Table::input) ? Table::holding : table;
}

std::vector<std::uint16_t> written_words(const RegisterBank& bank, const ModbusRequest& request) {
  if (!request.mask) return request.words;
  std::uint16_t word = 0;
  if (read_request(bank, request.writes->table, request.writes->first, std::span(&word, 1))) return {};
  const RegisterMask& mask = *request.mask;
  return {static_cast<std::uint16_t>((word & mask.kept) | (mask.set & ~mask.kept))};
}

}  // namespace understudy::emulator::world
