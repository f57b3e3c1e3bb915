// Writes file formats as JSON Schema (draft 7), which editors use to check and complete YAML files.
#pragma once

#include <span>
#include <string>

#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::play {

/// Returns the schema of bench files and of scenario files. It lists the memory contents of these models.
std::string bench_schema(ModelList models);
std::string scenario_schema(ModelList models);
/// Returns the schema of another kind of file, with these keys.
std::string file_schema(const std::string& title, std::span<const world::Key> keys);
/// Returns the schema of scenarios for a specific bench. It accepts only the names of its devices, lines,
/// axes, inputs and registers. Conditions are plain texts, which only `check` can verify.
std::string scenario_schema(ModelList models, const world::Bench& bench);

}  // namespace understudy::emulator::play
