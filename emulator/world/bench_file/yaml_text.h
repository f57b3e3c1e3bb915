// Writes a node as YAML, for files that are generated from other files.
#pragma once

#include <string>

#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// Returns the node on one line: "{ drop: feeder, nth: 2 }".
std::string flow_text(const YamlFields& node);
/// Returns a key and its value, "bench: { ... }", with a line ending. If the line would be too long, the
/// value is split into several lines. Every line begins with `indentation`, except the first one, which
/// begins with `lead` ("  - ").
std::string block_text(const std::string& key, const YamlFields& value, const std::string& indentation,
                       const std::string& lead);

}  // namespace understudy::emulator::world
