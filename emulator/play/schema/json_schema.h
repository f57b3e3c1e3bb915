// The forms of files as JSON Schema (draft 7), which editors check and complete YAML files by.
#pragma once

#include <span>
#include <string>

#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/form.h"

namespace understudy::emulator::play {

/// Of bench files and of scenario files, as text. What the memories of these models can hold is listed.
std::string bench_schema(ModelList models);
std::string scenario_schema(ModelList models);
/// Of files of another kind, which have these keys.
std::string file_schema(const std::string& title, std::span<const world::KeyRow> keys);
/// Of the scenarios of one bench: where its devices, lines, axes, inputs and registers are named, other names
/// do not suit. Conditions are texts, which only `check` understands.
std::string scenario_schema(ModelList models, const world::Bench& bench);

}  // namespace understudy::emulator::play
