// Shares files among the scenarios of a run. Many scenarios refer to the same bench and the same step files.
// Each file is read, and each bench checked, only once.
#pragma once

#include <map>
#include <string>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

struct SharedReading {
  ModelList models;                                   // the models that devices may have
  std::map<std::string, world::Bench> benches;        // by path, spelled as in messages
  std::map<std::string, world::YamlFields> included;  // the steps in files, by path
};

}  // namespace understudy::emulator::play
