// The user table and the direct command (《命令範例》 24, 《D8 特殊暫存器的功用(一般用途)》 D8019 to D8029),
// which the manual calls unfinished. It prints one line of the table, and only command 1 (a straight line).
// All other commands are ours, and disabled unless a choice enables them.
//
// A line consists of ten registers: a command, and data 1 to 9. There are 200 lines. D8020 = 100 runs the
// table as the C program, from line 0 to a line with command 0; D8019 shows the line. D8020 = 100 + command
// runs one command with the data in D8021 to D8029. In both cases, D8020 returns to 0. While C is running,
// D8020 has no effect, and code 21 is shown. Like C, the table begins with the modes and speeds in the
// parameters; a command uses those of the previous command.
//
//   1 LIN  2 CW  3 CCW  4 DRV  6 RPM  8 HOM   data 1 to 4 as their fields; -2147483648: unset
//   5 F  7 TMR                                data 1
//   9 SET  10 RST                             data 1 to 4: coil addresses of Y, M and M8
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "interpreter/super_40nc/program.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr int kTableLines = 200;
inline constexpr int kWordsOfATableLine = 10;

/// What runs now: the table, a command or nothing.
struct UserTable {
  enum class Runs : std::uint8_t { nothing, command, table } runs = Runs::nothing;
  std::vector<std::uint32_t> words;  // the lines of the table when it began

  bool operator==(const UserTable&) const = default;
};

/// A table as a program for C. At a line that cannot run, the program ends without END, so it stops with code
/// 1.
struct TableProgram {
  interpreter::super_40nc::AreaProgram program;
  std::vector<int> table_lines;  // the table line for each program line
};
TableProgram program_of_table(std::span<const std::uint32_t> words);

}  // namespace understudy::emulator::models::super_40nc
