// Assembles a listing in two passes: the first reads lines and stores cells, the second assigns flags to
// labels and fills them in.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/lines.h"
#include "base/text/most_mistakes.h"
#include "base/text/suggestion.h"
#include "base/text/tokens.h"
#include "interpreter/simple2/instructions.h"
#include "interpreter/simple2/listing.h"
#include "interpreter/simple2/operand_text.h"
#include "interpreter/simple2/program.h"
#include "interpreter/simple2/text.h"

namespace understudy::interpreter::simple2 {
namespace {

std::string lower_case(std::string_view name) {
  std::string text(name);
  std::transform(text.begin(), text.end(), text.begin(), lower);
  return text;
}

/// Returns the digits of "JMP7" or "@7", which directly specify the value of a cell.
std::string_view digits_of_flag(std::string_view text) {
  if (text.starts_with('@')) return text.substr(1);
  const std::string_view digits = after_prefix(text, "JMP");
  return !digits.empty() && std::all_of(digits.begin(), digits.end(), is_digit) ? digits : std::string_view{};
}

bool is_name(std::string_view text) {
  return !text.empty() && is_name_start(text.front()) && std::all_of(text.begin(), text.end(), is_name_part);
}

class Assembler {
 public:
  Assembly run(std::string_view text) {
    for (const TextLine line : TextLines(without_byte_order_mark(text))) {
      read(tokens_of(line.text, line.number, Colon::ends_its_token));
      if (errors_.size() >= kMaxMistakes) break;
    }
    if (errors_.size() < kMaxMistakes) check_labels();

    Assembly assembly;
    leave_first(errors_);
    if (errors_.empty()) assembly.lines = lines_;
    assembly.text_lines = text_line_;
    assembly.errors = std::move(errors_);
    return assembly;
  }

 private:
  /// Called after the whole text has been read.
  void check_labels() {
    if (pending_.mark)
      fail(*pending_.mark, "label", quoted(pending_.mark->text) + " does not mark a line", "an instruction");
    give_flags();
    fill_in_flags();
  }

  /// The marks before an instruction, including those that are alone on the lines above it.
  struct Marks {
    std::vector<Token> names;         // labels that will be assigned a flag
    std::optional<Token> mark;        // the first mark
    std::optional<Token> flag_token;  // the mark that sets the JMP cell, if any
    std::optional<std::uint8_t> flag;
    bool promises_flag = false;  // true for "JMP7:", whose flag must then lead to this line
  };

  struct FlagUse {
    Token token;
    int number;  // the program line that has the flag in DATA1
  };

  void fail(const Token& token, std::string field, std::string what, std::string expected) {
    errors_.push_back({token.line, token.column, std::move(field), std::move(what), std::move(expected)});
  }

  // --- first pass ------------------------------------------------------------------------------

  void read(const std::vector<Token>& tokens) {
    std::size_t at = 0;
    while (at < tokens.size() && (tokens[at].text.ends_with(':') || tokens[at].text.starts_with('@'))) {
      read_mark(tokens[at++]);
    }
    if (at == tokens.size()) return;
    const Token& word = tokens[at];
    const std::vector<Token> operands(tokens.begin() + static_cast<std::ptrdiff_t>(at) + 1, tokens.end());
    if (same_name(word.text, ".at")) return read_at(word, operands);
    if (same_name(word.text, ".line")) return read_cells(word, operands);
    read_instruction(word, operands);
  }

