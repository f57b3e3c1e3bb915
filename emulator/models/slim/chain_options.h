// What the manual leaves open about modules and their motion: the chain asks the rows of choices.h, as the
// device does.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>

#include "emulator/models/slim/options.h"

namespace understudy::emulator::models::slim {

/// Our options, the first of each row, until another one is chosen.
struct ChainOptions {
  std::array<std::uint8_t, std::size(kChoices)> numbers{};  // of each row's option in force

  constexpr bool chose(const Option& option) const { return numbers[option.choice] == option.number; }
  constexpr void choose(const Option& option) { numbers[option.choice] = option.number; }
  /// Of a row whose options are numbers.
  constexpr int number(std::size_t row) const { return number_of(kChoices[row], numbers[row]); }

  bool operator==(const ChainOptions&) const = default;
};

}  // namespace understudy::emulator::models::slim
