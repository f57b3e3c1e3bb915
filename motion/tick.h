// Simulated time as motion counts it: whole ticks of one millisecond.
#pragma once

#include <cstdint>

namespace understudy::motion {

/// Simulated milliseconds since power-up: the tick that every axis steps by.
using Tick = std::int64_t;

inline constexpr double kTicksPerSecond = 1000.0;

/// Within this much of a tick (1 ns) a duration counts as a whole number of ticks. Durations come from
/// divisions (3.05 s as 3.0500000000000003 s), which must not cost a tick.
inline constexpr double kTickTolerance = 1e-6;

/// No tick: "the next tick at which something happens" when nothing will.
inline constexpr Tick kNoTick = INT64_MAX;

}  // namespace understudy::motion
