// Writes a bench as text for parse_bench(), whatever it was made from. The text includes programs and
// memories, and leaves out links, so it is the same bench in any folder.
#pragma once

#include <string>

#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

/// Returns one line of JSON, which is also YAML. Two benches with the same text are equal.
std::string to_text(const Bench& bench);

}  // namespace understudy::emulator::world
