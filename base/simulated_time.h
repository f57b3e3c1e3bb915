// Simulated time is an integer count of nanoseconds since the world's power-up. It is never a double, and
// never the wall clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace understudy {

using SimTime = std::chrono::nanoseconds;

/// A tick is 1 ms of simulated time; tick k happens at k ms.
using Tick = std::int64_t;
inline constexpr SimTime kTickLength = std::chrono::milliseconds(1);
/// A tick that is never reached, meaning that there is no event to wait for.
inline constexpr Tick kNever = INT64_MAX;
inline constexpr SimTime kForever = SimTime::max();
/// The end of simulated time: a century after power-up, far below the limit of the integer.
inline constexpr SimTime kHorizon = std::chrono::hours(24 * 365 * 100);

constexpr SimTime time_of(Tick tick) { return tick == kNever ? kForever : tick * kTickLength; }
/// Returns the last tick that is not later than `time`.
constexpr Tick tick_at(SimTime time) { return time / kTickLength; }

/// Parses a number of at least 0 with a unit: "250ms", "3s", "1.5s", "40us", "20ns", "2min", "1h". Returns
/// nothing for any other text, or if the result is not a whole number of nanoseconds.
std::optional<SimTime> parse_duration(std::string_view text);
/// Returns the exact text in the largest unit, up to seconds, that does not exceed the duration: "3.05s",
/// "250ms", "750us", "0s".
std::string format_duration(SimTime duration);

}  // namespace understudy
