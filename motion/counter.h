// Position counters: the values that a controller shows for an axis's travel.
//
// An axis counts its travel once, in 64 bits, from power-up; every counter of the device (logical position,
// absolute position, RCUN1, a coordinate in a register) is that travel plus an offset, wrapped as in the
// device. Therefore, counters cost nothing while the axis moves.
#pragma once

#include <cstdint>
#include <optional>

namespace understudy::motion {

struct Counter {
  enum class Range : std::uint8_t {
    linear,  // 64 bits: never wraps
    bits32,  // signed 32 bits (MCX314 LP and EP, Simple2-R3 coordinates)
    bits28,  // signed 28 bits (PCL6045 RCUN)
    ring,    // 0 .. ring_top: wraps from the top to 0 (MCX314 variable ring)
  };

  Range range = Range::linear;
  std::int64_t ring_top = 0;  // for ring: 0 .. 2^63 - 2
  std::int64_t offset = 0;

  bool operator==(const Counter&) const = default;

  /// Returns the count at `travel`.
  std::int64_t at(std::int64_t travel) const;
  /// Sets the count at `travel` to `value`, wrapped into the range.
  void set(std::int64_t value, std::int64_t travel);

  /// Returns how many steps (1 or more) in `direction` (+1 or -1) are needed until the count is `value`, or
  /// nothing if the count never reaches it.
  std::optional<std::int64_t> steps_until(std::int64_t value, std::int64_t travel, int direction) const;

  /// Return the minimum and the maximum count, or nothing for linear.
  std::optional<std::int64_t> min() const;
  std::optional<std::int64_t> max() const;
};

}  // namespace understudy::motion
