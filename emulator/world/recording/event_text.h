#pragma once

#include <string>

#include "emulator/world/recording/recording.h"

namespace understudy::emulator::world {

/// What happened to the world, as a sentence's part: "input feeder.DIN_10=1". Empty for what goes over a
/// line, which a capture shows, and for the end.
std::string text_of(const RecordedEvent& event, const World& world);

}  // namespace understudy::emulator::world
