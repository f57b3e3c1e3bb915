// Lists the names that a scenario of one bench may use.
#pragma once

#include <string>
#include <vector>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::play {

struct NameList {
  std::vector<std::string> names;
  /// What each name stands for, if it is a register: either one meaning for each name, or no meanings at all.
  std::vector<std::string> meanings;
  /// Regular expressions (ECMA) for names that are too numerous to list, such as addresses and bit numbers.
  std::vector<std::string> patterns;
};

/// Returns all names of that sort. Each begins with its device, and also appears without the device if there
/// is only one device. For a device without registers any word is allowed, because only the running device
/// knows its names.
NameList bench_names(const world::Bench& bench, world::Schema::Of sort);

}  // namespace understudy::emulator::play
