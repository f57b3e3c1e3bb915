// The language of the tests' controller: parts, labels, parameters with numbers, operands that may be unset,
// texts of several lines, and rows of numbers of different lengths. None of it resembles another model's.
//
//   ; a remark
//   AREA MAIN
//   again:  MOVE X -1000      ; an axis and a target
//           SET D5 12         ; sets the register when the program is loaded
//           WAIT *            ; milliseconds, or unset
//           JUMP again
//   AREA ALARM
//           STOP
//   FILE 07
//   anything, up to the line
//   END
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/choices.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/utf8.h"
#include "emulator/device/model.h"
#include "emulator/device/program_cells.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "tests/emulator/workbench/memory.h"
#include "tests/emulator/workbench/registers.h"

namespace understudy::emulator::workbench {

inline constexpr ChoiceRow kChoices[] = {{"longest_area", "programs", "How many steps has an area?", "8|2",
                                          Confidence::proposal, "enough for the tests"}};
inline constexpr std::size_t kAreaSteps[] = {8, 2};
inline constexpr std::size_t kLongestLabel = 32;
inline constexpr std::string_view kLabelLetters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
inline constexpr std::string_view kAreas[] = {"MAIN", "ALARM"};
inline constexpr std::int64_t kUnset = INT32_MIN;  // what cells contain for `*`

inline constexpr OperandRow kMoveOperands[] = {{"axis", "X, Y or Z"}, {"target", "-1000000 to 1000000"}};
inline constexpr OperandRow kSetOperands[] = {{"register", "D0 to D124"}, {"value", "0 to 65535"}};
inline constexpr OperandRow kWaitOperands[] = {{"ms", "0 to 60000", true}};
inline constexpr OperandRow kJumpOperands[] = {{"", "a label"}};
inline constexpr InstructionRow kInstructions[] = {
    {.opcode = kMove,
     .mnemonic = "MOVE",
     .operands = kMoveOperands,
     .areas = "MAIN",
     .size = 2,
     .cost = "until the axis stands",
     .meaning = "Moves an axis to a target"},
    {.opcode = kStop, .mnemonic = "STOP", .areas = "MAIN ALARM", .size = 1, .meaning = "Stops all axes"},
    {.opcode = 3,
     .mnemonic = "SET",
     .operands = kSetOperands,
     .areas = "MAIN ALARM",
     .size = 1,
     .meaning = "Sets a register when the program is loaded"},
    {.opcode = 4,
     .mnemonic = "JUMP",
     .operands = kJumpOperands,
     .areas = "MAIN",
     .size = 1,
     .meaning = "Goes on at a label of its area"},
    {.mnemonic = "WAIT",
     .operands = kWaitOperands,
     .areas = "MAIN ALARM",
     .size = 1,
     .meaning = "Waits so long, or for the next start"}};

struct ProgramStep {
  std::string label{};
  const InstructionRow* row = nullptr;
  std::vector<std::int64_t> operands{};  // of a jump: the step of its label
};

struct Program {
  std::map<std::string, std::vector<ProgramStep>> areas{};
  std::map<std::string, std::string> files{};
};

/// Compiles a text into a program or an error.
class ProgramReader {
 public:
  explicit ProgramReader(std::size_t longest_area) : longest_area_(longest_area) {}

