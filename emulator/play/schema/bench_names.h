// The names that a scenario for a specific bench may use.
#pragma once

#include <string>
#include <vector>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::play {

struct NameList {
  std::vector<std::string> names;
  /// The meaning of each name, if it is a register: either one meaning per name, or no meanings at all.
  std::vector<std::string> meanings;
  /// Regular expressions (ECMA) for names that are too numerous to list, such as addresses and bit numbers.
  std::vector<std::string> patterns;
};

/// Returns all names of this kind. Each name begins with its device. If there is only one device, each name
/// also appears without the device. For a device without registers, any word is allowed, because only a
/// running device can determine its names.
NameList bench_names(const world::Bench& bench, world::Schema::Of sort);

}  // namespace understudy::emulator::play
