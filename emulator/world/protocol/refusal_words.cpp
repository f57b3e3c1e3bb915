#include "emulator/world/protocol/refusal_words.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/world/protocol/modbus_request.h"

namespace understudy::emulator::world {

namespace {

constexpr int kIllegalFunction = 1;
constexpr int kIllegalAddress = 2;
constexpr int kIllegalValue = 3;
constexpr std::uint8_t kWriteCoil = 0x05;

std::string hex(int address) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "0x%04X", static_cast<unsigned>(address) & 0xFFFFU);
  return text.data();
}

/// The registers that a request reads or writes.
struct Wanted {
  Table table = Table::holding;
  int first = 0;
  int count = 0;
  bool is_write = false;
  std::vector<std::uint16_t> values{};  // for a write; empty if they are not known
};

class Reason {
 public:
  Reason(const Device& device, const RegisterBank& bank, const Wanted& wanted)
      : device_(device), bank_(bank), wanted_(wanted) {}

  std::string of_address() const {
    const MapPolicy& policy = bank_.map_policy();
    const bool is_pair_whole = wanted_.is_write ? policy.halves == MapPolicy::Halves::come_whole
                                                : policy.read_halves == MapPolicy::ReadHalves::come_whole;
    for (int i = 0; i < wanted_.count; ++i) {
      const int address = wanted_.first + i;
      const Place place =
          address < 65536 ? bank_.at(wanted_.table, static_cast<std::uint16_t>(address)) : Place{};
      if (!place && has_nothing_there(address)) return nothing_at(address);
      if (!place) continue;
      if (wanted_.is_write && place.row->message != nullptr)
        return "a message to " + name_of(place) + " begins at " + hex(place.row->address) +
               " and ends in its window";
      if (wanted_.is_write && place.row->access == Access::read) return name_of(place) + " is read-only";
      if (!wanted_.is_write && place.row->access == Access::write) return name_of(place) + " is write-only";
      if (is_pair_whole && is_cut(place, i))
        return name_of(place) + " has 32 bits, and its two words must be in one request";
    }
    return "";
  }

  std::string of_value() const {
    if (wanted_.values.empty()) return "";
    for (int i = 0; i < wanted_.count; ++i) {
      const Place place = bank_.at(wanted_.table, static_cast<std::uint16_t>(wanted_.first + i));
      if (!place || place.row->message != nullptr) return "";
      const auto value = value_at(place, i);
      if (value && !is_in_range(*place.row, *value))
        return name_of(place) + " accepts " + range_text(*place.row) + ", not " +
               value_text(*value, place.row->type);
    }
    return "";
  }

 private:
  std::string name_of(const Place& place) const {
    return device_.name() + "." + RegisterMap::name_of(*place.row, place.index);
  }

  bool has_nothing_there(int address) const {
    const auto unmapped = bank_.map_policy().unmapped;
    const bool is_before_end = address < bank_.map().end_of(wanted_.table);
    return wanted_.is_write || unmapped == MapPolicy::Unmapped::refused ||
           (unmapped == MapPolicy::Unmapped::holes_read_zero && !is_before_end);
  }

  /// Returns true if the request contains only one of the register's two words.
  bool is_cut(const Place& place, int i) const {
    if (place.part == Place::Part::whole) return false;
    const bool is_second = place.is_second_word(bank_.low_word_first());
    return is_second ? i == 0 : i + 1 == wanted_.count;
  }

  /// Returns the value for a register, if the request contains the whole register, beginning at this word.
  std::optional<Value> value_at(const Place& place, int i) const {
    const RegisterRow& row = *place.row;
    const auto word = [&](int at) { return wanted_.values[static_cast<std::size_t>(at)]; };
    if (place.part == Place::Part::whole) return value_of(wire_word(row, word(i)), row.type);
    if (is_cut(place, i) || place.is_second_word(bank_.low_word_first())) return std::nullopt;
    return value_of(bits_of_wire(row, word(i), word(i + 1), bank_.low_word_first()), row.type);
  }

  /// Returns "0x2710 feeder.NAME exists from firmware 1.52 on" if only a device with newer firmware has a
  /// register there, otherwise an empty text.
  std::string newer_at(int address) const {
    if (address > 0xFFFF) return "";
    const Place newer = bank_.map().at(wanted_.table, static_cast<std::uint16_t>(address), UINT16_MAX,
                                       bank_.low_word_first());
    if (!newer) return "";
    return hex(address) + " " + name_of(newer) + " exists from firmware " + version_text(newer.row->since) +
           " on";
  }

