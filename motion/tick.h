// Simulated time in motion, in whole ticks of one millisecond.
#pragma once

#include <cstdint>

namespace understudy::motion {

/// Simulated milliseconds since power-up. Every axis is stepped once per tick.
using Tick = std::int64_t;

inline constexpr double kTicksPerSecond = 1000.0;

/// A duration within this fraction of a tick (1 ns) of a whole number of ticks counts as that number.
/// Durations come from divisions (3.05 s as 3.0500000000000003 s), whose rounding errors must not cost a
/// tick.
inline constexpr double kTickTolerance = 1e-6;

/// Means "no tick": the functions that return a next tick return it if nothing will happen.
inline constexpr Tick kNoTick = INT64_MAX;

}  // namespace understudy::motion
