#include "emulator/play/scenario/requests.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/names/names.h"
#include "emulator/world/stations/server.h"

namespace understudy::emulator::play {

namespace {

bool is_whole_32(const Target& target) {
  return target.place && is_32_bit(target.place->place.row->type) &&
         target.place->place.part == Place::Part::whole;
}

std::uint32_t bits_in(const Target& target, std::span<const std::uint16_t> words, bool low_word_first) {
  const RegisterRow kPlain;
  const RegisterRow& row = target.place ? *target.place->place.row : kPlain;
  if (words.size() == 1) return wire_word(row, words[0]);
  return bits_of_wire(row, words[0], words[1], low_word_first);
}

using FunctionKind = world::FunctionRow::Kind;

/// Returns how many registers or bits a request may read or write (MODBUS Application Protocol V1.1b3, 6.1 to
/// 6.12).
int most_of(Table table, FunctionKind kind) {
  const world::FunctionRow* const function = world::function_for(table, kind);
  return function != nullptr ? function->max : 1;
}

bool is_of_one_table(const Words& a, const Words& b) { return a.device == b.device && a.table == b.table; }

}  // namespace

Table table_of(const Target& target) { return target.place ? target.place->place.row->table : target.table; }

bool can_be_sent(const Target& target) {
  return world::function_for(table_of(target), FunctionKind::write_one) != nullptr;
}

Limits limits_of(const Target& target) {
  if (!target.place) return {0, is_table_of_bits(target.table) ? 1 : UINT16_MAX};
  if (target.place->bit >= 0) return {0, (Value{1} << target.place->width) - 1};
  if (target.place->place.part != Place::Part::whole) return {0, UINT16_MAX};
  const TypeLimits limits = emulator::limits_of(target.place->place.row->type);
  return {limits.lowest, limits.highest};
}

Words words_of(const Target& target, bool low_word_first) {
  const Table table = table_of(target);
  if (!target.place) return {target.device, table, target.address, 1};
  const Place& place = target.place->place;
  if (is_whole_32(target)) return {target.device, table, place.address(), 2};
  const bool is_second = is_second_word(place, low_word_first);
  return {target.device, table, static_cast<std::uint16_t>(place.address() + (is_second ? 1 : 0)), 1};
}

std::vector<Request> read_requests(std::span<const Words> entries) {
  std::vector<Request> requests;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Words& next = entries[i];
    if (!requests.empty()) {
      Words& last = requests.back().words;
      const int end = std::max(last.end(), next.end());
      if (is_of_one_table(next, last) && next.first >= last.first && next.first <= last.end() &&
          end - last.first <= most_of(next.table, FunctionKind::read)) {
        last.count = end - last.first;
        requests.back().entries.push_back(i);
        continue;
      }
    }
    requests.push_back({next, {i}});
  }
  return requests;
}

std::vector<Request> write_requests(std::span<const Words> entries,
                                    const std::function<bool(std::size_t)>& stands_alone) {
  std::vector<Request> requests;
  bool is_open = false;  // true if the last request can still be extended
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Words& next = entries[i];
    const bool is_alone = stands_alone(i);
    if (is_open && !is_alone) {
      Words& last = requests.back().words;
      if (is_of_one_table(next, last) && next.first == last.end() &&
          last.count + next.count <= most_of(next.table, FunctionKind::write_several)) {
        last.count += next.count;
        requests.back().entries.push_back(i);
        continue;
      }
    }
    requests.push_back({next, {i}});
    is_open = !is_alone;
  }
  return requests;
}

std::optional<world::Number> number_of(const Target& target, Value value) {
  if (!target.place || !target.place->is_real()) return value;
  const double number = emulator::number_of(*target.place, value);
  if (std::isnan(number)) return std::nullopt;
  return world::finite_number(number);
}

std::optional<Value> value_for(const Target& target, world::Number number) {
  if (target.place && target.place->is_real()) return value_of_number(*target.place, number.real());
  if (number.is_whole()) return number.whole();
  constexpr double kLargest = 9e15;  // doubles represent all whole numbers up to this one exactly
  const double real = number.real();
  if (std::abs(real) > kLargest || std::floor(real) != real) return std::nullopt;
  return static_cast<Value>(real);
}

Value value_in(const Target& target, std::span<const std::uint16_t> words, bool low_word_first) {
  const std::uint32_t bits = bits_in(target, words, low_word_first);
  if (!target.place) return bits;
  if (target.place->bit >= 0) return Value{bits} >> target.place->bit & limits_of(target).high;
  if (target.place->place.part != Place::Part::whole) return bits;
  return value_of(bits, target.place->place.row->type);
}

std::vector<std::uint16_t> words_with(const Target& target, Value value, bool low_word_first,
                                      std::span<const std::uint16_t> present) {
  const Limits limits = limits_of(target);
  if (value < limits.low || value > limits.high) {
    throw world::NameError(target.name + ": " + std::to_string(value) + " does not fit; expected " +
                           std::to_string(limits.low) + " to " + std::to_string(limits.high));
  }
  auto bits = static_cast<std::uint32_t>(value);
  if (target.place && target.place->bit >= 0) {
    const auto mask = static_cast<std::uint32_t>(limits.high << target.place->bit);
    bits = (bits_in(target, present, low_word_first) & ~mask) | static_cast<std::uint32_t>(value)
                                                                    << target.place->bit;
  }
  const auto low = static_cast<std::uint16_t>(bits);
  if (!target.place) return {low};
  const RegisterRow& row = *target.place->place.row;
  if (!is_whole_32(target)) return {wire_word(row, low)};
  const auto words = wire_words(row, bits, low_word_first);
  return {words.begin(), words.end()};
}

}  // namespace understudy::emulator::play
