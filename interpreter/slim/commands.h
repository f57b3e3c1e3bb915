// SLIM's commands as data: every syntax form in the manual, in its order. The parser, the help texts and
// `describe` read these rows. To add a command, add a row.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "interpreter/slim/command_row.h"
#include "interpreter/slim/rows_of_one_motor.h"
#include "interpreter/slim/rows_of_several_motors.h"

namespace understudy::interpreter::slim {

inline constexpr std::array<CommandRow, rows::kOneMotor.size() + rows::kSeveralMotors.size()> kCommands = [] {
  std::array<CommandRow, rows::kOneMotor.size() + rows::kSeveralMotors.size()> all{};
  std::ranges::copy(rows::kSeveralMotors, std::ranges::copy(rows::kOneMotor, all.begin()).out);
  return all;
}();

/// Returns the index of a row. A form that is not in the manual is a compile error.
consteval int row_of(std::string_view syntax) {
  for (std::size_t i = 0; i < kCommands.size(); ++i) {
    if (kCommands[i].syntax == syntax) return static_cast<int>(i);
  }
  throw "the manual has no such form";
}

}  // namespace understudy::interpreter::slim
