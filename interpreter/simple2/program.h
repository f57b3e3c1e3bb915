// A Simple2-R3 program: 256 lines of four cells, and the line to which each flag leads.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace understudy::interpreter::simple2 {

inline constexpr int kLineCount = 256;
inline constexpr int kCellsPerLine = 4;
inline constexpr int kFlagCount = 64;

struct Line {
  std::uint8_t command = 0;
  std::uint8_t data1 = 0;
  std::uint8_t data2 = 0;
  // JMP in the manual: the flag that marks this line, 1 to 64. Other values are not flags.
  std::uint8_t flag = 0;

  bool operator==(const Line&) const = default;
};

using Lines = std::array<Line, kLineCount>;

/// How to find the line of a flag, where the manual leaves this open. Our option is first.
struct FlagRules {
  /// If several lines have the same flag, either the last line counts, or the line that was written last.
  enum class Several : std::uint8_t { last_line, last_written } several = Several::last_line;
  /// Flags after the first END either count or do not.
  enum class AfterEnd : std::uint8_t { count, do_not_count } after_end = AfterEnd::count;
  /// The lines are searched for flags either at every write or only in find_flags().
  enum class Found : std::uint8_t { at_every_write, on_request } found = Found::at_every_write;

  bool operator==(const FlagRules&) const = default;
};

/// The line of each flag; -1: none.
using FlagLines = std::array<std::int16_t, kFlagCount + 1>;

class Program {
 public:
  Program() = default;
  explicit Program(const Lines& lines, const FlagRules& rules = {}) : lines_(lines), rules_(rules) {
    find_flags();
  }
  /// Restores a program. With some rules, the lines alone do not determine the line of a flag.
  Program(const Lines& lines, const FlagRules& rules, const FlagLines& flag_lines)
      : lines_(lines), rules_(rules), line_of_flag_(flag_lines) {}

  const Lines& lines() const { return lines_; }
  const Line& line(int number) const { return lines_[static_cast<std::size_t>(number)]; }

  /// Returns cell 0 to 1023: 4 * line + CMD, DATA1, DATA2 or JMP, as in the registers from 0x4000 on.
  std::uint8_t cell(int number) const;
  void set_cell(int number, std::uint8_t value);

  /// Returns nothing if no line has the flag, or if the value is not a flag.
  std::optional<std::uint8_t> line_with_flag(std::uint8_t flag) const;
  /// Searches the lines now, regardless of the rules.
  void find_flags();
  const FlagRules& flag_rules() const { return rules_; }
  const FlagLines& flag_lines() const { return line_of_flag_; }

  bool operator==(const Program&) const = default;

 private:
  void find_flag(std::uint8_t flag);
  void flag_written(int number, std::uint8_t flag_before);
  bool is_behind_end(int number) const;

  static constexpr std::int16_t kNoLine = -1;
  static constexpr FlagLines no_flags() {
    FlagLines lines{};
    lines.fill(kNoLine);
    return lines;
  }

  Lines lines_{};
  FlagRules rules_;
  FlagLines line_of_flag_ = no_flags();
};

}  // namespace understudy::interpreter::simple2
