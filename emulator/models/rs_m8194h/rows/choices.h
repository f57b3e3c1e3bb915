// RS-M8194H: what its manual leaves open, and what we chose. docs/fidelity/rs-m8194h.md is generated from
// these rows.
#pragma once

#include <array>
#include <cstddef>

#include "base/choices.h"
#include "emulator/models/rs_m8194h/rows/choices_of_axes.h"
#include "emulator/models/rs_m8194h/rows/choices_of_events.h"
#include "emulator/models/rs_m8194h/rows/choices_of_macros.h"
#include "emulator/models/rs_m8194h/rows/choices_of_paths.h"
#include "emulator/models/rs_m8194h/rows/choices_of_requests.h"
#include "interpreter/rs_m8194h/choices.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr auto kChoices = [] {
  namespace language = interpreter::rs_m8194h;
  std::array<ChoiceRow, std::size(language::kChoices) + std::size(kMacroChoices) +
                            std::size(kRequestChoices) + std::size(kAxisChoices) + std::size(kPathChoices) +
                            std::size(kEventChoices)>
      all{};
  std::size_t next = 0;
  for (const ChoiceRow& row : language::kChoices) all[next++] = row;
  for (const ChoiceRow& row : kMacroChoices) all[next++] = row;
  for (const ChoiceRow& row : kRequestChoices) all[next++] = row;
  for (const ChoiceRow& row : kAxisChoices) all[next++] = row;
  for (const ChoiceRow& row : kPathChoices) all[next++] = row;
  for (const ChoiceRow& row : kEventChoices) all[next++] = row;
  return all;
}();

/// The position of the language's rows in the table.
inline constexpr std::size_t kFirstOfLanguage = 0;

}  // namespace understudy::emulator::models::rs_m8194h
