// SUPER-40NC's factory values (manual, 《X2.》, 《C22.》, 《X6.》): 4000 pulses per revolution, 500 rpm and
// 20 rpm, 5000 rpm in 0.5 s; and a machine for them.
//
//   EL-                              DOG                           EL+
//   ════╗                         ╔═══════╗                     ╔══════
//    -20000         0           50000   60000      70000     81000        EZ at every 4000
#pragma once

#include "tests/motion/homing_bench.h"

namespace understudy::motion {

inline constexpr double kFastPps = 500 * 4000 / 60.0;
inline constexpr double kCreepPps = 20 * 4000 / 60.0;
inline constexpr double kSlope = 5000 * 4000 / 60.0 / 0.5;

inline Super40ncHoming super40nc_factory(int mode) {
  return {.mode = mode, .fast = slope_law(kFastPps, kSlope), .creep = slope_law(kCreepPps, kSlope)};
}

inline Environment super40nc_machine() {
  Environment environment;
  environment.add(Signal::limit_minus, -kFar, -20'000);
  environment.add(Signal::home, 50'000, 60'000);
  environment.add(Signal::limit_plus, 81'000, kFar);
  environment.index_period = 4000;
  return environment;
}

/// Zones of super40nc_machine() that can be moved.
inline constexpr std::size_t kDogZone = 1;
inline constexpr std::size_t kLimitZone = 2;

inline void move_zone(Environment& environment, std::size_t number, std::int64_t from, std::int64_t to) {
  environment.zones[number].from = from;
  environment.zones[number].to = to;
  ++environment.version;
}

inline Super40ncHoming mirrored(Super40ncHoming how) {
  how.direction = -how.direction;
  how.offset_pulses = -how.offset_pulses;
  return how;
}

}  // namespace understudy::motion
