// Checks a text line by line, each instruction against its row, and then each whole area (structure.h).
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/lines.h"
#include "base/text/most_mistakes.h"
#include "base/text/one_line.h"
#include "base/text/tokens.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/foreign_words.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/instructions.h"
#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/operand.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"
#include "interpreter/super_40nc/structure.h"

namespace understudy::interpreter::super_40nc {
namespace {

std::string names_of(Letters some) {
  std::string names;
  for (const Letter letter : {Letter::k, Letter::x, Letter::y, Letter::m, Letter::t, Letter::c, Letter::d}) {
    if (has(some, letter)) names += (names.empty() ? "" : ", ") + std::string(name_of(letter));
  }
  return names;
}

std::string ranges_of(Letter letter) {
  std::string ranges;
  const std::string name(name_of(letter));
  for (const Block& block : kBlocks) {
    if (block.letter != letter) continue;
    ranges += (ranges.empty() ? "" : ", ") + name + std::to_string(block.first) + " to " + name +
              std::to_string(block.last);
  }
  return ranges;
}

class Checker {
 public:
  explicit Checker(const Options& options) : options_(options) {}

  Checked run(std::string_view text) {
    for (const TextLine line : TextLines(without_byte_order_mark(text))) {
      read(tokens_of(line.text, line.number));
      if (checked_.errors.size() >= kMaxMistakes) break;
    }
    if (checked_.errors.size() < kMaxMistakes) {
      end_area();
      if (options_.chose(option("label_scope", "the_first_area_has_it"))) check_common_labels();
    }
    leave_first(checked_.errors);
    leave_first(checked_.warnings);
    if (checked_.errors.empty()) checked_.program = std::move(program_);
    return std::move(checked_);
  }

 private:
  void fail(const Token& token, Code code, std::string what, std::string expected = {}) {
    const int step = is_in_area_ ? base_of(area_, options_) + step_ : 0;
    checked_.errors.push_back(
        {token.line, token.column, std::move(what), std::move(expected), code, step, 0});
  }

  // --- lines ------------------------------------------------------------------------------------------

  void read(const std::vector<Token>& tokens) {
    if (tokens.empty()) return;
    const std::string word = upper_case(tokens[0].text);
    if (word == "AREA") return begin_area(tokens);
    if (word == "FILE") return begin_file(tokens);
    std::size_t at = 0;
    if (is_decimal_digit(tokens[0].text.front())) read_step(tokens[at++]);
    if (at == tokens.size())
      return fail(tokens[0], Code::unknown, "a step has no instruction", "an instruction");
    read_instruction(tokens, at);
  }

  void begin_area(const std::vector<Token>& tokens) {
    end_area();
    const std::string name = tokens.size() < 2 ? "" : upper_case(tokens[1].text);
    const auto row =
        std::find_if(kAreas.begin(), kAreas.end(), [&](const AreaRow& r) { return r.name == name; });
    const Token& at = tokens[std::min<std::size_t>(1, tokens.size() - 1)];
    is_lost_ = true;  // the lines of an AREA or FILE with an error are not checked further
    if (row == kAreas.end()) {
      return fail(at, Code::unknown, name.empty() ? "AREA has no name" : quoted(at.text) + " is not an area",
                  "C, X, Y, Z, U or PLC");
    }
    if (program_.area(row->area)) {
      return fail(at, Code::unknown, "area " + name + " appears twice", "each area once");
    }
    file_ = -1;
    open(row->area, tokens);
  }

  void begin_file(const std::vector<Token>& tokens) {
    end_area();
    is_lost_ = true;
    const auto number = tokens.size() < 2 ? std::optional<std::int64_t>{} : decimal(tokens[1].text);
    const Token& at = tokens[std::min<std::size_t>(1, tokens.size() - 1)];
    if (!number || *number < 0 || *number > kGreatestFile) {
      const std::string what = tokens.size() < 2 ? "FILE has no number" : quoted(at.text) + " is not a file";
      return fail(at, Code::no_such_file, what, "0 to " + std::to_string(kGreatestFile));
    }
    if (program_.files.contains(static_cast<int>(*number))) {
      return fail(at, Code::unknown, "file " + std::to_string(*number) + " appears twice", "each file once");
    }
    file_ = static_cast<int>(*number);
    open(Area::c, tokens);
  }

