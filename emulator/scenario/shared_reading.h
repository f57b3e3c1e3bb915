// What the scenarios of one run have read already. Many name the same bench and the same files of steps: each
// is read, and the bench checked, once.
#pragma once

#include <map>
#include <string>

#include "emulator/bench/bench.h"
#include "emulator/bench/yaml_fields.h"

namespace understudy::emulator {

struct SharedReading {
  std::map<std::string, Bench> benches;        // by path, as it is spelled in messages
  std::map<std::string, YamlFields> included;  // the steps of a file, likewise
};

}  // namespace understudy::emulator