  void read(std::string_view text) {
    for (; !text.empty(); ++line_) {
      const std::size_t end = text.find('\n');
      read_line(text.substr(0, end));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    if (file_) fail(0, "FILE " + *file_ + " has no end; expected END");
    for (const Jump& jump : jumps_) find_label(jump);
    std::stable_sort(mistakes.begin(), mistakes.end(), [](const auto& a, const auto& b) {
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
  }

  Program program;
  std::vector<ProgramMistake> mistakes;

 private:
  struct Word {
    std::string text;
    int column = 0;
  };
  struct Jump {
    std::string area;
    std::size_t step = 0;
    Word label;
    int line = 0;
  };

  void fail(int column, const std::string& what) { mistakes.push_back({line_, column, what}); }

  static std::vector<Word> words_of(std::string_view line) {
    line = line.substr(0, line.find(';'));
    std::vector<Word> words;
    for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
      words.push_back({std::string(line.substr(at, end - at)), static_cast<int>(at) + 1});
      at = end;
    }
    return words;
  }

  void read_line(std::string_view line) {
    if (file_ && line != "END") {
      if (const auto at = first_not_utf8(line))
        fail(static_cast<int>(*at) + 1, "is not UTF-8; expected text");
      std::string& its = program.files[*file_];
      const bool fits = its.size() <= kLongestFile;
      its += std::string(line) + "\n";
      if (fits && its.size() > kLongestFile)
        fail(0, "the file is too long; expected at most " + std::to_string(kLongestFile) + " bytes");
      return;
    }
    if (file_) return file_.reset();
    std::vector<Word> words = words_of(line);
    if (words.empty()) return;
    if (words[0].text == "AREA") return read_area(words);
    if (words[0].text == "FILE") return read_file(words);
    if (!area_)
      return fail(words[0].column, "stands before the first area; expected AREA MAIN or AREA ALARM");
    std::string label;
    if (words[0].text.ends_with(':')) {
      label = words[0].text.substr(0, words[0].text.size() - 1);
      const bool is_label = !label.empty() && label.size() <= kLongestLabel &&
                            label.find_first_not_of(kLabelLetters) == std::string::npos;
      if (!is_label)
        return fail(words[0].column, quoted(label) + " is not a label; expected letters and digits");
      words.erase(words.begin());
      if (words.empty()) return fail(0, "a label marks nothing; expected an instruction behind it");
    }
    read_step(std::move(label), words);
  }

  void read_area(const std::vector<Word>& words) {
    const bool is_known = words.size() == 2 && std::ranges::find(kAreas, words[1].text) != std::end(kAreas);
    if (!is_known) return fail(words.back().column, "is not an area; expected MAIN or ALARM");
    area_ = words[1].text;
    program.areas[*area_];
  }

  void read_file(const std::vector<Word>& words) {
    if (words.size() != 2) return fail(words[0].column, "has no number; expected 00 to 99");
    file_ = words[1].text;
    const bool is_number = file_->size() == 2 && file_->find_first_not_of("0123456789") == std::string::npos;
    if (!is_number) fail(words[1].column, "is not a number; expected 00 to 99");
    program.files[*file_];
  }

  void read_step(std::string label, const std::vector<Word>& words) {
    const auto* const row = std::ranges::find(kInstructions, words[0].text, &InstructionRow::mnemonic);
    if (row == std::end(kInstructions))
      return fail(words[0].column, quoted(words[0].text) + " is not an instruction; expected one");
    auto& steps = program.areas[*area_];
    if ((" " + std::string(row->areas) + " ").find(" " + *area_ + " ") == std::string::npos)
      return fail(words[0].column,
                  words[0].text + " may not stand in " + *area_ + "; expected " + std::string(row->areas));
    if (steps.size() == longest_area_)
      return fail(words[0].column,
                  "the area is full; expected at most " + std::to_string(longest_area_) + " steps");
    if (words.size() - 1 != row->operands.size()) {
      return fail(
          words.size() - 1 > row->operands.size() ? words[row->operands.size() + 1].column : words[0].column,
          "has " + std::to_string(words.size() - 1) + " operands; expected " +
              std::to_string(row->operands.size()));
    }
    ProgramStep step{.label = std::move(label), .row = row};
    for (std::size_t i = 0; i < row->operands.size(); ++i) {
      step.operands.push_back(operand(row->operands[i], words[i + 1]));
    }
    if (row->opcode == 4) jumps_.push_back({*area_, steps.size(), words[1], line_});
    steps.push_back(std::move(step));
  }

  std::int64_t operand(const OperandRow& row, const Word& word) {
    if (row.may_be_unset && word.text == "*") return kUnset;
    if (row.name.empty()) return 0;  // a label
    if (row.name == "axis") {
      const auto* const axis = std::ranges::find(kAxes, word.text);
      if (axis != std::end(kAxes)) return axis - kAxes;
    } else {
      const bool is_register = row.name == "register";
      const bool is_spelled_well = !is_register || word.text.starts_with('D');
      const std::optional<std::int64_t> number =
          parse_integer(std::string_view(word.text).substr(is_register && is_spelled_well ? 1 : 0));
      const std::int64_t min = row.name == "target" ? -1'000'000 : 0;
      const std::int64_t max = is_register            ? 124
                               : row.name == "target" ? 1'000'000
                               : row.name == "ms"     ? 60'000
                                                      : 65'535;
      const std::int64_t value = number.value_or(INT64_MIN);
      if (is_spelled_well && value >= min && value <= max) return value;
    }
    fail(word.column, std::string(row.name) + ": " + quoted(word.text) + " is not one; expected " +
                          std::string(row.values));
    return 0;
  }

  void find_label(const Jump& jump) {
    auto& steps = program.areas[jump.area];
    const auto found = std::ranges::find(steps, jump.label.text, &ProgramStep::label);
    if (found != steps.end()) {
      steps[jump.step].operands[0] = found - steps.begin();
      return;
    }
    mistakes.push_back(
        {jump.line, jump.label.column,
         "no step of " + jump.area + " is labelled " + quoted(jump.label.text) + "; expected one"});
  }

  std::size_t longest_area_;
  int line_ = 1;
  std::optional<std::string> area_;
  std::optional<std::string> file_;
  std::vector<Jump> jumps_;
};

/// Returns a step as text, without its label.
inline std::string to_text(const ProgramStep& step, const std::vector<ProgramStep>& area) {
  std::string text(step.row->mnemonic);
  for (std::size_t i = 0; i < step.operands.size(); ++i) {
    const std::int64_t value = step.operands[i];
    const std::string_view name = step.row->operands[i].name;
    text += " ";
    text += value == kUnset      ? "*"
            : name.empty()       ? area[static_cast<std::size_t>(value)].label
            : name == "axis"     ? std::string(kAxes[value])
            : name == "register" ? "D" + std::to_string(value)
                                 : std::to_string(value);
  }
  return text;
}

inline std::string to_text(const Program& program) {
  std::string text;
  for (const std::string_view area : kAreas) {
    const auto found = program.areas.find(std::string(area));
    if (found == program.areas.end()) continue;
    text += "AREA " + found->first + "\n";
    for (const ProgramStep& step : found->second) {
      text += (step.label.empty() ? "" : step.label + ":") + "\t" + to_text(step, found->second) + "\n";
    }
  }
  for (const auto& [name, lines] : program.files) text += "FILE " + name + "\n" + lines + "END\n";
  return text;
}

class WorkbenchLanguage final : public ProgramLanguage, public ProgramCells {
 public:
  std::string_view name() const override { return "workbench program"; }
  std::string_view file_ending() const override { return ".wb"; }
  std::span<const InstructionRow> instructions() const override { return kInstructions; }
  std::vector<ProgramMistake> check(std::string_view text, const DeviceSettings& settings) const override {
    return read(text, settings).mistakes;
  }
  const ProgramCells* cells() const override { return this; }

  static ProgramReader read(std::string_view text, const DeviceSettings& settings) {
    ProgramReader reader(kAreaSteps[resolve_choices(kChoices, settings.choices)[0]]);
    reader.read(text);
    return reader;
  }

  CellForm cell_form() const override {
    return {.row = "AREA CODE OPERANDS",
            .fewest = 2,
            .max = 4,
            .lowest = INT32_MIN,
            .highest = INT32_MAX,
            .max_rows = 16};
  }
  std::vector<CellRow> assemble(std::string_view text, const DeviceSettings& settings) const override {
    const ProgramReader reader = read(text, settings);
    if (!reader.mistakes.empty()) throw ProgramError(reader.mistakes);
    if (!reader.program.files.empty())
      throw ProgramError(0, 0, "files have no numbers; expected areas alone");
    std::vector<CellRow> rows;
    for (std::int64_t area = 0; area < 2; ++area) {
      const auto found = reader.program.areas.find(std::string(kAreas[area]));
      if (found == reader.program.areas.end()) continue;
      for (const ProgramStep& step : found->second) {
        CellRow& row = rows.emplace_back();
        row.cells = {area, step.row->opcode.value_or(5)};
        row.cells.insert(row.cells.end(), step.operands.begin(), step.operands.end());
      }
    }
    return rows;
  }
  std::string disassemble(const std::vector<CellRow>& rows, const DeviceSettings&) const override {
    Program program;
    for (const CellRow& row : rows) {
      const auto* const known = std::ranges::find_if(kInstructions, [&](const InstructionRow& candidate) {
        return candidate.opcode.value_or(5) == row.cells[1];
      });
      if (row.cells[0] < 0 || row.cells[0] > 1 || known == std::end(kInstructions) ||
          known->operands.size() + 2 != row.cells.size()) {
        throw ProgramError(row.line, 0, "is not a step; expected an area, a code and its operands");
      }
      program.areas[std::string(kAreas[row.cells[0]])].push_back(
          {.row = known, .operands = {row.cells.begin() + 2, row.cells.end()}});
    }
    for (auto& [name, steps] : program.areas) {
      for (const ProgramStep& step : steps) {
        if (step.row->opcode != 4) continue;
        const auto target = static_cast<std::size_t>(step.operands[0]);
        if (target >= steps.size()) throw ProgramError(0, 0, "jumps nowhere; expected a step of " + name);
        steps[target].label = "s" + std::to_string(target);
      }
    }
    return to_text(program);
  }
};

inline const ProgramLanguage& language() {
  static const WorkbenchLanguage language;
  return language;
}

}  // namespace understudy::emulator::workbench
