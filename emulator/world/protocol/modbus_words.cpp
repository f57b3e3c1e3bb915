#include "emulator/world/protocol/modbus_words.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/device/command_window.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/world/protocol/refusal_words.h"
#include "emulator/world/stations/line_station.h"
#include "emulator/world/stations/server.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::world {

namespace {

constexpr std::size_t kMaxBytesShown = 32;
constexpr std::size_t kMaxRegisters = 8;
constexpr std::uint8_t kExceptionBit = 0x80;

int frame_word(std::span<const std::uint8_t> frame, std::size_t at) { return frame[at] << 8 | frame[at + 1]; }

std::string number_of(int address) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "0x%04X", static_cast<unsigned>(address) & 0xFFFFU);
  return text.data();
}

/// Returns null if no device on the line has that address.
const Device* device_at(const LineStations& stations, std::uint8_t address) {
  for (const auto& station : stations) {
    const ModbusStation* const modbus = station->device().modbus();
    if (modbus != nullptr && modbus->addressing(address) != Addressing::ignore) return &station->device();
  }
  return nullptr;
}

/// Lists consecutive words or bits by the names of their registers, with their values if these are known.
class WordsText {
 public:
  /// `values` has the form that it has in a frame: bits are packed.
  WordsText(const Device* device, Table table, int first, int count, std::span<const std::uint8_t> values)
      : device_(device), table_(table), first_(first), count_(count), values_(values) {}

  std::string text() const {
    std::string text;
    std::size_t named = 0;
    for (int i = 0; i < count_; ++named) {
      if (named == kMaxRegisters)
        return text + ", and " + std::to_string(count_ - i) +
               (is_table_of_bits(table_) ? " more bits" : " more words");
      text += (named == 0 ? "" : ", ") + next(i, named == 0);
    }
    return text;
  }

 private:
  bool has_values() const { return !values_.empty(); }
  int value_at(int i) const {
    const auto at = static_cast<std::size_t>(i);
    return is_table_of_bits(table_) ? values_[at / 8] >> at % 8 & 1 : frame_word(values_, 2 * at);
  }

  /// Returns the text of the register at word `i` and moves `i` past it. The first text also names the
  /// device.
  std::string next(int& i, bool is_first) const {
    const int word = i++;
    const RegisterBank* const bank = device_ == nullptr ? nullptr : device_->register_bank();
    const Place place =
        bank == nullptr ? Place{} : bank->at(table_, static_cast<std::uint16_t>(first_ + word));
    if (!place) {
      return number_of(first_ + word) + (has_values() ? " = " + std::to_string(value_at(word)) : "");
    }
    const RegisterRow& row = *place.row;
    std::string name = (is_first ? device_->name() + "." : "") + RegisterMap::name_of(row, place.index);
    const bool is_first_word = place.address() == first_ + word;
    if (is_32_bit(row.type) && is_first_word && word + 1 < count_) {
      ++i;
      if (!has_values()) return name;
      const auto first = static_cast<std::uint16_t>(value_at(word));
      const auto second = static_cast<std::uint16_t>(value_at(word + 1));
      const std::uint32_t bits = bits_of_wire(row, first, second, bank->low_word_first());
      return name + " = " + value_text(value_of(bits, row.type), row.type);
    }
    if (place.part != Place::Part::whole) {
      name += place.part == Place::Part::low ? row.low_half : row.high_half;
    }
    if (!has_values()) return name;
    const std::uint32_t bits = wire_word(row, static_cast<std::uint16_t>(value_at(word)));
    const Value value = place.part == Place::Part::whole ? value_of(bits, row.type) : Value{bits};
    return name + " = " + std::to_string(value);
  }

  const Device* device_;
  Table table_;
  int first_;
  int count_;
  std::span<const std::uint8_t> values_;
};

/// Returns null for a function that is not described in words.
const FunctionRow* function_of(std::span<const std::uint8_t> frame) {
  for (const FunctionRow& row : kModbusFunctions) {
    if (row.code == frame[1]) return &row;
  }
  return nullptr;
}

/// Returns the table that a function accesses. A model without input registers uses its holding registers for
/// it.
Table table_of(const Device* device, const FunctionRow& function) {
  const RegisterBank* const bank = device == nullptr ? nullptr : device->register_bank();
  const bool has_it = bank != nullptr && bank->map().has(function.table);
  return function.table == Table::input && !has_it ? Table::holding : function.table;
}

std::size_t bytes_for(Table table, int count) {
  return static_cast<std::size_t>(is_table_of_bits(table) ? (count + 7) / 8 : 2 * count);
}

/// Returns where a request begins: "coil 0x0010 ", "input registers 0x0010 ". For holding registers, it is
/// only the number.
std::string place_text(Table table, int first, int count) {
  std::string what;
  switch (table) {
    case Table::holding: return number_of(first) + " ";
    case Table::input: what = "input register"; break;
    case Table::coil: what = "coil"; break;
    case Table::discrete: what = "discrete input"; break;
  }
  return what + (count == 1 ? " " : "s ") + number_of(first) + " ";
}

/// The values that a request writes, packed like the data of a frame. written() returns nothing if the
/// request is incomplete or invalid.
struct WrittenValues {
  int count = 0;
  std::vector<std::uint8_t> bytes{};
};
std::optional<WrittenValues> written(const FunctionRow& function, std::span<const std::uint8_t> request) {
  const bool is_bits = is_table_of_bits(function.table);
  if (function.kind == FunctionRow::Kind::write_one) {
    if (request.size() != 8) return std::nullopt;
    constexpr int kOn = 0xFF00;
    const int value = frame_word(request, 4);
    if (!is_bits) return WrittenValues{1, {request[4], request[5]}};
    if (value != kOn && value != 0) return std::nullopt;
    return WrittenValues{1, {static_cast<std::uint8_t>(value == kOn ? 1 : 0)}};
  }
  const int count = frame_word(request, 4);
  const std::size_t bytes = bytes_for(function.table, count);
  if (count == 0 || request[6] != bytes || request.size() != 9 + bytes) return std::nullopt;
  const auto values = request.subspan(7, bytes);
  return WrittenValues{count, {values.begin(), values.end()}};
}

