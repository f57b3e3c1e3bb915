// Shows what a test suite has exercised on the devices.
#pragma once

#include <string>
#include <string_view>

#include "emulator/world/coverage/touched.h"

namespace understudy::emulator::play {

/// Returns an HTML page that needs no other files and no network: what no run has exercised (the most serious
/// gaps first), followed by the tables of each model with their counts. Equal reports result in equal pages.
std::string touched_page(const world::TouchedReport& report, std::string_view version);

/// Returns a line for each model and for the most serious gaps: "coverage of simple2-r3: bits 12 of 40,
/// registers 30 of 412".
std::string touched_text(const world::TouchedReport& report);

}  // namespace understudy::emulator::play
