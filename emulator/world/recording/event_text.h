#pragma once

#include <string>

#include "emulator/world/recording/recording.h"

namespace understudy::emulator::world {

/// What happened to the world, as part of a sentence: "input feeder.DIN_10=1". Empty for the end, and for
/// what goes over a line, which a capture shows.
std::string text_of(const RecordedEvent& event, const World& world);

}  // namespace understudy::emulator::world
