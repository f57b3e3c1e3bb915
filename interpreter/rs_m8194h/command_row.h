// The parts of a row of the RS-M8194H's command table. A row is a function in the manual. Its low byte makes
// a real-time code (0x0Axx), a macro code (0x0Cxx), or both with the same parameters.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::interpreter::rs_m8194h {

/// How many registers a parameter has, and their format.
enum class Width : std::uint8_t {
  byte,           // one register
  unsigned_long,  // two
  signed_long,    // two
  real,           // two, IEEE 754
};

/// The kind of a parameter, which determines its checks and its text.
enum class Kind : std::uint8_t {
  number,         // within its range, or one of its list
  speed,          // includes accelerations and their rates; any value, because the machine clamps it
  any_value,      // any value
  axes,           // a mask of X Y Z U, not empty
  setting_axes,   // like axes; in a real-time command, bit 4 selects the Initial Table
  axis,           // one of X Y Z U, each at most once
  axis_or_none,   // like axis, or 0
  variable,       // VARn, as a destination
  byte_variable,  // bVARn, as a destination
  memory,         // MDn
  operand,        // a constant, or a VARn that is read when the line runs
  arithmetic,     // + - * / & |
  comparison,     // < <= > >= == !=
  isr_if_used,    // an ISR or 0; any value if the command's nINT is 0
  point_if_used,  // a position; any value if the command's nType does not use it
};

/// The kind of variable that may replace a constant in a macro line. It is read when the line runs.
enum class Reference : std::uint8_t { none, byte_variable, variable };

struct Parameter {
  std::string_view name;  // as in the manual
  Kind kind = Kind::number;
  Width width = Width::byte;
  std::int64_t min = 0;
  std::int64_t max = 0;
  std::uint32_t only = 0;  // if not 0, bit n is set if n is allowed
  Reference reference = Reference::none;
  std::string_view values = {};  // the meanings of the numbers

  constexpr int registers() const { return width == Width::byte ? 1 : 2; }
  constexpr bool lists(std::int64_t value) const {
    return value >= min && value <= max && (only == 0 || ((only >> value) & 1U) != 0);
  }
};

/// How a real-time code is handled.
enum class RealTime : std::uint8_t {
  none,       // there is no real-time code
  queued,     // into the FIFO
  immediate,  // acts on receipt and uses no block
  stop,       // like immediate, or queued (a choice)
};

/// Where a function is allowed, and how the FIFO and macros treat it.
struct Use {
  RealTime real_time = RealTime::none;
  bool in_mp = false;          // its macro code is allowed in an MP
  bool in_isr = false;         // its macro code is allowed in an ISR
  bool initial = false;        // its real-time code can also store into the Initial Table
  bool starts_motion = false;  // locks, holds and waits apply
  bool refused_while_mp_runs = false;
};

inline constexpr std::size_t kMaxParameters = 12;
using Parameters = std::array<Parameter, kMaxParameters>;

struct CommandRow {
  Verb verb;
  std::string_view real_time_name;  // as in the manual; empty if there is no such code
  std::string_view macro_name;
  Use use;
  int cost;  // blocks of the FIFO or lines of a macro; 0 for immediate commands and the two CLOSE
  Parameters parameters;  // parameters that have a name
  std::string_view section;
  std::string_view meaning;

  constexpr std::size_t parameter_count() const {
    std::size_t count = 0;
    while (count < kMaxParameters && !parameters[count].name.empty()) ++count;
    return count;
  }
  /// Returns the number of registers, including the code.
  constexpr int registers() const {
    int count = 1;
    for (const Parameter& parameter : parameters) count += parameter.name.empty() ? 0 : parameter.registers();
    return count;
  }
  constexpr int fifo_blocks() const { return use.real_time == RealTime::queued ? cost : 0; }
  constexpr bool closes() const { return verb == Verb::mp_close || verb == Verb::isr_close; }
  constexpr int macro_lines() const { return closes() ? 0 : cost; }
};

inline constexpr int kMpCount = 157;
inline constexpr int kIsrCount = 20;
inline constexpr int kVariableCount = 512;      // VAR0 to VAR511
inline constexpr int kByteVariableCount = 128;  // bVAR0 to bVAR127
inline constexpr int kMemoryCount = 2048;       // MD0 to MD2047
inline constexpr int kFirstRealMemory = 1024;
inline constexpr int kLabelCount = 4;
inline constexpr int kDeepest = 7;  // open IFs, open FORs, call levels
/// A choice may exclude the first macro from the call levels.
inline constexpr int kDeepestCall = kDeepest + 1;

/// The values that represent VAR0 and bVAR0 in a parameter.
inline constexpr std::int64_t kVariable0 = 0x7FFF0000;
inline constexpr std::int64_t kByteVariable0 = 0x80;
/// The range of positions, distances, times and constants.
inline constexpr std::int64_t kMax = 2'000'000'000;
inline constexpr std::int64_t kMin = -kMax;
/// The bit of an axis mask that selects the Initial Table.
inline constexpr std::int64_t kInitial = 0x10;
inline constexpr std::int64_t kAllAxes = 0xF;

}  // namespace understudy::interpreter::rs_m8194h