  void read_mark(const Token& token) {
    const bool is_label = token.text.ends_with(':');
    const std::string_view name = token.text.substr(0, token.text.size() - (is_label ? 1 : 0));
    const Token named{name, token.line, token.column};
    if (!pending_.mark) pending_.mark = token;
    if (const std::string_view digits = digits_of_flag(name); !digits.empty()) {
      const ParsedOperand flag =
          is_label ? parse_number(digits, 1, kFlagCount) : parse_number(digits, 0, 255);
      if (!flag.problem.empty()) {
        return fail(token, "label", quoted(token.text) + " does not exist",
                    is_label ? "JMP1: to JMP64:" : "@0 to @255");
      }
      pending_.promises_flag |= is_label;
      return mark_with_flag(named, static_cast<std::uint8_t>(flag.value));
    }
    if (!is_label || !is_name(name)) {
      return fail(token, "label", quoted(token.text) + " is not a label",
                  "a name of letters, digits and '_' before ':', or @0 to @255");
    }
    const auto [earlier, is_new] = labels_.emplace(lower_case(name), Label{token, 0});
    if (!is_new) {
      return fail(token, "label", quoted(name) + " appears twice",
                  "a different name from the one in line " + std::to_string(earlier->second.token.line));
    }
    pending_.names.push_back(named);
  }

  void mark_with_flag(const Token& token, std::uint8_t flag) {
    if (pending_.flag && *pending_.flag != flag) {
      return fail(token, "label", "the line already has a flag", flag_text(*pending_.flag) + " alone");
    }
    pending_.flag = flag;
    if (!pending_.flag_token) pending_.flag_token = token;
  }

  void read_at(const Token& word, const std::vector<Token>& operands) {
    constexpr const char* kExpected = "a line from 0 to 255";
    if (operands.size() != 1) return fail(word, ".at", "needs one number", kExpected);
    const ParsedOperand number = parse_number(operands[0].text, 0, kLineCount - 1);
    if (!number.problem.empty()) return fail(operands[0], ".at", number.problem, kExpected);
    next_ = number.value;
  }

  void read_cells(const Token& word, const std::vector<Token>& operands) {
    constexpr const char* kExpected = "CMD DATA1 DATA2 JMP, each 0 to 255";
    std::array<std::uint8_t, kCellsPerLine> cells{};
    if (operands.size() != cells.size()) fail(word, ".line", "needs four numbers", kExpected);
    for (std::size_t i = 0; i < std::min(operands.size(), cells.size()); ++i) {
      const ParsedOperand cell = parse_number(operands[i].text, 0, 255);
      if (!cell.problem.empty()) fail(operands[i], ".line", cell.problem, kExpected);
      cells[i] = static_cast<std::uint8_t>(cell.value);
    }
    mark_with_flag(operands.size() == cells.size() ? operands.back() : word, cells[3]);
    put(word, {cells[0], cells[1], cells[2], 0});
  }

  void read_instruction(const Token& word, const std::vector<Token>& operands) {
    const auto* const instruction =
        std::find_if(kInstructions.begin(), kInstructions.end(),
                     [&](const Instruction& candidate) { return same_name(candidate.mnemonic, word.text); });
    if (instruction == kInstructions.end()) {
      fail(word, "mnemonic", "no instruction is called " + quoted(word.text),
           word.text.starts_with('.') ? ".at or .line" : expected_instruction(word.text));
      put(word, {});
      return;
    }

    Line code{.command = instruction->opcode};
    const std::vector<OperandField> fields = operand_fields(*instruction);
    std::optional<Token> flag;
    for (std::size_t i = 0; i < std::min(fields.size(), operands.size()); ++i) {
      const std::string field = "operand " + std::to_string(i + 1);
      if (fields[i].kind == Operand::flag) {
        flag = operands[i];
      } else if (fields[i].kind == Operand::amount_low) {
        const bool is_signed = amount_is_signed(*instruction);
        const int amount = read_operand(parse_amount(is_signed, operands[i].text), operands[i], field,
                                        expected_amount(is_signed));
        code.data1 = static_cast<std::uint8_t>(amount);
        code.data2 = static_cast<std::uint8_t>(amount >> 8);
      } else {
        const int cell = read_operand(parse_operand(fields[i].kind, operands[i].text), operands[i], field,
                                      expected_operand(fields[i].kind));
        (fields[i].is_data1 ? code.data1 : code.data2) = static_cast<std::uint8_t>(cell);
      }
    }
    if (fields.size() != operands.size()) {
      const Token& token = operands.size() > fields.size() ? operands[fields.size()] : word;
      fail(token, "operands", std::string(instruction->mnemonic) + " has " + std::to_string(operands.size()),
           wanted_operands(*instruction, fields));
    }
    const int number = put(word, code);
    if (flag) flag_uses_.push_back({*flag, number});
  }

