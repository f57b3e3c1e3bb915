// Writes a photograph as JSON: values, refusals, latencies, and every exchange.
#pragma once

#include <string>

#include "emulator/box/photograph/photograph.h"

namespace understudy::emulator::box {

std::string photo_json(const Photograph& photo);

/// The least, the median and the greatest of all latencies.
struct Latencies {
  WallTime min{0};
  WallTime median{0};
  WallTime max{0};
};
Latencies latencies_of(const Photograph& photo);

}  // namespace understudy::emulator::box
