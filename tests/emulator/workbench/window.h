// The commands of the tests' controller by name: `MOVE X -1000` and `STOP`, as words of its window.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/device/command_window.h"
#include "tests/emulator/workbench/registers.h"

namespace understudy::emulator::workbench {

class MoveWindow final : public CommandWindow {
 public:
  std::string_view register_name() const override { return "Command0"; }
  std::string_view area() const override { return "WINDOW"; }
  std::string_view example() const override { return "MOVE X 1000"; }

  std::vector<std::uint16_t> words_of(std::string_view text, const WindowForm& form) const override {
    std::istringstream words{std::string(text)};
    std::string name;
    std::string axis;
    std::string target;
    words >> name >> axis >> target;
    const auto at = [&](const std::string& word) { return static_cast<int>(text.find(word)) + 1; };
    if (name == "STOP" && axis.empty()) return {kStop};
    if (name != "MOVE") throw ProgramError(1, 1, quoted(name) + " is not a command; expected MOVE or STOP");
    const auto pulses = parse_integer(target);
    if (!pulses || *pulses < INT32_MIN || *pulses > INT32_MAX)
      throw ProgramError(1, target.empty() ? 0 : at(target),
                         quoted(target) + " is not a target; expected pulses");
    const auto bits = static_cast<std::uint32_t>(*pulses);
    const auto high = static_cast<std::uint16_t>(bits >> 16);
    const auto low = static_cast<std::uint16_t>(bits);
    for (std::uint16_t number = 0; number < kAxisCount; ++number) {
      if (axis != kAxes[number]) continue;
      return {kMove, number, form.low_word_first ? low : high, form.low_word_first ? high : low};
    }
    throw ProgramError(1, at(axis), quoted(axis) + " is not an axis; expected X, Y or Z");
  }

  std::optional<std::string> text_of(std::span<const std::uint16_t> words,
                                     const WindowForm& form) const override {
    if (words.size() == 1 && words[0] == kStop) return "STOP";
    if (words.size() != 4 || words[0] != kMove || words[1] >= kAxisCount) return std::nullopt;
    const std::uint32_t high = words[form.low_word_first ? 3 : 2];
    const std::uint32_t low = words[form.low_word_first ? 2 : 3];
    return "MOVE " + std::string(kAxes[words[1]]) + " " +
           std::to_string(static_cast<std::int32_t>(high << 16 | low));
  }
};

inline const CommandWindow& window() {
  static const MoveWindow window;
  return window;
}

}  // namespace understudy::emulator::workbench
