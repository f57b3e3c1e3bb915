// A bench as text that parse_bench() reads, whatever it was made from: with its programs and memories inside,
// and without links, so that it is the same bench in any folder.
#pragma once

#include <string>

#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

/// JSON, which is YAML as well; on one line. Two benches with the same text are the same.
std::string to_text(const Bench& bench);

}  // namespace understudy::emulator::world
