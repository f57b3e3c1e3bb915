// What a write or a command may do when it is sent to a real controller. Rows of registers and commands have
// these marks, and `run --on` and `probe` send only what the user has allowed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace understudy::emulator {

/// A set of bits.
enum class Hazards : std::uint8_t {
  reads = 0,             // nothing changes
  settings = 1,          // changes values, but starts nothing
  memory = 2,            // stores something that survives power-off
  output = 4,            // may switch an output
  motion = 8,            // may move an axis, or change its motion
  stops_answering = 16,  // may prevent the controller from answering at this address, or at all
  all = 31,
  unmarked = 63,  // a row without a mark; counts as all of these
};

constexpr Hazards operator|(Hazards a, Hazards b) {
  return static_cast<Hazards>(static_cast<std::uint8_t>(a) | static_cast<std::uint8_t>(b));
}
constexpr Hazards operator&(Hazards a, Hazards b) {
  return static_cast<Hazards>(static_cast<std::uint8_t>(a) & static_cast<std::uint8_t>(b));
}
/// Returns the hazards that are not in `allowed`.
constexpr Hazards beyond(Hazards hazards, Hazards allowed) {
  return static_cast<Hazards>(static_cast<std::uint8_t>(hazards) & ~static_cast<std::uint8_t>(allowed) & 31U);
}
constexpr bool has(Hazards hazards, Hazards one) { return (hazards & one) != Hazards::reads; }

/// The effect of a text line on program entry. Until program entry ends, every line is part of the program,
/// including queries and stops.
enum class EditMark : std::uint8_t {
  none,
  begins,           // all following lines, up to a line that ends the entry
  begins_one_line,  // the next line
  ends,
};

struct HazardName {
  Hazards hazard;
  std::string_view name;  // in tables
  std::string_view can;   // "can ..."
};
inline constexpr HazardName kHazardNames[] = {
    {Hazards::settings, "settings", "change values"},
    {Hazards::memory, "memory", "change memory"},
    {Hazards::output, "output", "switch an output"},
    {Hazards::motion, "motion", "move an axis"},
    {Hazards::stops_answering, "stops_answering", "stop the controller from answering"},
};

/// Returns "memory motion", or "reads".
inline std::string to_text(Hazards hazards) {
  std::string text;
  for (const HazardName& one : kHazardNames) {
    if (has(hazards, one.hazard)) text += (text.empty() ? "" : " ") + std::string(one.name);
  }
  return text.empty() ? "reads" : text;
}

}  // namespace understudy::emulator
