// Shares files among the scenarios of one run. Many scenarios name the same bench and the same files of
// steps; each file is read, and the bench checked, only once.
#pragma once

#include <map>
#include <string>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

struct SharedReading {
  ModelList models;                                   // the models that devices may have
  std::map<std::string, world::Bench> benches;        // by path, as it is spelled in messages
  std::map<std::string, world::YamlFields> included;  // the steps of files, by path
};

}  // namespace understudy::emulator::play