  int read_operand(const ParsedOperand& parsed, const Token& token, const std::string& field,
                   const std::string& expected) {
    if (!parsed.problem.empty()) fail(token, field, parsed.problem, expected);
    return parsed.value;
  }

  static std::string wanted_operands(const Instruction& instruction,
                                     const std::vector<OperandField>& fields) {
    if (fields.empty()) return "none";
    std::string text = std::to_string(fields.size()) + ": ";
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (i > 0) text += ", then ";
      text += fields[i].kind == Operand::amount_low ? expected_amount(amount_is_signed(instruction))
                                                    : expected_operand(fields[i].kind);
    }
    return text;
  }

  /// Returns the equivalent of a word from another language, or the instruction with the nearest spelling, if
  /// there is one.
  static std::string expected_instruction(std::string_view word) {
    struct ForeignWord {
      std::string_view word;
      std::string_view here;
    };
    static constexpr ForeignWord kForeign[] = {{"GOTO", "Jump"},
                                               {"JMP", "Jump"},
                                               {"MOV", "VAR_Copy, or VAR_Direct for a number"},
                                               {"IF", "VAR_EQ, VAR_GT, VAR_LT or one of the jumps"},
                                               {"SLEEP", "Delay_mSec"},
                                               {"FOR", "Loop, after the lines to repeat"},
                                               {"HOME", "Move_Home_A"},
                                               {"HOME_A", "Move_Home_A"},
                                               {"HOME_B", "Move_Home_B"},
                                               {"SET", "Out, and ON"},
                                               {"RESET", "Out, and OFF"},
                                               {"STOP_Main", "END"}};
    for (const ForeignWord& foreign : kForeign) {
      if (same_name(foreign.word, word)) return std::string(foreign.here);
    }
    std::vector<std::string> known;
    for (const Instruction& row : kInstructions) known.emplace_back(row.mnemonic);
    const auto nearest = near_word(word, known);
    return nearest ? "an instruction (nearest: '" + *nearest + "')" : "an instruction, such as Delay_mSec";
  }

  /// Stores a line with the marks before it, and returns its number.
  int put(const Token& word, const Line& code) {
    const int number = next_++;
    const Marks marks = std::exchange(pending_, {});
    if (number >= kLineCount) {
      if (number == kLineCount) fail(word, "line", "the program is full", "at most 256 lines, 0 to 255");
      return number;
    }
    const auto place = static_cast<std::size_t>(number);
    if (text_line_[place] != 0) {
      fail(word, "line",
           "line " + std::to_string(number) + " of the program is already defined in line " +
               std::to_string(text_line_[place]),
           "a free line");
      return number;
    }
    text_line_[place] = word.line;
    lines_[place] = code;
    marks_[place] = marks;
    return number;
  }

  // --- second pass -----------------------------------------------------------------------------

