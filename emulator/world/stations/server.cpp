#include "emulator/world/stations/server.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator::world {

namespace {

constexpr std::size_t kMaxWordsRead = 125;
constexpr std::size_t kMaxWritten = 1968;  // bits, held in a word each while the request is served
constexpr std::uint16_t kOn = 0xFF00;
constexpr std::uint16_t kOff = 0x0000;

using Pdu = std::span<const std::uint8_t>;

std::uint16_t pdu_word(Pdu pdu, std::size_t at) {
  return static_cast<std::uint16_t>(pdu[at] << 8 | pdu[at + 1]);
}

void put_word(ModbusReply& reply, std::uint16_t word) {
  reply.pdu[reply.size++] = static_cast<std::uint8_t>(word >> 8);
  reply.pdu[reply.size++] = static_cast<std::uint8_t>(word);
}

ModbusException exception_for(const Objection& objection) {
  if (objection.cause == Cause::unknown_function) return ModbusException::illegal_function;
  switch (objection.refusal) {
    case Refusal::bad_value: return ModbusException::illegal_data_value;
    case Refusal::busy: return ModbusException::device_busy;
    case Refusal::failure: return ModbusException::device_failure;
    case Refusal::none:
    case Refusal::no_register: break;
  }
  return ModbusException::illegal_data_address;
}

/// Returns an exception reply. `row` is null if the function is not served.
ModbusReply exception(Pdu pdu, const FunctionRow* row, const Objection& objection) {
  const ModbusException code = exception_for(objection);
  ModbusReply reply;
  reply.pdu[0] = (pdu.empty() ? 0 : pdu[0]) | 0x80;
  reply.pdu[1] = static_cast<std::uint8_t>(code);
  reply.size = 2;
  RefusedRequest& refused = reply.refused;
  refused.function = pdu.empty() ? 0 : pdu[0];
  refused.exception = static_cast<int>(code);
  refused.objection = objection;
  if (row == nullptr) return reply;
  if (pdu.size() >= 3) refused.first = pdu_word(pdu, 1);
  if (row->kind == FunctionRow::Kind::write_one) {
    refused.count = 1;
  } else if (pdu.size() >= 5) {
    refused.count = pdu_word(pdu, 3);
  }
  return reply;
}

Objection bad_value(Cause cause) { return {Refusal::bad_value, cause, 0}; }

/// A function that the model serves: its table, with regard to the tables the model has, and its own limit.
struct Service {
  const FunctionRow& row;
  Table table;
  std::size_t most;

