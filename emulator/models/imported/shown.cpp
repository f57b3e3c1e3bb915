#include "emulator/models/imported/shown.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "emulator/device/register_map/row.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::models::imported {

std::vector<std::vector<ShownPart>> shown_parts(const Description& description) {
  std::vector<std::vector<ShownPart>> all(description.registers.size());
  const auto add = [&](const ShownPart& part) { all[part.spot.number].push_back(part); };
  for (std::size_t axis = 0; axis < description.axes.size(); ++axis) {
    for (std::size_t view = 0; view < kViews; ++view) {
      if (const auto& spot = description.axes[axis].views[view])
        add({.spot = *spot, .number = axis, .view = static_cast<View>(view)});
    }
  }
  for (std::size_t i = 0; i < description.terminals.size(); ++i) {
    const Terminal& terminal = description.terminals[i];
    if (terminal.is_input && terminal.spot)
      add({.what = ShownPart::What::input, .spot = *terminal.spot, .number = i});
  }
  for (std::size_t i = 0; i < description.followings.size(); ++i)
    add({.what = ShownPart::What::following, .spot = description.followings[i].spot, .number = i});
  for (std::size_t i = 0; i < description.comparisons.size(); ++i)
    add({.what = ShownPart::What::comparison, .spot = description.comparisons[i].spot, .number = i});
  return all;
}

namespace {

bool overlap(const Spot& a, const Spot& b) {
  return a.is_whole() || b.is_whole() || (a.bit < b.bit + b.width && b.bit < a.bit + a.width);
}

}  // namespace

bool moves(const Description& description, const std::vector<std::vector<ShownPart>>& shown,
           const Spot& spot) {
  const auto side_moves = [&](const Quantity& side) {
    return side.spot && moves(description, shown, *side.spot);
  };
  return std::any_of(shown[spot.number].begin(), shown[spot.number].end(), [&](const ShownPart& part) {
    if (!overlap(part.spot, spot)) return false;
    switch (part.what) {
      case ShownPart::What::axis: return changes_of(part.view) == Varies::while_moving;
      case ShownPart::What::input: return false;      // a tick runs for each change of an input
      case ShownPart::What::following: return false;  // changes only in the ticks of the following itself
      case ShownPart::What::comparison: {
        const Comparison& comparison = description.comparisons[part.number];
        return side_moves(comparison.left) || side_moves(comparison.right);
      }
    }
    return false;
  });
}

}  // namespace understudy::emulator::models::imported
