#include "emulator/world/stations/server.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

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
constexpr std::size_t kMaxWritten = 1968;  // bits; each occupies a word while the request is served
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

/// Returns an exception reply. `row` is null if the function is not supported.
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

/// A function that the model supports: the table that it uses in this model, and the model's limit.
struct Service {
  const FunctionRow& row;
  Table table;
  std::size_t max;

  bool is_of_bits() const { return is_table_of_bits(table); }
  std::size_t bytes_for(std::size_t quantity) const {
    return is_of_bits() ? (quantity + 7) / 8 : 2 * quantity;
  }
};

/// Returns the first part of the request: the function and the following four bytes.
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
  if (quantity < 1 || quantity > service.max)
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
  if (quantity < 1 || quantity > service.max)
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

/// Returns null if the function is not implemented, or if the model does not support it.
const FunctionRow* find_function(const RtuRules& rules, std::uint8_t code) {
  if (std::find(rules.functions.begin(), rules.functions.end(), code) == rules.functions.end())
    return nullptr;
  for (const FunctionRow& row : kModbusFunctions) {
    if (row.code == code) return &row;
  }
  return nullptr;
}

Service service_of(const FunctionRow& row, const RtuRules& rules, const RegisterMap& map) {
  Service service{.row = row, .table = row.table, .max = static_cast<std::size_t>(row.max)};
  // A model without input registers serves its holding registers instead.
  if (row.table == Table::input && !map.has(Table::input)) service.table = Table::holding;
  for (const FunctionLimit& limit : rules.limits) {
    if (limit.code == row.code) service.max = std::min(service.max, static_cast<std::size_t>(limit.max));
  }
  return service;
}

// --- functions that are more than one access to one table ---------------------------------------------

ModbusReply return_query(Pdu pdu) {
  if (pdu.size() < 3) return exception(pdu, nullptr, bad_value(Cause::bad_length));
  if (pdu_word(pdu, 1) != 0) return exception(pdu, nullptr, bad_value(Cause::unknown_function));
  ModbusReply reply;
  std::copy(pdu.begin(), pdu.end(), reply.pdu.begin());
  reply.size = pdu.size();
  return reply;
}

ModbusReply report_server_id(const RtuRules& rules, Pdu pdu) {
  if (pdu.size() != 1) return exception(pdu, nullptr, bad_value(Cause::bad_length));
  constexpr std::size_t kMax = 200;
  constexpr std::uint8_t kRuns = 0xFF;
  const std::string_view id = rules.server_id.substr(0, kMax);
  ModbusReply reply;
  reply.pdu[0] = pdu[0];
  reply.pdu[1] = static_cast<std::uint8_t>(id.size() + 1);
  std::copy(id.begin(), id.end(), reply.pdu.begin() + 2);
  reply.size = 2 + id.size();
  reply.pdu[reply.size++] = kRuns;
  return reply;
}

/// Sets and clears bits in a holding register: (old value AND and-mask) OR (or-mask AND NOT and-mask).
ModbusReply mask_write(RegisterBank& bank, Pdu pdu) {
  constexpr std::size_t kSize = 7;
  const FunctionRow& writing = *function_for(Table::holding, FunctionRow::Kind::write_one);
  if (pdu.size() != kSize) return exception(pdu, &writing, bad_value(Cause::bad_length));
  const std::uint16_t address = pdu_word(pdu, 1);
  const std::uint16_t kept = pdu_word(pdu, 3);
  std::uint16_t word = 0;
  Objection refused = read_request(bank, Table::holding, address, std::span(&word, 1));
  word = static_cast<std::uint16_t>((word & kept) | (pdu_word(pdu, 5) & ~kept));
  if (!refused) refused = write_request(bank, Table::holding, address, std::span(&word, 1), true);
  if (refused) return exception(pdu, &writing, refused);
  ModbusReply reply;
  std::copy(pdu.begin(), pdu.end(), reply.pdu.begin());
  reply.size = kSize;
  return reply;
}

/// Writes registers, then reads registers, in one request. If the read cannot be executed, the request is
/// refused before anything is written.
ModbusReply read_and_write(RegisterBank& bank, const RtuRules& rules, Pdu pdu) {
  constexpr std::size_t kBeforeData = 10;
  constexpr std::size_t kMaxWords = 121;
  const FunctionRow& reading = *function_for(Table::holding, FunctionRow::Kind::read);
  const auto refuse = [&](const Objection& objection, std::size_t part) {
    ModbusReply reply = exception(pdu, &reading, objection);
    if (pdu.size() >= part + 4) {
      reply.refused.first = pdu_word(pdu, part);
      reply.refused.count = pdu_word(pdu, part + 2);
    }
    return reply;
  };
  if (pdu.size() < kBeforeData) return refuse(bad_value(Cause::bad_length), 1);
  const std::size_t count = pdu_word(pdu, 3);
  const std::size_t written = pdu_word(pdu, 7);
  std::size_t max = kMaxWordsRead;
  for (const FunctionLimit& limit : rules.limits) {
    if (limit.code == pdu[0]) max = static_cast<std::size_t>(limit.max);
  }
  if (count < 1 || count > max) return refuse(bad_value(Cause::bad_count), 1);
  if (written < 1 || written > std::min(max, kMaxWords)) return refuse(bad_value(Cause::bad_count), 5);
  if (pdu[9] != 2 * written || pdu.size() != kBeforeData + 2 * written)
    return refuse(bad_value(Cause::bad_length), 5);
  std::array<std::uint16_t, kMaxWordsRead> words;
  const auto read_words = std::span(words).first(count);
  const std::uint16_t first = pdu_word(pdu, 1);
  if (const Objection refused = read_request(bank, Table::holding, first, read_words))
    return refuse(refused, 1);
  std::array<std::uint16_t, kMaxWords> values;
  for (std::size_t i = 0; i < written; ++i) values[i] = pdu_word(pdu, kBeforeData + 2 * i);
  const Objection refused =
      write_request(bank, Table::holding, pdu_word(pdu, 5), std::span(values).first(written));
  if (refused) return refuse(refused, 5);
  if (const Objection late = read_request(bank, Table::holding, first, read_words)) return refuse(late, 1);
  ModbusReply reply;
  reply.pdu[0] = pdu[0];
  reply.pdu[1] = static_cast<std::uint8_t>(2 * count);
  reply.size = 2;
  for (const std::uint16_t word : read_words) put_word(reply, word);
  bank.read_answered({.table = Table::holding, .first = first, .count = count});
  return reply;
}

