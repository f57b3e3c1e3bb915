#include "interpreter/simple2/program.h"

namespace understudy::interpreter::simple2 {
namespace {

// CMD, DATA1, DATA2, JMP, as they follow each other in the registers.
constexpr std::array<std::uint8_t Line::*, kCellsPerLine> kCells{&Line::command, &Line::data1, &Line::data2,
                                                                 &Line::flag};

constexpr std::size_t line_of(int cell) { return static_cast<std::size_t>(cell / kCellsPerLine); }
constexpr auto member_of(int cell) { return kCells[static_cast<std::size_t>(cell % kCellsPerLine)]; }

}  // namespace

std::uint8_t Program::cell(int number) const { return lines_[line_of(number)].*member_of(number); }

void Program::set_cell(int number, std::uint8_t value) {
  lines_[line_of(number)].*member_of(number) = value;
  if (member_of(number) == &Line::flag) find_flags();
}

std::optional<std::uint8_t> Program::line_with_flag(std::uint8_t flag) const {
  if (flag > kFlagCount || line_of_flag_[flag] == kNoLine) return std::nullopt;
  return static_cast<std::uint8_t>(line_of_flag_[flag]);
}

void Program::find_flags() {
  line_of_flag_ = no_flags();
  for (int number = 0; number < kLineCount; ++number) {
    const std::uint8_t flag = line(number).flag;
    if (flag >= 1 && flag <= kFlagCount) line_of_flag_[flag] = static_cast<std::int16_t>(number);
  }
}

}  // namespace understudy::interpreter::simple2
