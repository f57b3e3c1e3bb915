// Simple2-R3: looks up the options of choices.h, as in `device.chose(option("aclr_again", "ignored"))`. An
// unknown row or option is a compile error. Options that every tick needs are looked up once, when the device
// is created.
#pragma once

#include <string_view>

#include "emulator/models/simple2_r3/choices.h"

namespace understudy::emulator::models::simple2_r3 {

consteval Option option(std::string_view id, std::string_view name) { return option_of(kChoices, id, name); }

}  // namespace understudy::emulator::models::simple2_r3