  bool is_of_bits() const { return is_table_of_bits(table); }
  std::size_t bytes_for(std::size_t quantity) const {
    return is_of_bits() ? (quantity + 7) / 8 : 2 * quantity;
  }
};

/// Returns the beginning of the request: the function and the four bytes after it.
ModbusReply echo(Pdu pdu) {
  ModbusReply reply;
  std::copy_n(pdu.begin(), 5, reply.pdu.begin());
  reply.size = 5;
  return reply;
}

ModbusReply read(RegisterBank& bank, const Service& service, Pdu pdu) {
  if (pdu.size() != 5) return exception(pdu, &service.row, bad_value(Cause::bad_length));
  const std::uint16_t first = pdu_word(pdu, 1);
  const std::size_t quantity = pdu_word(pdu, 3);
  if (quantity < 1 || quantity > service.most)
    return exception(pdu, &service.row, bad_value(Cause::bad_count));
  const std::size_t bytes = service.bytes_for(quantity);
  ModbusReply reply;
  reply.pdu[0] = pdu[0];
  reply.pdu[1] = static_cast<std::uint8_t>(bytes);
  reply.size = 2;
  if (service.is_of_bits()) {
    const auto packed = std::span(reply.pdu).subspan(2, bytes);
    const Objection refused = read_bits_request(bank, service.table, first, quantity, packed);
    if (refused) return exception(pdu, &service.row, refused);
    reply.size += bytes;
    bank.read_answered({.table = service.table, .first = first, .count = quantity});
    return reply;
  }
  std::array<std::uint16_t, kMaxWordsRead> words;
  const Objection refused = read_request(bank, service.table, first, std::span(words).first(quantity));
  if (refused) return exception(pdu, &service.row, refused);
  for (std::size_t i = 0; i < quantity; ++i) put_word(reply, words[i]);
  bank.read_answered({.table = service.table, .first = first, .count = quantity});
  return reply;
}

ModbusReply write_one(RegisterBank& bank, const Service& service, Pdu pdu) {
  if (pdu.size() != 5) return exception(pdu, &service.row, bad_value(Cause::bad_length));
  std::uint16_t word = pdu_word(pdu, 3);
  if (service.is_of_bits()) {
    if (word != kOn && word != kOff) return exception(pdu, &service.row, bad_value(Cause::bad_bit));
    word = word == kOn ? 1 : 0;
  }
  const Objection refused = write_request(bank, service.table, pdu_word(pdu, 1), std::span(&word, 1), true);
  return refused ? exception(pdu, &service.row, refused) : echo(pdu);
}

ModbusReply write_several(RegisterBank& bank, const Service& service, Pdu pdu) {
  if (pdu.size() < 6) return exception(pdu, &service.row, bad_value(Cause::bad_length));
  const std::size_t quantity = pdu_word(pdu, 3);
  if (quantity < 1 || quantity > service.most)
    return exception(pdu, &service.row, bad_value(Cause::bad_count));
  const std::size_t bytes = service.bytes_for(quantity);
  if (pdu[5] != bytes || pdu.size() != 6 + bytes)
    return exception(pdu, &service.row, bad_value(Cause::bad_length));
  std::array<std::uint16_t, kMaxWritten> words;
  for (std::size_t i = 0; i < quantity; ++i) {
    words[i] = service.is_of_bits() ? pdu[6 + i / 8] >> i % 8 & 1 : pdu_word(pdu, 6 + 2 * i);
  }
  const Objection refused =
      write_request(bank, service.table, pdu_word(pdu, 1), std::span(words).first(quantity));
  return refused ? exception(pdu, &service.row, refused) : echo(pdu);
}

/// Returns null if the function cannot be served, or if the model does not know it.
const FunctionRow* find_function(const RtuRules& rules, std::uint8_t code) {
  if (std::find(rules.functions.begin(), rules.functions.end(), code) == rules.functions.end())
    return nullptr;
  for (const FunctionRow& row : kModbusFunctions) {
    if (row.code == code) return &row;
  }
  return nullptr;
}

Service service_of(const FunctionRow& row, const RtuRules& rules, const RegisterMap& map) {
  Service service{.row = row, .table = row.table, .most = static_cast<std::size_t>(row.most)};
  // A model without input registers serves its holding registers instead.
  if (row.table == Table::input && !map.has(Table::input)) service.table = Table::holding;
  for (const FunctionLimit& limit : rules.limits) {
    if (limit.code == row.code) service.most = std::min(service.most, static_cast<std::size_t>(limit.most));
  }
  return service;
}

}  // namespace

ModbusReply serve(Device& device, std::span<const std::uint8_t> pdu) {
  const std::uint8_t code = pdu.empty() ? 0 : pdu[0];
  const RtuRules& rules = *device.model().rtu;
  const FunctionRow* const row = find_function(rules, code);
  const ModbusStation* const station = device.modbus();
  const bool is_known = row != nullptr && (station == nullptr || station->knows(code));
  if (!is_known) return exception(pdu, nullptr, bad_value(Cause::unknown_function));
  RegisterBank& bank = *device.register_bank();
  const Service service = service_of(*row, rules, bank.map());
  switch (row->kind) {
    case FunctionRow::Kind::read: return read(bank, service, pdu);
    case FunctionRow::Kind::write_one: return write_one(bank, service, pdu);
    case FunctionRow::Kind::write_several: return write_several(bank, service, pdu);
  }
  return exception(pdu, nullptr, bad_value(Cause::unknown_function));
}

}  // namespace understudy::emulator::world
