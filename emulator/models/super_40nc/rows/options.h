// SUPER-40NC: looks up the options of choices.h. An unknown row or option is a compile error.
#pragma once

#include <string_view>

#include "emulator/models/super_40nc/rows/choices.h"

namespace understudy::emulator::models::super_40nc {

consteval Option option(std::string_view id, std::string_view name) { return option_of(kChoices, id, name); }

}  // namespace understudy::emulator::models::super_40nc
