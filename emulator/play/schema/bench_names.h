// The names that a scenario of one bench may use.
#pragma once

#include <string>
#include <vector>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/form.h"

namespace understudy::emulator::play {

struct NameList {
  std::vector<std::string> names;
  /// Of names that are too many to list, such as addresses and numbers of bits: regular expressions (ECMA).
  std::vector<std::string> patterns;
};

/// Each with its device in front, and without it where there is only one device. A name of a device without
/// registers is any word: only the running device knows them.
NameList bench_names(const world::Bench& bench, world::Form::Of sort);

}  // namespace understudy::emulator::play
