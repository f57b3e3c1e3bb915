// A course: a bench of a controller `m` and a Simple2-R3 `n` that are wired to each other, and events from
// outside. Everything is drawn from a seed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/world/bench/bench.h"
#include "tests/emulator/world/sleepers/act.h"

namespace understudy::emulator::world::sleepers {

struct Course {
  std::string bench_text;
  Bench bench;
  std::vector<Act> acts;
};

Course course_of(std::string_view model, std::uint64_t seed);

}  // namespace understudy::emulator::world::sleepers
