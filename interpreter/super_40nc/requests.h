// The motion requests of programs as values: a struct for each kind of motion instruction. They omit unset
// fields, axes that the area does not read, and axes that the program does not own (C21).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "interpreter/super_40nc/areas.h"

namespace understudy::interpreter::super_40nc {

/// A value for each axis, or none.
using AxisValues = std::array<std::optional<std::int32_t>, kAxisCount>;
/// Bit n selects axis n.
using AxisSet = std::uint8_t;

/// ABSC: relative to the work zero. INCC: relative to the last commanded place or to the current one (ABSC ,
/// INCC 指令).
enum class Targets : std::uint8_t { absolute, relative };
enum class Plane : std::uint8_t { xy, xz, yz };
enum class Turn : std::uint8_t { clockwise, counter_clockwise };

/// Returns the two axes of a plane, in the order of an arc's fields.
constexpr std::array<int, 2> axes_of(Plane plane) {
  switch (plane) {
    case Plane::xy: return {0, 1};
    case Plane::xz: return {0, 2};
    case Plane::yz: return {1, 2};
  }
  return {0, 1};
}
/// Two coordinates of a plane; an unset coordinate does not change.
using PlanePoint = std::array<std::optional<std::int32_t>, 2>;

/// LIN. All axes start and arrive together.
struct LinearMove {
  AxisValues target_lu;
  Targets targets = Targets::absolute;
  std::int32_t feed_lu_per_s = 0;  // as set by F or D8006; may be 0 or less
  bool operator==(const LinearMove&) const = default;
};

/// CW, CCW. The centre is relative to the start in both modes. C24 to C26 swap the direction.
struct CentreArc {
  Plane plane = Plane::xy;
  Turn turn = Turn::clockwise;
  PlanePoint end_lu;                        // if both are unset or equal to the start: a full circle
  std::array<std::int32_t, 2> centre_lu{};  // unset: 0
  Targets targets = Targets::absolute;
  std::int32_t feed_lu_per_s = 0;
  bool operator==(const CentreArc&) const = default;
};

/// C3P. The arc is ignored if the points lie on a line.
struct PointArc {
  Plane plane = Plane::xy;
  PlanePoint through_lu;
  PlanePoint end_lu;
  Targets targets = Targets::absolute;
  std::int32_t feed_lu_per_s = 0;
  bool operator==(const PointArc&) const = default;
};

/// CWR, CCWR. A negative radius means more than half a circle. The arc is ignored if it ends where it starts.
struct RadiusArc {
  Plane plane = Plane::xy;
  Turn turn = Turn::clockwise;
  PlanePoint end_lu;
  std::int32_t radius_lu = 0;
  Targets targets = Targets::absolute;
  std::int32_t feed_lu_per_s = 0;
  bool operator==(const RadiusArc&) const = default;
};

/// DRV. Each axis moves independently.
struct Drive {
  AxisValues target_lu;
  Targets targets = Targets::absolute;
  std::array<std::int32_t, kAxisCount> rpm{};
  bool is_waited_for = true;  // CHK 1
  bool operator==(const Drive&) const = default;
};

/// MRK.
struct MarkSearch {
  AxisValues target_lu;
  Targets targets = Targets::absolute;
  std::array<std::int32_t, kAxisCount> rpm{};
  bool operator==(const MarkSearch&) const = default;
};

/// HOM.
struct HomeSearch {
  AxisSet axes = 0;
  bool operator==(const HomeSearch&) const = default;
};

/// VDRV. A speed of 0 stops any motion of the axis.
struct Rotation {
  AxisValues rpm;
  bool operator==(const Rotation&) const = default;
};

/// MPG. A ratio of 0 ends the following.
struct WheelRatios {
  AxisValues lu_per_count;
  bool operator==(const WheelRatios&) const = default;
};

/// PJG, MJG: the requests of all lines in a scan.
struct Jogs {
  AxisSet positive = 0;
  AxisSet negative = 0;
  bool operator==(const Jogs&) const = default;
};

/// For each axis, the step number of the line that requests the jog.
using JogSteps = std::array<int, kAxisCount>;

/// PSET uses work coordinates, MSET machine coordinates.
struct SetPositions {
  AxisValues position_lu;
  bool of_machine = false;
  bool operator==(const SetPositions&) const = default;
};

constexpr bool is_empty(const AxisValues& values) {
  for (const auto& value : values) {
    if (value) return false;
  }
  return true;
}

}  // namespace understudy::interpreter::super_40nc
