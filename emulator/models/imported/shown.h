// Which registers show something that is not simply what has been written to them.
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
  std::size_t number = 0;  // of the axis, the terminal, the following or the comparison
  View view = View::position;
};

/// Whether what a spot shows may change with each pulse of an axis (Varies::while_moving). `shown`: of all
/// registers. A relation's sides show none themselves.
bool moves(const Description& description, const std::vector<std::vector<ShownPart>>& shown,
           const Spot& spot);

/// All of them, for each register of the list.
std::vector<std::vector<ShownPart>> shown_parts(const Description& description);

}  // namespace understudy::emulator::models::imported