  void open(Area area, const std::vector<Token>& tokens) {
    area_ = area;
    is_in_area_ = true;
    is_lost_ = false;
    step_ = 0;
    current_ = AreaProgram{row_of(area).base};
    places_.clear();
    if (tokens.size() == 2) return;
    const bool is_base = upper_case(tokens[2].text) == "BASE";
    const auto base = is_base && tokens.size() == 4 ? decimal(tokens[3].text) : std::optional<std::int64_t>{};
    constexpr int kGreatestBase = 999999;
    if (!base || *base < 0 || *base > kGreatestBase) {
      return fail(tokens[2], Code::unknown, quoted(tokens[2].text) + " is not understood",
                  "BASE and a number");
    }
    current_.base = static_cast<int>(*base);
  }

  void read_step(const Token& token) {
    if (!is_in_area_) return;
    const auto number = decimal(token.text);
    const int right = current_.base + step_;
    if (number && *number == right) return;
    fail(token, Code::unknown, "step " + std::string(token.text) + " is not the next one",
         std::to_string(right));
  }

  void read_instruction(const std::vector<Token>& tokens, std::size_t at) {
    const Token& token = tokens[at];
    if (!is_in_area_) {
      if (!std::exchange(is_lost_, true)) {
        fail(token, Code::unknown, quoted(token.text) + " is outside any area", "AREA before it");
      }
      return;
    }
    const InstructionRow* row = find_mnemonic(upper_case(token.text));
    if (row == nullptr) {
      return fail(token, Code::unknown,
                  quoted(token.text) + " is not an instruction" + nearest_instruction(token.text));
    }
    if (row->group == Group::undocumented ||
        (row->op == Op::mset && options_.chose(option("mset", "refused_at_load")))) {
      return fail(token, Code::unknown, quoted(row->mnemonic) + " is only named in the manual",
                  "an instruction that the manual describes");
    }
    Instruction instruction{row->op};
    const std::size_t errors = checked_.errors.size();
    if (tokens.size() - at - 1 > instruction.fields.size()) {
      fail(tokens[at + 5], Code::unknown, "is one field too many", "at most 4");
    }
    for (std::size_t i = 0; i < instruction.fields.size() && at + 1 + i < tokens.size(); ++i) {
      instruction.fields[i] = read_operand(tokens[at + 1 + i]);
    }
    if (row->op == Op::out && has(letters_of(Slot::timer), instruction.fields[0].letter)) {
      instruction.op = Op::out_tc;
      row = &row_of(Op::out_tc);
    }
    check_area(*row, token);
    if (checked_.errors.size() == errors) check_fields(*row, instruction, tokens, at);
    places_.push_back(token);
    current_.lines.push_back(instruction);
    step_ += steps_of(instruction);
  }

  void check_area(const InstructionRow& row, const Token& token) {
    const std::string name(row_of(area_).name);
    if (!has(row.areas, area_)) {
      std::string where;
      for (const AreaRow& other : kAreas) {
        if (has(row.areas, other.area)) where += (where.empty() ? "" : ", ") + std::string(other.name);
      }
      fail(token, Code::wrong_area, std::string(row.mnemonic) + " is not allowed in area " + name,
           "area " + where);
    } else if (has(row.void_in, area_) && options_.chose(option("void_lines", "refused_at_load"))) {
      fail(token, Code::wrong_area, std::string(row.mnemonic) + " has no effect in area " + name,
           "another area");
    }
  }

  // --- fields -----------------------------------------------------------------------------------------

