// Thrown for bytes or values that cannot be a state of what they are given to.
#pragma once

#include <cstdint>
#include <stdexcept>

namespace understudy {

/// One line: "where: what is wrong". Nothing has changed.
struct StateError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void demand_state(bool holds, const char* what) {
  if (!holds) throw StateError(what);
}

inline void demand_within(std::int64_t value, std::int64_t least, std::int64_t greatest) {
  demand_state(value >= least && value <= greatest, "a number is beyond its range");
}

/// Pulses, ticks and times: sums and differences of a few of them fit 64 bits.
inline void demand_reach(std::int64_t value) {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 61;
  demand_within(value, -kFarthest, kFarthest);
}

}  // namespace understudy
