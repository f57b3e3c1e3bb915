// Determines which registers show something other than their written values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "emulator/models/imported/description.h"

namespace understudy::emulator::models::imported {

/// A register, or some of its bits, that shows other state.
struct ShownPart {
  enum class What : std::uint8_t { axis, input, following, comparison } what = What::axis;
  Spot spot{};
  std::size_t number = 0;  // number of the axis, terminal, following or comparison
  View view = View::position;
};

/// Returns true if the value of a spot may change with each pulse of an axis (Varies::while_moving). `shown`
/// contains all registers. The operands of a comparison are never comparisons themselves.
bool moves(const Description& description, const std::vector<std::vector<ShownPart>>& shown,
           const Spot& spot);

/// Returns the shown parts of each register in the list.
std::vector<std::vector<ShownPart>> shown_parts(const Description& description);

}  // namespace understudy::emulator::models::imported
