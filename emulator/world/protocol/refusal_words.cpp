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

#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/world/stations/server.h"

namespace understudy::emulator::world {

namespace {

constexpr int kIllegalFunction = 1;
constexpr int kIllegalAddress = 2;
constexpr int kIllegalValue = 3;

std::string hex(int address) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "0x%04X", static_cast<unsigned>(address) & 0xFFFFU);
  return text.data();
}

/// The registers that a request reads or writes.
struct Wanted {
  const FunctionRow& function;
  Table table = Table::holding;
  int first = 0;
  int count = 0;
  std::span<const std::uint8_t> values{};  // as in the frame; empty for a read request

  bool is_write() const { return function.kind != FunctionRow::Kind::read; }
  int value_at(int i) const {
    const auto at = static_cast<std::size_t>(i);
    if (!is_table_of_bits(table)) return values[2 * at] << 8 | values[2 * at + 1];
    // A single coil is written with a word.
    if (function.kind == FunctionRow::Kind::write_one) return values[0] != 0 ? 1 : 0;
    return values[at / 8] >> at % 8 & 1;
  }
};

class Reason {
 public:
  Reason(const Device& device, const RegisterBank& bank, const Wanted& wanted)
      : device_(device), bank_(bank), wanted_(wanted) {}

  std::string of_address() const {
    const MapPolicy& policy = bank_.map_policy();
    const bool is_pair_whole = wanted_.is_write() ? policy.halves == MapPolicy::Halves::come_whole
                                                  : policy.read_halves == MapPolicy::ReadHalves::come_whole;
    for (int i = 0; i < wanted_.count; ++i) {
      const int address = wanted_.first + i;
      const Place place =
          address < 65536 ? bank_.at(wanted_.table, static_cast<std::uint16_t>(address)) : Place{};
      if (!place && has_nothing_there(address)) return nothing_at(address);
      if (!place) continue;
      if (wanted_.is_write() && place.row->message != nullptr)
        return "a message to " + name_of(place) + " begins at " + hex(place.row->address) +
               " and ends in its window";
      if (wanted_.is_write() && place.row->access == Access::read) return name_of(place) + " is read-only";
      if (!wanted_.is_write() && place.row->access == Access::write) return name_of(place) + " is write-only";
      if (is_pair_whole && is_cut(place, i))
        return name_of(place) + " has 32 bits, and its two words must be in one request";
    }
    return "";
  }

  std::string of_value() const {
    if (!wanted_.is_write()) return "";
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
    return wanted_.is_write() || unmapped == MapPolicy::Unmapped::refused ||
           (unmapped == MapPolicy::Unmapped::holes_read_zero && !is_before_end);
  }

  /// Returns true if the request contains only one of the register's two words.
  bool is_cut(const Place& place, int i) const {
    if (place.part == Place::Part::whole) return false;
    const bool is_second = place.is_second_word(bank_.low_word_first());
    return is_second ? i == 0 : i + 1 == wanted_.count;
  }

  /// Returns the value that a register gets, if the request begins it at this word and contains all of it.
  std::optional<Value> value_at(const Place& place, int i) const {
    const RegisterRow& row = *place.row;
    const auto word = [&](int at) { return static_cast<std::uint16_t>(wanted_.value_at(at)); };
    if (place.part == Place::Part::whole) return value_of(wire_word(row, word(i)), row.type);
    if (is_cut(place, i) || place.is_second_word(bank_.low_word_first())) return std::nullopt;
    return value_of(bits_of_wire(row, word(i), word(i + 1), bank_.low_word_first()), row.type);
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

const FunctionRow* function_of(std::uint8_t code) {
  for (const FunctionRow& row : kModbusFunctions)
    if (row.code == code) return &row;
  return nullptr;
}

std::string functions_of(const RtuRules& rules) {
  std::string text;
  for (const std::uint8_t code : rules.functions) text += (text.empty() ? "" : ", ") + std::to_string(code);
  return text;
}

/// Returns the maximum number of registers that a request of this function may have, or 0 if the model has no
/// limit of its own.
int limit_of(const RtuRules& rules, std::uint8_t code) {
  for (const FunctionLimit& limit : rules.limits)
    if (limit.code == code) return limit.max;
  return 0;
}

}  // namespace

std::string why_refused(const Device& device, std::span<const std::uint8_t> request, int exception) {
  const RegisterBank* const bank = device.register_bank();
  if (bank == nullptr || !device.model().rtu || request.size() < 4) return "";
  const RtuRules& rules = *device.model().rtu;
  const std::uint8_t code = request[1];
  if (exception == kIllegalFunction)
    return "function " + std::to_string(code) + " is not supported; " + device.name() + " has " +
           functions_of(rules);
  const FunctionRow* const function = function_of(code);
  if (function == nullptr || request.size() < 8) return "";
  const auto word = [&](std::size_t at) { return request[at] << 8 | request[at + 1]; };
  const bool is_one = function->kind == FunctionRow::Kind::write_one;
  const bool has_table = bank->map().has(function->table);
  Wanted wanted{.function = *function,
                .table = function->table == Table::input && !has_table ? Table::holding : function->table,
                .first = word(2),
                .count = is_one ? 1 : word(4)};
  if (exception == kIllegalValue && !is_one) {
    const int max = limit_of(rules, code);
    const std::string asked =
        std::to_string(wanted.count) + (is_table_of_bits(wanted.table) ? " bits" : " registers");
    if (wanted.count == 0) return "it requests 0 registers";
    if (max > 0 && wanted.count > max)
      return asked + " are too many for one request; " + device.name() + " accepts " + std::to_string(max);
  }
  const std::size_t bytes = is_table_of_bits(wanted.table) ? static_cast<std::size_t>(wanted.count + 7) / 8
                                                           : 2 * static_cast<std::size_t>(wanted.count);
  if (is_one) {
    if (is_table_of_bits(wanted.table) && word(4) != 0xFF00 && word(4) != 0)
      return exception == kIllegalValue ? "a single bit can be set to 0x0000 or 0xFF00, not " + hex(word(4))
                                        : "";
    wanted.values = request.subspan(4, 2);
  } else if (wanted.is_write()) {
    if (request.size() != 9 + bytes || request[6] != bytes)
      return exception == kIllegalValue
                 ? "its byte count does not fit " + std::to_string(wanted.count) + " values"
                 : "";
    wanted.values = request.subspan(7, bytes);
  }
  const Reason reason(device, *bank, wanted);
  if (exception == kIllegalAddress) return reason.of_address();
  return exception == kIllegalValue ? reason.of_value() : "";
}

}  // namespace understudy::emulator::world
