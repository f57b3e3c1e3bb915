// The areas of a SUPER-40NC's program memory: five for step programs and one for the PLC.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace understudy::interpreter::super_40nc {

inline constexpr int kAxisCount = 4;  // X, Y, Z, U: axes 0 to 3

/// The areas, in the order in which they run in a tick.
enum class Area : std::uint8_t { c, x, y, z, u, plc };
inline constexpr int kAreaCount = 6;
inline constexpr int kStepProgramCount = 5;  // all but the PLC

struct AreaRow {
  Area area;
  std::string_view name;
  int steps;          // capacity
  int base;           // number of the first step
  int older_base;     // the numbering of the Logic chapter, MOV, ZRST and FMV, in which C has 500 steps
  char letter;        // in the manual's lists
  int run_contact;    // M: 1 run, 0 pause; 0 for the PLC
  int step_register;  // D: the step about to be executed; 0 for the PLC
};

inline constexpr std::array<AreaRow, kAreaCount> kAreas{{
    {Area::c, "C", 1500, 0, 0, 'C', 8000, 8000},
    {Area::x, "X", 500, 1500, 500, 'X', 8100, 8100},
    {Area::y, "Y", 500, 2000, 1000, 'Y', 8200, 8200},
    {Area::z, "Z", 500, 2500, 1500, 'Z', 8300, 8300},
    {Area::u, "U", 500, 3000, 2000, 'U', 8400, 8400},
    {Area::plc, "PLC", 1000, 3500, 2500, 'P', 0, 0},
}};

constexpr const AreaRow& row_of(Area area) { return kAreas[static_cast<std::size_t>(area)]; }
constexpr std::size_t index_of(Area area) { return static_cast<std::size_t>(area); }

/// Convert an axis to its program and back; -1 for C and the PLC.
constexpr Area area_of_axis(int axis) { return static_cast<Area>(axis + 1); }
constexpr int axis_of(Area area) {
  return area == Area::c || area == Area::plc ? -1 : static_cast<int>(area) - 1;
}

/// A set of areas.
using Areas = std::uint8_t;
constexpr Areas one(Area area) { return static_cast<Areas>(1U << static_cast<unsigned>(area)); }
constexpr bool has(Areas areas, Area area) { return (areas & one(area)) != 0; }

}  // namespace understudy::interpreter::super_40nc
