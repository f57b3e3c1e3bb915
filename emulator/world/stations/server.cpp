#include "emulator/world/stations/server.h"

#include <algorithm>

#include "emulator/device/register_map/access.h"

namespace understudy::emulator::world {

namespace {

constexpr std::size_t kMaxReadWords = 125;
constexpr std::size_t kMaxWriteWords = 123;

std::uint16_t word_at(std::span<const std::uint8_t> pdu, std::size_t at) {
  return static_cast<std::uint16_t>(pdu[at] << 8 | pdu[at + 1]);
}

void put_word(ModbusReply& reply, std::uint16_t word) {
  reply.pdu[reply.size++] = static_cast<std::uint8_t>(word >> 8);
  reply.pdu[reply.size++] = static_cast<std::uint8_t>(word);
}

ModbusReply exception(std::uint8_t function, ModbusException code) {
  ModbusReply reply;
  reply.pdu[0] = function | 0x80;
  reply.pdu[1] = static_cast<std::uint8_t>(code);
  reply.size = 2;
  return reply;
}

ModbusException exception_for(Refusal refusal) {
  return refusal == Refusal::bad_value ? ModbusException::illegal_data_value
                                       : ModbusException::illegal_data_address;
}

/// The beginning of the request comes back: function, and the four bytes after it.
ModbusReply echo(std::span<const std::uint8_t> pdu) {
  ModbusReply reply;
  std::copy_n(pdu.begin(), 5, reply.pdu.begin());
  reply.size = 5;
  return reply;
}

ModbusReply read_registers(const RegisterBank& bank, std::span<const std::uint8_t> pdu) {
  const std::uint8_t function = pdu[0];
  if (pdu.size() != 5) return exception(function, ModbusException::illegal_data_value);
  const std::size_t quantity = word_at(pdu, 3);
  if (quantity < 1 || quantity > kMaxReadWords)
    return exception(function, ModbusException::illegal_data_value);
  std::array<std::uint16_t, kMaxReadWords> words;
  // The input registers of models that do not tell them apart are the holding registers.
  const Refusal refusal = read_words(bank, Table::holding, word_at(pdu, 1), std::span(words).first(quantity));
  if (refusal != Refusal::none) return exception(function, exception_for(refusal));
  ModbusReply reply;
  reply.pdu[reply.size++] = function;
  reply.pdu[reply.size++] = static_cast<std::uint8_t>(2 * quantity);
  for (std::size_t i = 0; i < quantity; ++i) put_word(reply, words[i]);
  return reply;
}

ModbusReply write_register(RegisterBank& bank, std::span<const std::uint8_t> pdu) {
  if (pdu.size() != 5) return exception(pdu[0], ModbusException::illegal_data_value);
  const std::array<std::uint16_t, 1> word{word_at(pdu, 3)};
  const Refusal refusal = write_words(bank, Table::holding, word_at(pdu, 1), word);
  return refusal == Refusal::none ? echo(pdu) : exception(pdu[0], exception_for(refusal));
}

ModbusReply write_registers(RegisterBank& bank, std::span<const std::uint8_t> pdu) {
  if (pdu.size() < 6) return exception(pdu[0], ModbusException::illegal_data_value);
  const std::size_t quantity = word_at(pdu, 3);
  if (quantity < 1 || quantity > kMaxWriteWords || pdu[5] != 2 * quantity || pdu.size() != 6 + 2 * quantity) {
    return exception(pdu[0], ModbusException::illegal_data_value);
  }
  std::array<std::uint16_t, kMaxWriteWords> words;
  for (std::size_t i = 0; i < quantity; ++i) words[i] = word_at(pdu, 6 + 2 * i);
  const Refusal refusal =
      write_words(bank, Table::holding, word_at(pdu, 1), std::span(words).first(quantity));
  return refusal == Refusal::none ? echo(pdu) : exception(pdu[0], exception_for(refusal));
}

}  // namespace

ModbusReply serve(Device& device, std::span<const std::uint8_t> pdu) {
  const std::uint8_t function = pdu.empty() ? 0 : pdu[0];
  const auto known = device.model().rtu->functions;
  if (std::find(known.begin(), known.end(), function) == known.end()) {
    return exception(function, ModbusException::illegal_function);
  }
  RegisterBank& bank = *device.register_bank();
  switch (function) {
    case 0x03:
    case 0x04: return read_registers(bank, pdu);
    case 0x06: return write_register(bank, pdu);
    case 0x10: return write_registers(bank, pdu);
    default: return exception(function, ModbusException::illegal_function);
  }
}

}  // namespace understudy::emulator::world
