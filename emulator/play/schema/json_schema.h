// The forms of files as JSON Schema (draft 7), which editors check and complete YAML files by.
#pragma once

#include <string>

namespace understudy::emulator::play {

/// Of bench files and of scenario files, as text.
std::string bench_schema();
std::string scenario_schema();

}  // namespace understudy::emulator::play
