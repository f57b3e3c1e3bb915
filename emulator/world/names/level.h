// Levels of inputs as text: 1, 0, on, off; for analog inputs 2.5V, 2500mV, or millivolts without a unit; for
// counted inputs an integer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/device/model.h"

namespace understudy::emulator::world {

/// Returns nothing if the text is not a level for this kind of input. require_level() checks whether the
/// input can have the level.
std::optional<std::int64_t> parse_level(std::string_view text, TerminalRow::Kind kind);
/// Returns the level as parse_level() reads it: "on", "2500mV", "12".
std::string level_text(const TerminalRow& row, std::int64_t level);
/// Returns "on or off", "a voltage such as 2.5V" or "a number".
std::string_view level_example(TerminalRow::Kind kind);

}  // namespace understudy::emulator::world
