#include "emulator/models/imported/shown.h"

#include <cstddef>
#include <vector>

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

}  // namespace understudy::emulator::models::imported
