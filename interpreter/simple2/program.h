// A Simple2-R3 program: 256 lines of four cells, and which line each flag stands for.
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
  std::uint8_t flag = 0;  // the manual's JMP: the flag that marks this line; none but 1 to 64

  bool operator==(const Line&) const = default;
};

using Lines = std::array<Line, kLineCount>;

class Program {
 public:
  Program() = default;
  explicit Program(const Lines& lines) : lines_(lines) { find_flags(); }

  const Lines& lines() const { return lines_; }
  const Line& line(int number) const { return lines_[static_cast<std::size_t>(number)]; }

  /// Cell 0 to 1023: 4 * line + CMD, DATA1, DATA2 or JMP, as the registers from 0x4000 on.
  std::uint8_t cell(int number) const;
  void set_cell(int number, std::uint8_t value);

  /// Of several lines with the same flag it is the last. Nothing for a flag that no line has, or that is not
  /// one.
  std::optional<std::uint8_t> line_with_flag(std::uint8_t flag) const;

  bool operator==(const Program&) const = default;

 private:
  void find_flags();

  static constexpr std::int16_t kNoLine = -1;
  static constexpr std::array<std::int16_t, kFlagCount + 1> no_flags() {
    std::array<std::int16_t, kFlagCount + 1> lines{};
    lines.fill(kNoLine);
    return lines;
  }

  Lines lines_{};
  std::array<std::int16_t, kFlagCount + 1> line_of_flag_ = no_flags();  // follows from the lines
};

}  // namespace understudy::interpreter::simple2