std::vector<std::uint16_t> words_in(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint16_t> words;
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2)
    words.push_back(static_cast<std::uint16_t>(frame_word(bytes, at)));
  return words;
}

/// Returns "exception 3 (illegal data value): feeder.Aaxis_Speed accepts 0 to 32768, not 65000".
std::string refusal_text(const LineStations& stations, std::span<const std::uint8_t> request,
                         std::span<const std::uint8_t> reply) {
  const std::string text = "exception " + exception_text(reply[2]);
  const Device* const device = device_at(stations, reply[0]);
  const bool is_asked =
      request.size() >= 4 && request[0] == reply[0] && (request[1] | kExceptionBit) == reply[1];
  if (device == nullptr || !is_asked) return text;
  const std::string why = why_refused(*device, request, reply[2]);
  return why.empty() ? text : text + ": " + why;
}

}  // namespace

std::string hex_text(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size() && i < kMaxBytesShown; ++i) {
    std::array<char, 4> byte{};
    std::snprintf(byte.data(), byte.size(), i == 0 ? "%02X" : " %02X", bytes[i]);
    text += byte.data();
  }
  if (bytes.size() > kMaxBytesShown) text += " ... (" + std::to_string(bytes.size()) + " bytes)";
  return text;
}

std::string exception_text(int exception) {
  constexpr std::array<const char*, 7> kNames{"",
                                              "illegal function",
                                              "illegal data address",
                                              "illegal data value",
                                              "device failure",
                                              "acknowledge",
                                              "device busy"};
  const bool is_named = exception > 0 && exception < static_cast<int>(kNames.size());
  return std::to_string(exception) +
         (is_named ? std::string(" (") + kNames[static_cast<std::size_t>(exception)] + ")" : std::string());
}

bool is_write(std::span<const std::uint8_t> frame) {
  // These functions write coils or registers, mask a register, or read and write at once.
  constexpr std::array<std::uint8_t, 6> kWrites{0x05, 0x06, 0x0F, 0x10, 0x16, 0x17};
  return frame.size() >= 2 && std::find(kWrites.begin(), kWrites.end(), frame[1]) != kWrites.end();
}

std::string modbus_command_text(const LineStations& stations, std::span<const std::uint8_t> request) {
  if (request.size() < 8) return {};
  const Device* const device = device_at(stations, request[0]);
  const FunctionRow* const function = function_of(request);
  const bool may_be_one = device != nullptr && device->model().window != nullptr && function != nullptr &&
                          function->kind != FunctionRow::Kind::read && function->table == Table::holding;
  if (!may_be_one || !pty::rtu_crc_ok(request)) return {};
  const auto values = written(*function, request);
  if (!values) return {};
  const auto command = window_text(*device, Table::holding, frame_word(request, 2), words_in(values->bytes));
  return command ? device->name() + ": " + *command : std::string();
}

std::string modbus_request_text(const LineStations& stations, std::span<const std::uint8_t> request) {
  if (request.size() < 8 || !pty::rtu_crc_ok(request)) return hex_text(request);
  const Device* const device = device_at(stations, request[0]);
  const std::string whom =
      device == nullptr || request[0] == 0 ? "station " + std::to_string(request[0]) + ": " : std::string();
  const FunctionRow* const function = function_of(request);
  if (function == nullptr) return whom + hex_text(request);
  const int first = frame_word(request, 2);
  const Table table = table_of(device, *function);
  const auto reported = [&](const char* verb, int count, std::span<const std::uint8_t> values) {
    return whom + verb + place_text(table, first, count) +
           WordsText(device, table, first, count, values).text();
  };
  if (function->kind == FunctionRow::Kind::read) {
    return request.size() == 8 ? reported("read ", frame_word(request, 4), {}) : whom + hex_text(request);
  }
  const auto values = written(*function, request);
  if (const std::string command = modbus_command_text(stations, request); !command.empty()) {
    return whom + "command " + place_text(table, first, values->count) + command;
  }
  return values ? reported("write ", values->count, values->bytes) : whom + hex_text(request);
}

std::string modbus_reply_text(const LineStations& stations, std::span<const std::uint8_t> request,
                              std::span<const std::uint8_t> reply) {
  if (reply.size() < 5 || !pty::rtu_crc_ok(reply)) return hex_text(reply);
  if ((reply[1] & kExceptionBit) != 0 && reply.size() == 5) return refusal_text(stations, request, reply);
  const FunctionRow* const function = function_of(reply);
  if (function == nullptr) return hex_text(reply);
  if (function->kind != FunctionRow::Kind::read) return reply.size() == 8 ? "done" : hex_text(reply);
  const bool is_asked = request.size() == 8 && request[0] == reply[0] && request[1] == reply[1];
  if (!is_asked) return hex_text(reply);
  const int count = frame_word(request, 4);
  if (reply[2] != bytes_for(function->table, count) || reply.size() != 5U + reply[2]) return hex_text(reply);
  const Device* const device = device_at(stations, reply[0]);
  return WordsText(device, table_of(device, *function), frame_word(request, 2), count,
                   reply.subspan(3, reply[2]))
      .text();
}

}  // namespace understudy::emulator::world
