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

using What = TerminalView::What;
using Kind = TerminalRow::Kind;

std::int64_t word_of(const Device& device, bool is_of_inputs, int first, int count) {
  if (!is_of_inputs) return device.terminals()->output_word(first, count);
  std::uint32_t word = 0;
  for (int i = 0; i < count; ++i) word |= std::uint32_t{device.input(first + i) != 0} << i;
  return word;
}

}  // namespace

std::vector<TerminalView> terminal_views(const Device& device) {
  const auto rows = device.model().terminals;
  std::vector<TerminalView> views;
  for (std::size_t i = 0; i < rows.size();) {
    const int first = static_cast<int>(i);
    const TerminalGroup* const group = find_group_of(device.model(), first);
    TerminalView view{.name = std::string(rows[i].name), .kind = rows[i].kind, .first = first};
    if (group != nullptr) {
      view.what = What::word;
      view.name = group->name;
      view.count = group->count;
    }
    i += static_cast<std::size_t>(view.count);
    if (!device.terminals()->has_terminal(first)) continue;
    views.push_back(view);
    if (view.kind != Kind::pulse_out) continue;
    view.what = What::pulses;
    view.name += ".pulses";
    views.push_back(std::move(view));
  }
  return views;
}

std::int64_t value_of(const Device& device, const TerminalView& view) {
  switch (view.what) {
    case What::word: return word_of(device, is_input(view.kind), view.first, view.count);
    case What::pulses: return device.terminals()->output_pulses(view.first);
    case What::level: break;
  }
  if (is_input(view.kind)) return device.input(view.first);
  if (is_analog(view.kind)) return device.terminals()->analog_level(view.first);
  return device.terminals()->output(view.first) ? 1 : 0;
}

std::int64_t value_of(const Device& device, const TerminalGroup& group) {
  const TerminalRow& row = device.model().terminals[static_cast<std::size_t>(group.first)];
  return word_of(device, is_input(row.kind), group.first, group.count);
}

}  // namespace understudy::emulator
