// Thrown for bytes or values that are not a valid state of the object for which they are intended.
#pragma once

#include <cstdint>
#include <stdexcept>

namespace understudy {

/// The message is one line: "where: what is wrong". The object has not changed.
struct StateError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void require_state(bool holds, const char* what) {
  if (!holds) throw StateError(what);
}

inline void require_within(std::int64_t value, std::int64_t min, std::int64_t max) {
  require_state(value >= min && value <= max, "a number is out of range");
}

/// Throws StateError if a count of pulses, ticks or nanoseconds is so large that the sum or difference of a
/// few such counts may not fit in 64 bits.
inline void require_reach(std::int64_t value) {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 61;
  require_within(value, -kFarthest, kFarthest);
}

}  // namespace understudy
