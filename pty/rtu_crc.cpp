#include "pty/rtu_crc.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace understudy::pty {
namespace {

constexpr std::array<std::uint16_t, 256> make_table() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned value = 0; value < table.size(); ++value) {
    unsigned crc = value;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) != 0 ? (crc >> 1) ^ 0xA001u : crc >> 1;
    table[value] = static_cast<std::uint16_t>(crc);
  }
  return table;
}

constexpr auto kTable = make_table();

constexpr std::size_t kAtOnce = 4;  // bytes

/// Row n has the effect of each byte value on the checksum if n more bytes follow it.
constexpr auto kTables = [] {
  std::array<std::array<std::uint16_t, 256>, kAtOnce> tables{kTable};
  for (std::size_t behind = 1; behind < kAtOnce; ++behind) {
    for (std::size_t value = 0; value < 256; ++value) {
      const unsigned crc = tables[behind - 1][value];
      tables[behind][value] = static_cast<std::uint16_t>((crc >> 8) ^ kTable[crc & 0xFFu]);
    }
  }
  return tables;
}();

}  // namespace

std::uint16_t rtu_crc(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0xFFFF;
  for (; bytes.size() >= kAtOnce; bytes = bytes.subspan(kAtOnce)) {
    crc ^= static_cast<unsigned>(bytes[0] | bytes[1] << 8);
    crc = kTables[3][crc & 0xFFu] ^ kTables[2][crc >> 8] ^ kTables[1][bytes[2]] ^ kTables[0][bytes[3]];
  }
  for (const std::uint8_t byte : bytes) crc = (crc >> 8) ^ kTable[(crc ^ byte) & 0xFFu];
  return static_cast<std::uint16_t>(crc);
}

bool rtu_crc_ok(std::span<const std::uint8_t> frame) {
  // The checksum of a message with its own checksum appended is zero.
  return frame.size() >= kRtuMinFrame && rtu_crc(frame) == 0;
}

void append_rtu_crc(std::vector<std::uint8_t>& frame) {
  const std::size_t size = frame.size();
  frame.resize(size + 2);
  append_rtu_crc(frame, size);
}

std::size_t append_rtu_crc(std::span<std::uint8_t> buffer, std::size_t size) {
  assert(buffer.size() >= size + 2);
  const std::uint16_t crc = rtu_crc(buffer.first(size));
  buffer[size] = static_cast<std::uint8_t>(crc & 0xFF);
  buffer[size + 1] = static_cast<std::uint8_t>(crc >> 8);
  return size + 2;
}

}  // namespace understudy::pty
