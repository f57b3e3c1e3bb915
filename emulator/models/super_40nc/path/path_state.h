// What a SUPER-40NC stores about the path of LIN and arcs, in addition to the path itself.
#pragma once

#include <cstdint>

#include "base/simulated_time.h"

namespace understudy::emulator::models::super_40nc {

struct PathState {
  Tick path_backlash_ticks = 0;     // number of ticks in which backlash is sent before the path
  std::int32_t path_feed_lu_s = 0;  // F when the path began
  double path_feed_scale = 1;       // LU along the path per unit of F
  double path_limit_lu_s = 1;       // path speed at which an axis reaches its maximum speed

  bool operator==(const PathState&) const = default;
};

}  // namespace understudy::emulator::models::super_40nc
