// Levels of inputs as text: 1, 0, on, off; of analog inputs 2.5V, 2500mV, or millivolts without a unit;
// of those that are counted in no unit a whole number.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "emulator/device/model.h"

namespace understudy::emulator::world {

/// Nothing for text that is not a level of such an input. demand_level() decides whether the input can have
/// it.
std::optional<std::int64_t> parse_level(std::string_view text, TerminalRow::Kind kind);
/// "on or off", "a voltage such as 2.5V", "a number".
std::string_view level_example(TerminalRow::Kind kind);

}  // namespace understudy::emulator::world
