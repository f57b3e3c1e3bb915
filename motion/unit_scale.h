// Converts lengths in a user's unit to pulses and back by a multiplier and a divider, with integers only.
#pragma once

#include <cstdint>
#include <optional>

namespace understudy::motion {

/// pulses = units * multiplier / divider, both 1 .. 2^31 - 1 (SUPER-40NC CMX/CDV, SLIM PN45/PN46). Rounds
/// half away from zero or, with `truncates`, rounds pulses towards zero. Always convert absolute positions,
/// so that rounding errors do not accumulate.
struct UnitScale {
  std::int64_t multiplier = 1;
  std::int64_t divider = 1;
  bool truncates = false;  // rounds pulses towards zero

  bool operator==(const UnitScale&) const = default;

  /// Throws BadMotion for a multiplier or divider outside its range.
  static UnitScale of(std::int64_t multiplier, std::int64_t divider);

  /// Return nothing if the result does not fit in 64 bits.
  std::optional<std::int64_t> to_pulses(std::int64_t units) const;
  std::optional<std::int64_t> to_units(std::int64_t pulses) const;
  double pulses_per_unit() const { return static_cast<double>(multiplier) / static_cast<double>(divider); }
};

}  // namespace understudy::motion
