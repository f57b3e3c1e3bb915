// Writes a node as YAML again, for files that are generated from others.
#pragma once

#include <string>

#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// Returns the node on one line: "{ drop: feeder, nth: 2 }".
std::string flow_text(const YamlFields& node);
/// Returns a key and its value, "bench: { ... }", with a line end. A value that would make a line too long
/// gets several lines. Every line begins with `indentation`; the first one has `lead` instead ("  - ").
std::string block_text(const std::string& key, const YamlFields& value, const std::string& indentation,
                       const std::string& lead);

}  // namespace understudy::emulator::world
