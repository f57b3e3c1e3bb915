#include "emulator/world/protocol/modbus_words.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "emulator/device/command_window.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/world/protocol/modbus_request.h"
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

/// Lists consecutive words or bits by the names of their registers, with their values if they are known.
class WordsText {
 public:
  /// `values` has the same form as in a frame: bits are packed.
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

  /// Returns the text for the register at word `i` and advances `i` past it. The first text also contains the
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

/// Returns the table that a device uses for a span.
Table table_of(const Device* device, const RegisterSpan& span) {
  const RegisterBank* const bank = device == nullptr ? nullptr : device->register_bank();
  return bank != nullptr              ? table_in(*bank, span.table)
         : span.table == Table::input ? Table::holding
                                      : span.table;
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

/// Packs values like the data of a frame.
std::vector<std::uint8_t> packed(Table table, std::span<const std::uint16_t> words) {
  std::vector<std::uint8_t> bytes(bytes_for(table, static_cast<int>(words.size())));
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (is_table_of_bits(table)) {
      if (words[i] != 0) bytes[i / 8] = static_cast<std::uint8_t>(bytes[i / 8] | 1U << i % 8);
      continue;
    }
    bytes[2 * i] = static_cast<std::uint8_t>(words[i] >> 8U);
    bytes[2 * i + 1] = static_cast<std::uint8_t>(words[i]);
  }
  return bytes;
}

/// Returns "read 0x0E04 feeder.Cord_A" or, with values, "write 0x1001 feeder.Aaxis_Speed = 200".
std::string span_text(const char* verb, const Device* device, const RegisterSpan& span,
                      std::span<const std::uint8_t> values) {
  const Table table = table_of(device, span);
  const auto count = static_cast<int>(span.count);
  return verb + place_text(table, span.first, count) +
         WordsText(device, table, span.first, count, values).text();
}

/// Returns "exception 3 (illegal data value): feeder.Aaxis_Speed accepts 0 to 32768, not 65000".
std::string refusal_text(const Device* device, std::span<const std::uint8_t> request,
                         std::span<const std::uint8_t> reply) {
  const std::string text = "exception " + exception_text(reply[2]);
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
  // These functions write coils or registers, mask a register, or read and write in one request.
  constexpr std::array<std::uint8_t, 6> kWrites{0x05, 0x06, 0x0F, 0x10, 0x16, 0x17};
  return frame.size() >= 2 && std::find(kWrites.begin(), kWrites.end(), frame[1]) != kWrites.end();
}

std::vector<std::size_t> addressed_by(const LineStations& stations, std::span<const std::uint8_t> request) {
  std::vector<std::size_t> numbers;
  if (request.empty()) return numbers;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const ModbusStation* const modbus = stations[i]->device().modbus();
    if (modbus != nullptr && modbus->addressing(request[0]) != Addressing::ignore) numbers.push_back(i);
  }
  if (numbers.size() == 1) return numbers;
  const auto own = std::find_if(stations.begin(), stations.end(), [&](const auto& station) {
    return station->device().modbus() != nullptr && station->device().station_number() == int{request[0]};
  });
  if (own == stations.end()) return numbers;
  const auto number = static_cast<std::size_t>(own - stations.begin());
  std::erase(numbers, number);
  numbers.insert(numbers.begin(), number);
  return numbers;
}

std::string modbus_command_text(const Device* to, std::span<const std::uint8_t> request) {
  if (to == nullptr || to->model().window == nullptr || !pty::rtu_crc_ok(request)) return {};
  const ModbusRequest asked = parse_request_frame(request);
  if (asked.words.empty() || asked.writes->table != Table::holding) return {};
  const auto command = window_text(*to, Table::holding, asked.writes->first, asked.words);
  return command ? to->name() + ": " + *command : std::string();
}

std::string modbus_request_text(const Device* to, std::span<const std::uint8_t> request) {
  if (request.size() < 8 || !pty::rtu_crc_ok(request)) return hex_text(request);
  const std::string whom =
      to == nullptr || request[0] == 0 ? "station " + std::to_string(request[0]) + ": " : std::string();
  const ModbusRequest asked = parse_request_frame(request);
  if (!asked.is_well_formed) return whom + hex_text(request);
  const std::string read = asked.reads ? span_text("read ", to, *asked.reads, {}) : std::string();
  if (!asked.writes) return whom + read;
  const RegisterSpan& writes = *asked.writes;
  if (asked.mask) {
    return whom + span_text("mask ", to, writes, {}) + " AND " + number_of(asked.mask->kept) + " OR " +
           number_of(asked.mask->set);
  }
  const std::string command = modbus_command_text(to, request);
  const std::string written =
      command.empty()
          ? span_text("write ", to, writes, packed(writes.table, asked.words))
          : "command " + place_text(writes.table, writes.first, static_cast<int>(writes.count)) + command;
  return whom + written + (read.empty() ? "" : ", then " + read);
}

std::string modbus_reply_text(const Device* to, std::span<const std::uint8_t> request,
                              std::span<const std::uint8_t> reply) {
  if (reply.size() < 5 || !pty::rtu_crc_ok(reply)) return hex_text(reply);
  if ((reply[1] & kExceptionBit) != 0 && reply.size() == 5) return refusal_text(to, request, reply);
  const bool is_asked = request.size() >= 4 && request[0] == reply[0] && request[1] == reply[1];
  const ModbusRequest asked = is_asked ? parse_request_frame(request) : parse_request_frame(reply);
  // The answer to a write is the beginning of the request; the answer to a mask is the whole request.
  const std::size_t echoed = asked.function == static_cast<std::uint8_t>(OtherFunction::mask_write) ? 10 : 8;
  if (asked.writes && !asked.reads) return reply.size() == echoed ? "done" : hex_text(reply);
  if (!is_asked || !asked.reads || !asked.is_well_formed) return hex_text(reply);
  const RegisterSpan& reads = *asked.reads;
  const auto count = static_cast<int>(reads.count);
  if (reply[2] != bytes_for(reads.table, count) || reply.size() != 5U + reply[2]) return hex_text(reply);
  return WordsText(to, table_of(to, reads), reads.first, count, reply.subspan(3, reply[2])).text();
}

}  // namespace understudy::emulator::world