  Operand read_operand(const Token& token) {
    if (token.text.find_first_not_of('*') == std::string_view::npos) return {};
    const char first = upper(token.text.front());
    for (const Letter letter :
         {Letter::k, Letter::x, Letter::y, Letter::m, Letter::t, Letter::c, Letter::d}) {
      if (name_of(letter).front() != first) continue;
      const auto number = decimal(token.text.substr(1));
      if (!number) break;
      return read_number(token, letter, *number);
    }
    const Unknown why = why_not_operand(token.text);
    fail(token, Code::unknown, why.what, why.expected);
    return {};
  }

  Operand read_number(const Token& token, Letter letter, std::int64_t number) {
    constexpr std::int64_t kMin = std::numeric_limits<std::int32_t>::min();
    constexpr std::int64_t kMax = std::numeric_limits<std::int32_t>::max();
    const bool fits = number >= kMin && number <= kMax;
    const Operand operand{letter, fits ? static_cast<std::int32_t>(number) : 0};
    if (letter == Letter::k) {
      if (!fits)
        fail(token, Code::out_of_range, std::string(token.text) + " does not fit into 32 bits",
             "K" + std::to_string(kMin) + " to K" + std::to_string(kMax));
      return operand;
    }
    if (!fits || block_of(operand) == nullptr) {
      fail(token, Code::out_of_range, upper_case(token.text) + " does not exist", ranges_of(letter));
    }
    return operand;
  }

  void check_fields(const InstructionRow& row, const Instruction& instruction,
                    const std::vector<Token>& tokens, std::size_t at) {
    const std::size_t errors = checked_.errors.size();
    for (std::size_t i = 0; i < instruction.fields.size(); ++i) {
      const Operand field = instruction.fields[i];
      const Token& token = at + 1 + i < tokens.size() ? tokens[at + 1 + i] : tokens[at];
      const Slot slot = row.slots[i];
      const std::string name = "field " + std::to_string(i + 1) + " of " + std::string(row.mnemonic);
      if (!field.is_set()) {
        if (!may_be_unset(slot) && !is_skipped_unset(row.op, i))
          fail(token, Code::unknown, name + " is unset", names_of(allowed(slot)));
      } else if (slot == Slot::none) {
        fail(token, Code::unknown, name + " has no meaning",
             i == 0 ? "no field" : std::to_string(i) + " at most");
      } else if (!has(allowed(slot), field.letter)) {
        fail(token, Code::unknown, text_of(field) + " cannot be " + name, names_of(allowed(slot)));
      } else if (slot == Slot::label && (field.number < 0 || field.number > kGreatestLabel)) {
        fail(token, Code::unknown, text_of(field) + " is not a label",
             "K0 to K" + std::to_string(kGreatestLabel));
      }
    }
    const bool lacks_one = std::any_of(instruction.fields.begin(), instruction.fields.end(),
                                       [](const Operand& field) { return !field.is_set(); });
    if (row.op == Op::c3p && lacks_one && options_.chose(option("c3p_unset", "refused_at_load"))) {
      fail(tokens[at], Code::unknown, "C3P needs all four fields", "all four");
    }
    if (row.op == Op::zrst && checked_.errors.size() == errors) check_range(instruction, tokens[at]);
  }
  static constexpr std::int32_t kGreatestLabel = 9999999;

  bool is_skipped_unset(Op op, std::size_t field) const {
    return options_.chose(option("unset_fields", "line_is_skipped")) && field == place_of_needed(op);
  }

  Letters allowed(Slot slot) const {
    const Letters some = letters_of(slot);
    if (slot == Slot::preset && options_.chose(option("preset_operand", "k_alone")))
      return letters(Letter::k);
    const bool may_reset = !options_.chose(option("reset_timers_counters", "refused_at_load")) ||
                           (slot != Slot::resettable && slot != Slot::range);
    return may_reset ? some : static_cast<Letters>(some & ~letters(Letter::t, Letter::c));
  }

