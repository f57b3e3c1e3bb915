// SLIM: looks up the options of choices.h: `chose(option("thrust", "runs_at_vj"))`, or, for a row whose
// options are numbers, `number(numbers("history_length"))`. An unknown row or option is a compile error.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/choices.h"
#include "emulator/models/slim/rules/choices.h"

namespace understudy::emulator::models::slim {

consteval Option option(std::string_view id, std::string_view name) { return option_of(kChoices, id, name); }

/// Returns a row whose options are numbers. It is a compile error if an option is not a number.
consteval std::size_t numbers(std::string_view id) { return numbers_row(kChoices, id); }

}  // namespace understudy::emulator::models::slim
