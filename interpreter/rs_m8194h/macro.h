// A stored macro: its lines, and the targets of program flow.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "interpreter/rs_m8194h/command.h"

namespace understudy::interpreter::rs_m8194h {

/// MP1 to MP157, ISR1 to ISR20.
struct MacroName {
  bool is_isr = false;
  int number = 0;

  auto operator<=>(const MacroName&) const = default;
};
constexpr int count_of(bool is_isr) { return is_isr ? kIsrCount : kMpCount; }
constexpr bool exists(const MacroName& name) {
  return name.number >= 1 && name.number <= count_of(name.is_isr);
}
/// Returns the number under which observers know the macro (base/program_watch.h): MP1 to MP157, then ISR1 to
/// ISR20.
constexpr int part_of(const MacroName& name) { return name.number + (name.is_isr ? kMpCount : 0); }
/// Returns "MP21" or "ISR3".
std::string to_string(const MacroName& name);

/// The capacities of macros, in lines.
struct CapacityRow {
  bool is_isr;
  int first;
  int last;
  int lines;
};
inline constexpr auto kCapacities = std::to_array<CapacityRow>({
    {true, 1, 6, 8},
    {true, 7, 15, 16},
    {true, 16, 18, 32},
    {true, 19, 20, 64},
    {false, 1, 40, 8},
    {false, 41, 90, 16},
    {false, 91, 130, 32},
    {false, 131, 150, 64},
    {false, 151, 155, 128},
    {false, 156, 157, 512},
});
constexpr int capacity_of(const MacroName& name) {
  for (const CapacityRow& row : kCapacities) {
    if (row.is_isr == name.is_isr && name.number >= row.first && name.number <= row.last) return row.lines;
  }
  return 0;
}
inline constexpr int kMaxLines = 512;

struct Macro {
  std::vector<Command> lines = {};
  /// The target of each line. IF: the line after its ELSE or END_IF. ELSE: the line after END_IF. FOR,
  /// EXIT_FOR: the line after NEXT. NEXT: the line after its FOR. GOTO: its label. All other lines: the next
  /// line.
  std::vector<std::uint16_t> leads_to = {};

  std::size_t size() const { return lines.size(); }
  bool operator==(const Macro&) const = default;
};

/// Returns the sum of the commands' costs.
int lines_used(const std::vector<Command>& lines);

/// A block that is open after some lines. In Blocks, the innermost block is last.
struct Block {
  Verb opener = Verb::if_;  // or for_
  std::uint16_t line = 0;
  bool has_else = false;
};
using Blocks = std::vector<Block>;
Blocks blocks_behind(const std::vector<Command>& lines);
int count_open(const Blocks& blocks, Verb opener);

/// Links the lines of a macro that has passed the checks of a download.
Macro linked(std::vector<Command> lines);

}  // namespace understudy::interpreter::rs_m8194h
