// Writes a bench as text for parse_bench(), whatever the source of the bench. The text includes programs and
// memories but omits links, so it describes the same bench in any folder.
#pragma once

#include <string>

#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

/// Returns a line of JSON, which is also YAML. Two benches that have the same text are equal.
std::string to_text(const Bench& bench);

}  // namespace understudy::emulator::world