/// Reads objects of the device identification, either a stream of objects or a single one.
ModbusReply identify(const RtuRules& rules, Pdu pdu) {
  constexpr std::uint8_t kMeiType = 14;
  constexpr std::uint8_t kOne = 4;
  constexpr std::array<int, 4> kEnds{0, 0x02, 0x7F, 0xFF};  // the last objects: basic, regular, extended
  if (pdu.size() < 2 || pdu[1] != kMeiType)
    return exception(pdu, nullptr, bad_value(Cause::unknown_function));
  if (pdu.size() != 4) return exception(pdu, nullptr, bad_value(Cause::bad_length));
  const std::uint8_t category = pdu[2];
  if (category < 1 || category > kOne) return exception(pdu, nullptr, bad_value(Cause::bad_count));
  const auto has = [&](int id) {
    return std::any_of(rules.identity.begin(), rules.identity.end(),
                       [&](const IdentityObject& object) { return object.id == id; });
  };
  const int last_of_all = rules.identity.empty() ? 0 : rules.identity.back().id;
  const int level = last_of_all > kEnds[2] ? 3 : last_of_all > kEnds[1] ? 2 : 1;
  if (category == kOne && !has(pdu[3]))
    return exception(pdu, nullptr, {Refusal::no_register, Cause::no_register, pdu[3]});
  const int first = category == kOne || has(pdu[3]) ? pdu[3] : 0;
  const int last = category == kOne ? first : kEnds[category];
  ModbusReply reply;
  const std::array<std::uint8_t, 7> head{pdu[0], kMeiType, category, static_cast<std::uint8_t>(0x80 | level),
                                         0,      0,        0};
  std::copy(head.begin(), head.end(), reply.pdu.begin());
  reply.size = head.size();
  for (const IdentityObject& object : rules.identity) {
    if (object.id < first || object.id > last) continue;
    if (reply.size + 2 + object.text.size() > reply.pdu.size()) {
      reply.pdu[4] = 0xFF;  // more objects will follow
      reply.pdu[5] = object.id;
      break;
    }
    reply.pdu[reply.size++] = object.id;
    reply.pdu[reply.size++] = static_cast<std::uint8_t>(object.text.size());
    std::copy(object.text.begin(), object.text.end(),
              reply.pdu.begin() + static_cast<std::ptrdiff_t>(reply.size));
    reply.size += object.text.size();
    ++reply.pdu[6];
  }
  return reply;
}

ModbusReply serve_other(RegisterBank& bank, const RtuRules& rules, OtherFunction function, Pdu pdu) {
  switch (function) {
    case OtherFunction::diagnostics: return return_query(pdu);
    case OtherFunction::server_id: return report_server_id(rules, pdu);
    case OtherFunction::mask_write: return mask_write(bank, pdu);
    case OtherFunction::read_and_write: return read_and_write(bank, rules, pdu);
    case OtherFunction::identification: return identify(rules, pdu);
  }
  return exception(pdu, nullptr, bad_value(Cause::unknown_function));
}

/// Returns null if the model does not support the function.
const OtherFunctionRow* find_other(const RtuRules& rules, std::uint8_t code) {
  if (std::find(rules.functions.begin(), rules.functions.end(), code) == rules.functions.end())
    return nullptr;
  for (const OtherFunctionRow& row : kOtherModbusFunctions) {
    if (static_cast<std::uint8_t>(row.code) == code) return &row;
  }
  return nullptr;
}

}  // namespace

ModbusReply serve(Device& device, std::span<const std::uint8_t> pdu) {
  const std::uint8_t code = pdu.empty() ? 0 : pdu[0];
  const RtuRules& rules = *device.model().rtu;
  const FunctionRow* const row = find_function(rules, code);
  const ModbusStation* const station = device.modbus();
  const OtherFunctionRow* const other = find_other(rules, code);
  if (other != nullptr && (station == nullptr || station->knows(code)))
    return serve_other(*device.register_bank(), rules, other->code, pdu);
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
