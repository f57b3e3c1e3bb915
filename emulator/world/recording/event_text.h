#pragma once

#include <string>

#include "emulator/world/recording/recording.h"

namespace understudy::emulator::world {

/// Returns an event as part of a sentence: "input feeder.DIN_10=1". Returns an empty text for the end event,
/// and for traffic on a line, because a capture shows that traffic.
std::string text_of(const RecordedEvent& event, const World& world);

}  // namespace understudy::emulator::world