  void check_range(const Instruction& zrst, const Token& token) {
    const auto& [first, last, unused, unused2] = zrst.fields;
    const bool is_swapped =
        first.number > last.number && options_.chose(option("zrst_swapped", "refused_at_load"));
    if (first.letter != last.letter || is_swapped || block_of(first) != block_of(last)) {
      fail(token, Code::out_of_range, text_of(first) + " to " + text_of(last) + " is not a range",
           "two of the same kind, the lower one first, with no gap between them");
    }
  }

  // --- areas ------------------------------------------------------------------------------------------

  void end_area() {
    if (!is_in_area_) return;
    is_in_area_ = false;
    const int base = base_of(area_, options_);
    std::vector<int> steps;
    int step = base;
    for (const Instruction& line : current_.lines) {
      steps.push_back(step);
      step += steps_of(line);
    }
    for (Fault& fault : faults_of(current_, area_, options_)) {
      const auto line = static_cast<std::size_t>(fault.line);
      const Token& token = places_[line];
      const std::string subject = fault.code == Code::label_twice ? "" : text_of(current_.lines[line]) + " ";
      Diagnostic diagnostic{
          token.line, token.column, subject + fault.what, std::move(fault.expected), fault.code, steps[line],
          0};
      if (fault.other_line >= 0) {
        diagnostic.other_step = steps[static_cast<std::size_t>(fault.other_line)];
        diagnostic.expected +=
            ", as in line " + std::to_string(places_[static_cast<std::size_t>(fault.other_line)].line);
      }
      switch (fault.weight) {
        case Fault::Weight::error: checked_.errors.push_back(std::move(diagnostic)); break;
        case Fault::Weight::warning: checked_.warnings.push_back(std::move(diagnostic)); break;
        case Fault::Weight::note: checked_.notes.push_back(std::move(diagnostic)); break;
      }
    }
    std::vector<int>& lines = file_ >= 0 ? checked_.file_lines[file_] : checked_.area_lines[index_of(area_)];
    for (const Token& place : places_) lines.push_back(place.line);
    if (file_ >= 0) {
      program_.files.emplace(file_, std::move(current_));
    } else {
      program_.areas[index_of(area_)] = std::move(current_);
      places_of_areas_[index_of(area_)] = places_;
    }
  }

  /// Finds labels that also exist in an earlier area.
  void check_common_labels() {
    std::map<std::int32_t, std::pair<std::size_t, int>> first;  // area, step
    for (const AreaRow& row : kAreas) {
      const auto& area = program_.areas[index_of(row.area)];
      if (!area) continue;
      int step = base_of(row.area, options_);
      for (std::size_t i = 0; i < area->lines.size(); step += steps_of(area->lines[i++])) {
        if (area->lines[i].op != Op::lab) continue;
        const std::int32_t label = area->lines[i].fields[0].number;
        const auto [other, is_new] = first.emplace(label, std::pair(index_of(row.area), step));
        if (is_new || other->second.first == index_of(row.area)) continue;
        const Token& token = places_of_areas_[index_of(row.area)][i];
        const bool is_warning = options_.chose(option("duplicate_label", "first_is_taken"));
        (is_warning ? checked_.warnings : checked_.errors)
            .push_back({token.line, token.column,
                        "label K" + std::to_string(label) + " also exists in area " +
                            std::string(kAreas[other->second.first].name),
                        "one", Code::label_twice, step, other->second.second});
      }
    }
  }

  const Options& options_;
  Checked checked_;
  Program program_;
  bool is_in_area_ = false;
  bool is_lost_ = false;  // true if the AREA or FILE was wrong
  int file_ = -1;
  Area area_ = Area::c;
  AreaProgram current_;
  std::vector<Token> places_;  // the places of the lines in the text
  std::array<std::vector<Token>, kAreaCount> places_of_areas_;
  int step_ = 0;  // the step of the next line, counted within the area
};

}  // namespace

Checked check(std::string_view text, const Options& options) { return Checker(options).run(text); }

}  // namespace understudy::interpreter::super_40nc
