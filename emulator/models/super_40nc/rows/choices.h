// SUPER-40NC: what its manual leaves open, and what we chose. docs/fidelity/super-40nc.md is generated from
// these rows, and a bench can override a row with `choices: { ID: OPTION }`.
#pragma once

#include <array>
#include <cstddef>

#include "base/choices.h"
#include "emulator/models/super_40nc/rows/choices_of_motion.h"
#include "emulator/models/super_40nc/rows/choices_of_programs.h"
#include "emulator/models/super_40nc/rows/choices_of_registers.h"
#include "interpreter/super_40nc/choices.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr auto kChoices = [] {
  namespace language = interpreter::super_40nc;
  std::array<ChoiceRow, std::size(kRegisterChoices) + std::size(language::kChoices) +
                            std::size(kProgramChoices) + std::size(kMotionChoices)>
      all{};
  std::size_t next = 0;
  for (const ChoiceRow& row : kRegisterChoices) all[next++] = row;
  for (const ChoiceRow& row : language::kChoices) all[next++] = row;
  for (const ChoiceRow& row : kProgramChoices) all[next++] = row;
  for (const ChoiceRow& row : kMotionChoices) all[next++] = row;
  return all;
}();

/// The position of the languages' rows in the table.
inline constexpr std::size_t kFirstOfLanguages = std::size(kRegisterChoices);

}  // namespace understudy::emulator::models::super_40nc
