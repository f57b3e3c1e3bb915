#include "interpreter/super_40nc/foreign_words.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/suggestion.h"
#include "base/text/tokens.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/instructions.h"

namespace understudy::interpreter::super_40nc {
namespace {

struct ForeignWord {
  std::string_view word;
  std::string_view here;  // the equivalent: "AD=, a comparison in series"
};

inline constexpr auto kForeignWords = std::to_array<ForeignWord>({
    {"AND=", "AD="},
    {"AND>", "AD>"},
    {"AND<", "AD<"},
    {"AND<>", "AD<>"},
    {"AND<=", "AD<="},
    {"AND>=", "AD>="},
    {"ANDI", "ANI"},
    {"ANDP", "ANP"},
    {"ANDF", "ANF"},
    {"LDN", "LDI"},
    {"ANDN", "ANI"},
    {"ORN", "ORI"},
    {"ANDB", "ANB"},
    {"NOT", "INV"},
    {"CALL", "CAL"},
    {"SRET", "RET"},
    {"FEND", "END"},
    {"CMP", "LD=, LD> or LD<, with the two values"},
    {"ZCP", "LD>= and AD<="},
    {"BMOV", "one MOV for each register, or FMV for one value"},
    {"FOR", "CAL with a number of passes"},
    {"NEXT", "RET, at the end of the lines that CAL repeats"},
    {"DRVI", "DRV after INCC"},
    {"DRVA", "DRV after ABSC"},
    {"ZRN", "HOM"},
    {"PLSV", "VDRV"},
    {"PLSY", "DRV"},
    {"TIM", "OUT T0 K1000 in the PLC, TMR in a step program"},
    {"CNT", "OUT C0 K10"},
    {"RSTR", "RST"},
    {"ELSEIF", "ELSE, and a separate IF inside it"},
    {"ENDIF", "ENDI"},
    {"GOTO", "JMP"},
});

/// A letter that begins an operand in other languages but not here, and its meaning there.
struct ForeignLetter {
  char letter;
  std::string_view what;      // "an index register"
  std::string_view expected;  // empty: any operand
};

inline constexpr auto kForeignLetters = std::to_array<ForeignLetter>({
    {'E', "constants are whole numbers", "K and a decimal number"},
    {'P', "a label is a constant", "K and its number"},
    {'V', "there are no index registers", ""},
    {'Z', "there are no index registers", ""},
});

constexpr std::string_view kAnyOperand = "X, Y, M, T, C, D or K and a number, or *";

bool is_of_data(std::string_view word) {
  const InstructionRow* const row = find_mnemonic(word);
  return row != nullptr && row->group == Group::data;
}

/// Removes the D of 32-bit instructions (LDD=, ANDD>, DADD). Returns an empty text for all other words.
std::string without_width(const std::string& word) {
  std::string narrow = word.starts_with('D') ? word.substr(1) : word;
  const std::size_t relation = word.find_first_of("=<>");
  if (relation != std::string::npos && relation > 1 && word[relation - 1] == 'D') {
    narrow = word.substr(0, relation - 1) + word.substr(relation);
    if (narrow.starts_with("AND")) narrow.erase(1, 1);
  }
  return narrow != word && is_of_data(narrow) ? narrow : std::string();
}

}  // namespace

std::optional<std::int64_t> decimal(std::string_view text) {
  const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  if (digits.empty() || !std::all_of(digits.begin(), digits.end(), is_decimal_digit)) return {};
  return parse_integer(text);
}

const InstructionRow* find_mnemonic(std::string_view word) {
  for (const InstructionRow& row : kInstructions) {
    if (word == upper_case(row.mnemonic)) return &row;
  }
  return nullptr;
}

std::string nearest_instruction(std::string_view written) {
  const std::string word = upper_case(written);
  for (const ForeignWord& foreign : kForeignWords) {
    if (foreign.word == word) return "; expected " + std::string(foreign.here);
  }
  const std::string once = word.ends_with('P') ? word.substr(0, word.size() - 1) : std::string();
  if (is_of_data(once)) return "; expected " + once + ", after an LDP if it must act only once";
  const std::string narrow = without_width(word);
  if (!narrow.empty()) return "; expected " + narrow + ", as every register has 32 bits";
  std::vector<std::string> known;
  for (const InstructionRow& row : kInstructions) known.emplace_back(row.mnemonic);
  return suggestion(written, known);
}

Unknown why_not_operand(std::string_view text) {
  const std::string not_one = quoted(text) + " is not an operand";
  const std::string any(kAnyOperand);
  const char first = upper_case(text.substr(0, 1)).front();
  const std::string_view rest = text.substr(1);
  const bool has_number = !rest.empty() && is_decimal_digit(rest.front());
  if (decimal(text)) return {not_one, "K" + std::string(text) + " for a constant"};
  if (first == 'S' && decimal(rest)) {
    return {"step relay " + upper_case(text) + " is not allowed in a program", any};
  }
  if (first == 'H') {
    const auto number = parse_integer("0x" + std::string(rest));
    if (number) return {not_one + ": constants are decimal", "K" + std::to_string(*number)};
  }
  for (const ForeignLetter& foreign : kForeignLetters) {
    if (foreign.letter != first || !has_number) continue;
    return {not_one + ": " + std::string(foreign.what),
            foreign.expected.empty() ? any : std::string(foreign.expected)};
  }
  if (first == 'K' && has_number && rest.find_first_of("XYMTCSxymtcs") != std::string_view::npos) {
    return {not_one + ": contacts cannot form a number", any};
  }
  if (first == 'K') return {not_one, "K and a whole decimal number"};
  if (has_number && rest.find_first_of("VZvz") != std::string_view::npos) {
    return {not_one + ": there are no index registers", any};
  }
  return {not_one, any};
}

}  // namespace understudy::interpreter::super_40nc