  void give_flags() {
    std::array<bool, 256> is_taken{};
    for (const Marks& marks : marks_) {
      if (marks.flag) is_taken[*marks.flag] = true;
    }
    for (const FlagUse& use : flag_uses_) {
      const std::string_view digits = digits_of_flag(use.token.text);
      const ParsedOperand flag = parse_number(digits, 0, 255);
      if (!digits.empty() && flag.problem.empty()) is_taken[static_cast<std::size_t>(flag.value)] = true;
    }

    for (std::size_t place = 0; place < lines_.size(); ++place) {
      const Marks& marks = marks_[place];
      std::uint8_t& flag = lines_[place].flag;
      flag = marks.flag.value_or(0);
      if (marks.names.empty()) continue;
      if (!marks.flag) {
        const auto* const free = std::find(is_taken.begin() + 1, is_taken.begin() + 1 + kFlagCount, false);
        flag = static_cast<std::uint8_t>(free - is_taken.begin());
        if (flag > kFlagCount) {
          fail(marks.names.front(), "label", "no flag is left for " + quoted(marks.names.front().text),
               "at most 64 flags");
        } else {
          is_taken[flag] = true;
        }
      } else if (flag < 1 || flag > kFlagCount) {
        fail(marks.names.front(), "label", quoted(marks.names.front().text) + " is on a line without a flag",
             "@1 to @64, or none");
      }
      for (const Token& name : marks.names) labels_.at(lower_case(name.text)).flag = flag;
    }
    check_that_flags_lead_to_labels();
  }

  /// If several lines have a flag, only the last one counts, so a label on another line would be misleading.
  void check_that_flags_lead_to_labels() {
    std::array<std::size_t, 256> last{};
    for (std::size_t place = 0; place < lines_.size(); ++place) last[lines_[place].flag] = place;
    for (std::size_t place = 0; place < lines_.size(); ++place) {
      const Marks& marks = marks_[place];
      const std::uint8_t flag = lines_[place].flag;
      const bool is_label = marks.promises_flag || !marks.names.empty();
      if (!is_label || flag < 1 || flag > kFlagCount || last[flag] == place) continue;
      fail(*marks.flag_token, "label",
           flag_text(flag) + " leads to line " + std::to_string(text_line_[last[flag]]) +
               ", the last line with it",
           "a flag that no other line has");
    }
  }

  void fill_in_flags() {
    for (const FlagUse& use : flag_uses_) {
      const int flag = flag_of(use.token);
      if (use.number >= kLineCount) continue;  // already an error
      lines_[static_cast<std::size_t>(use.number)].data1 = static_cast<std::uint8_t>(flag);
    }
  }

  int flag_of(const Token& token) {
    if (const std::string_view digits = digits_of_flag(token.text); !digits.empty()) {
      const bool is_cell = token.text.starts_with('@');
      const ParsedOperand flag = is_cell ? parse_number(digits, 0, 255) : parse_number(digits, 1, kFlagCount);
      if (!flag.problem.empty()) {
        fail(token, "operand 1", quoted(token.text) + " does not exist", expected_operand(Operand::flag));
      }
      return flag.value;
    }
    const auto label = labels_.find(lower_case(token.text));
    if (label != labels_.end()) return label->second.flag;
    const bool could_be_label = is_name(token.text);
    const auto nearest = could_be_label ? nearest_label(token.text) : std::optional<std::string>{};
    fail(token, "operand 1",
         could_be_label ? "no line is labelled " + quoted(token.text) : quoted(token.text) + " is not a flag",
         nearest ? "a label (nearest: '" + *nearest + "')" : expected_operand(Operand::flag));
    return 0;
  }

  std::optional<std::string> nearest_label(std::string_view word) const {
    std::vector<std::string> known;
    for (const auto& [name, label] : labels_) {
      known.emplace_back(label.token.text.substr(0, label.token.text.size() - 1));  // without the colon
    }
    return near_word(word, known);
  }

  struct Label {
    Token token;
    std::uint8_t flag;
  };

  Lines lines_{};
  std::array<Marks, kLineCount> marks_{};
  std::array<int, kLineCount> text_line_{};  // the text line of each program line; 0: none
  int next_ = 0;
  Marks pending_;
  std::map<std::string, Label> labels_;  // by name in lower case
  std::vector<FlagUse> flag_uses_;
  std::vector<ListingError> errors_;
};

}  // namespace

std::string to_string(const ListingError& error) {
  return std::to_string(error.line) + ':' + std::to_string(error.column) + ": " + error.field + ": " +
         error.what + "; expected " + error.expected;
}

Assembly assemble(std::string_view text) { return Assembler().run(text); }

}  // namespace understudy::interpreter::simple2
