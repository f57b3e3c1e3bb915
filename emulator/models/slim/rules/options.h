// SLIM: the code looks up the options of choices.h with these, as in `chose(option("thrust", "runs_at_vj"))`.
// An unknown row or option is a compile error. For options that are numbers it looks up the row:
// `number(numbers("history_length"))`.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/choices.h"
#include "emulator/models/slim/rules/choices.h"

namespace understudy::emulator::models::slim {

consteval Option option(std::string_view id, std::string_view name) { return option_of(kChoices, id, name); }

/// Returns a row whose options are numbers; it is a compile error if one of them is not.
consteval std::size_t numbers(std::string_view id) { return numbers_row(kChoices, id); }

}  // namespace understudy::emulator::models::slim
