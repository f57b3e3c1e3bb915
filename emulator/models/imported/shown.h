// The registers that show other state than what was written to them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "emulator/models/imported/description.h"

namespace understudy::emulator::models::imported {

/// A register, or bits of it, that show other state.
struct ShownPart {
  enum class What : std::uint8_t { axis, input, following, comparison } what = What::axis;
  Spot spot{};
  std::size_t number = 0;  // number of the axis, the terminal, the following or the comparison
  View view = View::position;
};

/// Returns true if what a spot shows may change with each pulse of an axis (Varies::while_moving). `shown` is
/// that of all registers. The two sides of a comparison do not show one themselves.
bool moves(const Description& description, const std::vector<std::vector<ShownPart>>& shown,
           const Spot& spot);

/// Returns the shown parts of each register of the list.
std::vector<std::vector<ShownPart>> shown_parts(const Description& description);

}  // namespace understudy::emulator::models::imported
