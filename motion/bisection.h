// Finds where a condition becomes true along a coordinate: exact to the last bit, in a bounded number of
// steps.
#pragma once

#include <bit>
#include <cstdint>

namespace understudy::motion {

/// Two adjacent doubles: the condition is false at `before` and true at `after`.
struct Turnover {
  double before = 0;
  double after = 0;
};

/// Bisects [from, to], 0 <= from <= to, to find where `over` changes from false to true. `over` must be false
/// at `from` and true at `to`. It bisects the set of doubles between the two, not their difference, so 64
/// steps are enough however far apart they are.
template <class Over>
Turnover turnover(double from, double to, const Over& over) {
  auto low = std::bit_cast<std::uint64_t>(from > 0 ? from : 0.0);  // -0.0 has different bits
  auto high = std::bit_cast<std::uint64_t>(to > 0 ? to : 0.0);
  while (low < high && high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    (over(std::bit_cast<double>(middle)) ? high : low) = middle;
  }
  return {.before = std::bit_cast<double>(low), .after = std::bit_cast<double>(high)};
}

}  // namespace understudy::motion
