// The forms of files as JSON Schema (draft 7), which editors check and complete YAML files by.
#pragma once

#include <string>

#include "emulator/world/bench/bench.h"

namespace understudy::emulator::play {

/// Of bench files and of scenario files, as text.
std::string bench_schema();
std::string scenario_schema();
/// Of the scenarios of one bench: where its devices, lines, axes, inputs and registers are named, other names
/// do not suit. Conditions are texts, which only `check` understands.
std::string scenario_schema(const world::Bench& bench);

}  // namespace understudy::emulator::play
