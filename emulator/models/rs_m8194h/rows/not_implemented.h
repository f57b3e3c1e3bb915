// RS-M8194H: effects of commands that are not modelled. Such commands are answered and executed; the log
// mentions each effect once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::emulator::models::rs_m8194h {

struct NotImplementedRow {
  interpreter::rs_m8194h::Verb verb;
  std::size_t parameter;  // the row applies if this parameter is below `min`
  std::uint32_t min;
  std::string_view what;
  std::string_view why;
};
inline constexpr std::string_view kShortPulses = "PulseWidth below 1 ms";
inline constexpr std::string_view kWhyNoShortPulses =
    "OUT_X and OUT_Y change only at ticks, so such a pulse is counted but has no length";
inline constexpr NotImplementedRow kNotImplementedRows[] = {
    {interpreter::rs_m8194h::Verb::set_filter, 2, 3, "a filter below 1.024 ms",
     "inputs change at ticks, and a machine's edges are at pulses; it causes no delay or, with the choice "
     "`filter_delay`, a delay of one tick"},
    {interpreter::rs_m8194h::Verb::set_out, 2, 4, kShortPulses, kWhyNoShortPulses},
    {interpreter::rs_m8194h::Verb::line_scan, 3, 4, kShortPulses, kWhyNoShortPulses},
};
/// The limits of the path kernel (motion/path.h).
inline constexpr std::string_view kLongHelix =
    "a helix of more than 159,154 turns, or with a rise of more than 1,000,000,000,000 pulses";
inline constexpr std::string_view kWhyNoLongHelix =
    "arcs are limited to 1,000,000 rad; such a helix is void, with the module's error (RINT bit 7)";

constexpr bool is_meant(const NotImplementedRow& row, const interpreter::rs_m8194h::Command& command) {
  // A filter that is not set for any input does not delay anything.
  const bool is_used = row.verb != interpreter::rs_m8194h::Verb::set_filter || command.values[1] != 0;
  return row.verb == command.verb() && is_used && command.values[row.parameter] < row.min;
}

}  // namespace understudy::emulator::models::rs_m8194h
