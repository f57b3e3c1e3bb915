// Modbus requests and replies in tests: hexadecimal text, words, and a device's replies.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/models/models.h"
#include "emulator/world/stations/server.h"

namespace understudy::emulator::world {

using Bytes = std::vector<std::uint8_t>;
using Words = std::vector<std::uint16_t>;

/// Converts text such as "01 03 D5" to bytes; spaces do not matter.
inline Bytes hex(std::string_view text) {
  Bytes bytes;
  std::string digits;
  for (const char c : text) {
    if (c == ' ') continue;
    digits += c;
    if (digits.size() < 2) continue;
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits, nullptr, 16)));
    digits.clear();
  }
  return bytes;
}

/// Converts bytes to text such as "01 03 D5".
template <typename Range>
std::string text(const Range& bytes) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string out;
  for (const std::uint8_t byte : bytes) {
    if (!out.empty()) out += ' ';
    out += kDigits[byte >> 4];
    out += kDigits[byte & 0xF];
  }
  return out;
}

inline void put(Bytes& bytes, std::size_t word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  bytes.push_back(static_cast<std::uint8_t>(word));
}

inline Bytes read_pdu(std::uint8_t function, std::size_t address, std::size_t quantity) {
  Bytes pdu{function};
  put(pdu, address);
  put(pdu, quantity);
  return pdu;
}

inline Bytes write_request(std::size_t address, std::size_t word) {
  Bytes pdu{0x06};
  put(pdu, address);
  put(pdu, word);
  return pdu;
}

inline Bytes write_request(std::size_t address, const Words& words) {
  Bytes pdu{0x10};
  put(pdu, address);
  put(pdu, words.size());
  pdu.push_back(static_cast<std::uint8_t>(2 * words.size()));
  for (const std::uint16_t word : words) put(pdu, word);
  return pdu;
}

/// Returns the PDU of the reply, as text.
inline std::string answer(Device& device, const Bytes& pdu) {
  const ModbusReply reply = serve(device, pdu);
  return text(Bytes(reply.pdu.begin(), reply.pdu.begin() + static_cast<std::ptrdiff_t>(reply.size)));
}

/// Returns the words at an address, or none if the read is refused.
inline Words read(Device& device, std::size_t address, std::size_t quantity) {
  const ModbusReply reply = serve(device, read_pdu(0x03, address, quantity));
  Words words;
  if (reply.pdu[0] != 0x03) return words;
  for (std::size_t i = 2; i + 1 < reply.size; i += 2) {
    words.push_back(static_cast<std::uint16_t>(reply.pdu[i] << 8 | reply.pdu[i + 1]));
  }
  return words;
}

inline std::unique_ptr<Device> make_simple2(DeviceSettings settings = {}) {
  return make_device(*find_model(models::all_models(), "simple2-r3"), settings);
}

}  // namespace understudy::emulator::world
