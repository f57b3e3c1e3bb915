// The chain looks up what the manual leaves open about modules and motion in the rows of choices.h, as the
// device does.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>

#include "emulator/models/slim/rules/options.h"

namespace understudy::emulator::models::slim {

/// The chosen option of each row; at first our own, the first of the row.
struct ChainOptions {
  std::array<std::uint8_t, std::size(kChoices)> numbers{};  // chosen option of each row

  constexpr bool chose(const Option& option) const { return numbers[option.choice] == option.number; }
  constexpr void choose(const Option& option) { numbers[option.choice] = option.number; }
  /// Returns the number of the chosen option, for a row whose options are numbers.
  constexpr int number(std::size_t row) const { return number_of(kChoices[row], numbers[row]); }

  bool operator==(const ChainOptions&) const = default;
};

}  // namespace understudy::emulator::models::slim
