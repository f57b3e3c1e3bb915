#include "interpreter/simple2/program.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "interpreter/simple2/instructions.h"

namespace understudy::interpreter::simple2 {
namespace {

// CMD, DATA1, DATA2, JMP: the order in the registers.
constexpr std::array<std::uint8_t Line::*, kCellsPerLine> kCells{&Line::command, &Line::data1, &Line::data2,
                                                                 &Line::flag};

constexpr std::size_t line_of(int cell) { return static_cast<std::size_t>(cell / kCellsPerLine); }
constexpr auto member_of(int cell) { return kCells[static_cast<std::size_t>(cell % kCellsPerLine)]; }

constexpr std::uint8_t kEnd = opcode_of("END");
constexpr bool is_flag(std::uint8_t cell) { return cell >= 1 && cell <= kFlagCount; }

}  // namespace

std::uint8_t Program::cell(int number) const { return lines_[line_of(number)].*member_of(number); }

void Program::set_cell(int number, std::uint8_t value) {
  const auto member = member_of(number);
  Line& changed = lines_[line_of(number)];
  const std::uint8_t flag_before = changed.flag;
  changed.*member = value;
  if (rules_.found == FlagRules::Found::on_request) return;
  if (member == &Line::command && rules_.after_end == FlagRules::AfterEnd::do_not_count) {
    find_flags();  // an END may have been added or removed
  } else if (member == &Line::flag) {
    flag_written(static_cast<int>(line_of(number)), flag_before);
  }
}

std::optional<std::uint8_t> Program::line_with_flag(std::uint8_t flag) const {
  if (flag > kFlagCount || line_of_flag_[flag] == kNoLine) return std::nullopt;
  return static_cast<std::uint8_t>(line_of_flag_[flag]);
}

void Program::find_flags() {
  line_of_flag_ = no_flags();
  for (int number = 0; number < kLineCount; ++number) {
    const std::uint8_t flag = line(number).flag;
    if (is_flag(flag)) line_of_flag_[flag] = static_cast<std::int16_t>(number);
    if (rules_.after_end == FlagRules::AfterEnd::do_not_count && line(number).command == kEnd) return;
  }
}

void Program::flag_written(int number, std::uint8_t flag_before) {
  if (is_flag(flag_before) && line_of_flag_[flag_before] == number) find_flag(flag_before);
  const std::uint8_t flag = line(number).flag;
  if (!is_flag(flag) || is_behind_end(number)) return;
  // The order of writes is known only for this line. Among the other lines, the last one always counts.
  std::int16_t& counts = line_of_flag_[flag];
  const bool is_last_written = rules_.several == FlagRules::Several::last_written;
  if (is_last_written || number > counts) counts = static_cast<std::int16_t>(number);
}

void Program::find_flag(std::uint8_t flag) {
  line_of_flag_[flag] = kNoLine;
  for (int number = 0; number < kLineCount; ++number) {
    if (line(number).flag == flag && !is_behind_end(number)) {
      line_of_flag_[flag] = static_cast<std::int16_t>(number);
    }
  }
}

bool Program::is_behind_end(int number) const {
  if (rules_.after_end == FlagRules::AfterEnd::count) return false;
  return std::any_of(lines_.begin(), lines_.begin() + number,
                     [](const Line& before) { return before.command == kEnd; });
}

}  // namespace understudy::interpreter::simple2