  /// Returns "there is no register at 0x270F; the nearest are 0x2700 NAME and 0x3000 NAME".
  std::string nothing_at(int address) const {
    const RegisterRow* below = nullptr;
    const RegisterRow* above = nullptr;
    int below_at = -1;
    int above_at = 65536;
    for (const RegisterRow& row : bank_.map().rows()) {
      if (row.table != wanted_.table || !bank_.has_row(row)) continue;
      const int stride = std::max(row.stride, 1);
      const int behind =
          address < row.address ? 0 : std::min(row.count, (address - row.address) / stride + 1);
      const int last = row.address + (behind - 1) * stride;
      const int next = row.address + behind * stride;
      if (behind > 0 && last > below_at) below_at = last, below = &row;
      if (behind < row.count && next < above_at) above_at = next, above = &row;
    }
    if (const std::string newer = newer_at(address); !newer.empty()) return newer;
    const char* const what = is_table_of_bits(wanted_.table) ? "bit" : "register";
    const std::string none = std::string("there is no ") + what + " at " + hex(address);
    const auto reported = [&](const RegisterRow& row, int at) {
      return hex(at) + " " + RegisterMap::name_of(row, (at - row.address) / std::max(row.stride, 1));
    };
    if (below == nullptr && above == nullptr) return none;
    if (below == nullptr) return none + "; the first is " + reported(*above, above_at);
    if (above == nullptr) return none + "; the last is " + reported(*below, below_at);
    return none + "; the nearest are " + reported(*below, below_at) + " and " + reported(*above, above_at);
  }

  const Device& device_;
  const RegisterBank& bank_;
  const Wanted& wanted_;
};

std::string functions_of(const RtuRules& rules) {
  std::string text;
  for (const std::uint8_t code : rules.functions) text += (text.empty() ? "" : ", ") + std::to_string(code);
  return text;
}

/// Returns the maximum number of registers in a request with this function, or 0 if the model does not define
/// a limit.
int limit_of(const RtuRules& rules, std::uint8_t code) {
  for (const FunctionLimit& limit : rules.limits)
    if (limit.code == code) return limit.max;
  return 0;
}

/// Returns what is wrong with the number of registers, or an empty text.
std::string count_reason(const Device& device, std::uint8_t code, const Wanted& wanted) {
  if (wanted.count == 0) return "it requests 0 registers";
  const int max = limit_of(*device.model().rtu, code);
  if (max == 0 || wanted.count <= max) return "";
  return std::to_string(wanted.count) + (is_table_of_bits(wanted.table) ? " bits" : " registers") +
         " are too many for one request; " + device.name() + " accepts " + std::to_string(max);
}

/// Returns what is wrong with the form of a request whose addresses are correct.
std::string form_reason(const ModbusRequest& asked, std::span<const std::uint8_t> request) {
  const bool is_bit = asked.writes && asked.function == kWriteCoil && request.size() == 8;
  if (is_bit) return "a single bit can be set to 0x0000 or 0xFF00, not " + hex(request[4] << 8 | request[5]);
  if (!asked.writes || asked.writes->count == 1) return "its length is wrong";
  return "its byte count does not fit " + std::to_string(asked.writes->count) + " values";
}

}  // namespace

std::string why_refused(const Device& device, std::span<const std::uint8_t> request, int exception) {
  const RegisterBank* const bank = device.register_bank();
  if (bank == nullptr || !device.model().rtu || request.size() < 4) return "";
  if (exception == kIllegalFunction) {
    return "function " + std::to_string(request[1]) + " is not supported; " + device.name() + " has " +
           functions_of(*device.model().rtu);
  }
  const ModbusRequest asked = parse_request_frame(request);
  // The parts, in the order in which the device checks them.
  std::vector<Wanted> parts;
  const auto add = [&](const std::optional<RegisterSpan>& span, bool is_write) {
    if (!span) return;
    parts.push_back({.table = table_in(*bank, span->table),
                     .first = span->first,
                     .count = static_cast<int>(span->count),
                     .is_write = is_write});
  };
  add(asked.mask ? asked.writes : asked.reads, false);  // a mask applies to the value that was read
  add(asked.writes, true);
  if (exception == kIllegalAddress && asked.is_well_formed) {
    for (const Wanted& part : parts) {
      if (const std::string why = Reason(device, *bank, part).of_address(); !why.empty()) return why;
    }
  }
  if (exception != kIllegalValue) return "";
  for (const Wanted& part : parts) {
    if (const std::string why = count_reason(device, asked.function, part); !why.empty()) return why;
  }
  if (parts.empty()) return "";
  if (!asked.is_well_formed) return form_reason(asked, request);
  if (!asked.writes) return "";
  parts.back().values = written_words(*bank, asked);
  return Reason(device, *bank, parts.back()).of_value();
}

}  // namespace understudy::emulator::world
