#include "emulator/device/terminals.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/model.h"

namespace understudy::emulator {

namespace {

using What = TerminalSight::What;
using Kind = TerminalRow::Kind;

std::int64_t word_of(const Device& device, bool is_of_inputs, int first, int count) {
  if (!is_of_inputs) return device.terminals()->output_word(first, count);
  std::uint32_t word = 0;
  for (int i = 0; i < count; ++i) word |= std::uint32_t{device.input(first + i) != 0} << i;
  return word;
}

}  // namespace

std::vector<TerminalSight> terminal_sights(const Device& device) {
  const auto rows = device.model().terminals;
  std::vector<TerminalSight> sights;
  for (std::size_t i = 0; i < rows.size();) {
    const int first = static_cast<int>(i);
    const TerminalGroup* const group = find_group_of(device.model(), first);
    TerminalSight sight{.name = std::string(rows[i].name), .kind = rows[i].kind, .first = first};
    if (group != nullptr) {
      sight.what = What::word;
      sight.name = group->name;
      sight.count = group->count;
    }
    i += static_cast<std::size_t>(sight.count);
    if (!device.terminals()->has_terminal(first)) continue;
    sights.push_back(sight);
    if (sight.kind != Kind::pulse_out) continue;
    sight.what = What::pulses;
    sight.name += ".pulses";
    sights.push_back(std::move(sight));
  }
  return sights;
}

std::int64_t value_of(const Device& device, const TerminalSight& sight) {
  switch (sight.what) {
    case What::word: return word_of(device, is_input(sight.kind), sight.first, sight.count);
    case What::pulses: return device.terminals()->output_pulses(sight.first);
    case What::level: break;
  }
  if (is_input(sight.kind)) return device.input(sight.first);
  if (is_analog(sight.kind)) return device.terminals()->analog_level(sight.first);
  return device.terminals()->output(sight.first) ? 1 : 0;
}

std::int64_t value_of(const Device& device, const TerminalGroup& group) {
  const TerminalRow& row = device.model().terminals[static_cast<std::size_t>(group.first)];
  return word_of(device, is_input(row.kind), group.first, group.count);
}

}  // namespace understudy::emulator
