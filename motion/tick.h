// Simulated time in motion: whole ticks of one millisecond.
#pragma once

#include <cstdint>

namespace understudy::motion {

/// Simulated milliseconds since power-up. Every axis is stepped once per tick.
using Tick = std::int64_t;

inline constexpr double kTicksPerSecond = 1000.0;

/// A duration within this much of a tick (1 ns) counts as a whole number of ticks. Durations come from
/// divisions (3.05 s as 3.0500000000000003 s), which must not cost a tick.
inline constexpr double kTickTolerance = 1e-6;

/// The value for "no tick": what a next-tick function returns when nothing will happen.
inline constexpr Tick kNoTick = INT64_MAX;

}  // namespace understudy::motion
