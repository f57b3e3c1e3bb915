#include "interpreter/rs_m8194h/text.h"
#include "base/text/tokens.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "base/text/suggestion.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/operators.h"
#include "interpreter/rs_m8194h/text_error.h"

namespace understudy::interpreter::rs_m8194h {
namespace {

constexpr std::string_view kAxisLetters = "XYZU";

// --- values as text ----------------------------------------------------------------------------

std::string letters_of(std::uint32_t mask) {
  std::string letters;
  for (std::size_t axis = 0; axis < kAxisLetters.size(); ++axis) {
    if ((mask >> axis & 1U) != 0) letters += kAxisLetters[axis];
  }
  return letters;
}

std::string hexadecimal(std::uint32_t value) {
  std::array<char, 12> text{};
  std::snprintf(text.data(), text.size(), "0x%X", value);
  return text.data();
}

std::string text_of_axes(std::uint32_t mask, bool takes_initial) {
  if (mask >= 1 && mask <= kAllAxes) return letters_of(mask);
  const bool is_initial = takes_initial && mask > kInitial && mask < 2 * kInitial;
  return is_initial ? "INITIAL_" + letters_of(mask & kAllAxes) : std::to_string(mask);
}

/// Formats a real number. NaN and infinity are written as their bits.
std::string text_of_real(std::uint32_t bits) {
  const auto real = std::bit_cast<float>(bits);
  if (!std::isfinite(real)) return hexadecimal(bits);
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), real);
  return {text.data(), end};
}

std::string numbered(std::string_view name, std::size_t number) {
  return std::string(name) + std::to_string(number);
}

std::string text_of_value(const Command& command, std::size_t parameter) {
  const Parameter& row = command.row().parameters[parameter];
  const std::uint32_t value = command.values[parameter];
  if (is_reference(command, parameter)) {
    return row.reference == Reference::variable ? numbered("VAR", variable_number(value))
                                                : numbered("bVAR", byte_variable_number(value));
  }
  if (row.width == Width::real) return text_of_real(value);
  switch (row.kind) {
    case Kind::axes:
    case Kind::axis:
    case Kind::axis_or_none: return text_of_axes(value, false);
    case Kind::setting_axes: return text_of_axes(value, true);
    case Kind::variable:
      if (is_variable(value)) return numbered("VAR", variable_number(value));
      break;
    case Kind::byte_variable:
      if (is_byte_variable(value)) return numbered("bVAR", byte_variable_number(value));
      break;
    case Kind::memory:
      if (row.lists(command.number(parameter))) return numbered("MD", value);
      break;
    case Kind::arithmetic:
      return is_arithmetic(value) ? std::string(1, static_cast<char>(value)) : hexadecimal(value);
    case Kind::comparison: {
      const ComparisonRow* comparison = find_comparison(value);
      return comparison == nullptr ? hexadecimal(value) : std::string(comparison->text);
    }
    case Kind::number:
    case Kind::speed:
    case Kind::any_value:
    case Kind::operand:
    case Kind::isr_if_used:
    case Kind::point_if_used: break;
  }
  return std::to_string(command.number(parameter));
}

// --- text as values ----------------------------------------------------------------------------

/// Returns the number after a name: 12 for the text "VAR12" and the name "VAR".
std::optional<std::int64_t> number_behind(std::string_view text, std::string_view name) {
  if (text.size() <= name.size() || !is_word(text.substr(0, name.size()), name)) return std::nullopt;
  const std::string_view digits = text.substr(name.size());
  if (!std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; })) return std::nullopt;
  return parse_integer(digits);
}

std::optional<std::int64_t> axes_of(std::string_view text, bool takes_initial) {
  const std::string word = upper_case(text);
  std::string_view letters = word;
  std::int64_t mask = 0;
  if (takes_initial && letters.starts_with("INITIAL_")) {
    mask = kInitial;
    letters.remove_prefix(std::string_view("INITIAL_").size());
  } else if (letters.starts_with("AXIS_")) {
    letters.remove_prefix(std::string_view("AXIS_").size());
  }
  for (const char letter : letters) {
    const std::size_t axis = kAxisLetters.find(letter);
    if (axis == std::string_view::npos || (mask >> axis & 1) != 0) return parse_integer(text);
    mask |= std::int64_t{1} << axis;
  }
  return letters.empty() ? std::nullopt : std::optional(mask);
}

std::optional<std::int64_t> operator_of(std::string_view text, Kind kind) {
  if (kind == Kind::arithmetic && text.size() == 1 && is_arithmetic(static_cast<unsigned char>(text[0]))) {
    return text[0];
  }
  for (const ComparisonRow& row : kComparisons) {
    if (kind == Kind::comparison && row.text == text) return row.codes[0];
  }
  return parse_integer(text);
}

std::optional<std::int64_t> real_of(std::string_view text) {
  if (text.starts_with("0x") || text.starts_with("0X")) return parse_integer(text);
  const std::optional<double> real = parse_real(text);
  if (!real || !std::isfinite(static_cast<float>(*real))) return std::nullopt;
  return std::bit_cast<std::uint32_t>(static_cast<float>(*real));
}

std::optional<std::int64_t> variable_of(std::string_view text, bool is_byte) {
  const std::optional<std::int64_t> number = number_behind(text, is_byte ? "bVAR" : "VAR");
  if (!number) return std::nullopt;
  const std::int64_t count = is_byte ? kByteVariableCount : kVariableCount;
  if (*number >= count) return std::nullopt;
  return *number + (is_byte ? kByteVariable0 : kVariable0);
}

/// Returns the value for the registers. Its range is checked later.
std::optional<std::int64_t> value_of(std::string_view text, const Parameter& row, bool is_macro_line) {
  if (row.width == Width::real) return real_of(text);
  switch (row.kind) {
    case Kind::axes:
    case Kind::axis:
    case Kind::axis_or_none: return axes_of(text, false);
    case Kind::setting_axes: return axes_of(text, true);
    case Kind::arithmetic:
    case Kind::comparison: return operator_of(text, row.kind);
    case Kind::memory:
      if (const auto number = number_behind(text, "MD")) return number;
      break;
    case Kind::variable: return variable_of(text, false);
    case Kind::byte_variable: return variable_of(text, true);
    case Kind::number:
    case Kind::speed:
    case Kind::any_value:
    case Kind::operand:
    case Kind::isr_if_used:
    case Kind::point_if_used:
      if (is_macro_line && row.reference != Reference::none) {
        const bool is_byte = row.reference == Reference::byte_variable;
        if (const auto reference = variable_of(text, is_byte)) return reference;
      }
      break;
  }
  return parse_integer(text);
}

/// Returns true if the registers of a parameter can hold the value.
bool fits(std::int64_t value, Width width) {
  switch (width) {
    case Width::byte: return value >= 0 && value <= 0xFFFF;
    case Width::unsigned_long:
    case Width::real: return value >= 0 && value <= std::int64_t{UINT32_MAX};
    case Width::signed_long: return value >= INT32_MIN && value <= INT32_MAX;
  }
  return false;
}

// --- lines -------------------------------------------------------------------------------------

const std::vector<std::string>& known_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const CommandRow& row : kCommands) {
      for (const std::string_view name : {row.real_time_name, row.macro_name}) {
        if (!name.empty()) names.emplace_back(name);
      }
    }
    return names;
  }();
  return kNames;
}

std::optional<std::uint16_t> code_of(std::string_view name) {
  using Named = std::pair<std::string, std::uint16_t>;
  static const std::vector<Named> kSorted = [] {
    std::vector<Named> names;
    for (const CommandRow& row : kCommands) {
      if (!row.real_time_name.empty())
        names.emplace_back(upper_case(row.real_time_name), real_time_code(row.verb));
      if (!row.macro_name.empty()) names.emplace_back(upper_case(row.macro_name), macro_code(row.verb));
    }
    std::ranges::stable_sort(names, {}, &Named::first);
    return names;
  }();
  const std::string word = upper_case(name);
  const auto found = std::ranges::lower_bound(kSorted, word, {}, &Named::first);
  if (found == kSorted.end() || found->first != word) return std::nullopt;
  return found->second;
}

/// Returns the nearest names. All names have the same prefix, so a name without the prefix is also accepted,
/// and only the rest is compared. A name that contains the word is nearer than a name with a similar
/// spelling.
std::string nearest_names(const std::string& word) {
  constexpr std::string_view kBeginnings[] = {"RSM_MACRO_", "RSM_ABS_MACRO_", "RSM_ABS_", "RSM_"};
  std::string_view own = word;
  for (const std::string_view beginning : kBeginnings) {
    const std::string name = std::string(beginning) + word;
    if (code_of(name)) return "; the nearest is " + quoted(name);
    if (own.size() == word.size() && own.size() > beginning.size() && own.starts_with(beginning)) {
      own.remove_prefix(beginning.size());
    }
  }
  const std::string_view family = std::string_view(word).substr(0, word.size() - own.size());
  std::vector<std::string> known;
  std::string with_it;
  for (const std::string& name : known_names()) {
    if (!name.starts_with(family)) continue;
    known.push_back(name.substr(family.size()));
    const bool has_it = ("_" + known.back() + "_").find("_" + std::string(own) + "_") != std::string::npos;
    if (has_it) with_it += (with_it.empty() ? "" : ", ") + name;
  }
  if (!with_it.empty()) return "; expected one such as " + with_it;
  if (const auto nearest = near_word(own, known)) {
    return "; the nearest is " + quoted(std::string(family) + *nearest);
  }
  return suggestion(word, known_names());
}

ParsedCommand failed(const Token& token, std::string message) {
  return {.command = {}, .error = TextError{token.line, token.column, std::move(message)}};
}

std::string names_of_parameters(const CommandRow& row) {
  std::string names;
  for (std::size_t i = 0; i < row.parameter_count(); ++i) {
    names += (i == 0 ? "" : ", ") + std::string(row.parameters[i].name);
  }
  return names.empty() ? "nothing after it" : names;
}

}  // namespace

std::string text_of(const Command& command) {
  std::string text(name_of(command.code));
  for (std::size_t i = 0; i < command.row().parameter_count(); ++i) text += " " + text_of_value(command, i);
  return text;
}

ParsedCommand parse_command(std::string_view text, const Options& options) {
  const std::vector<Token> tokens = tokens_of(text, 1);
  if (tokens.empty()) return failed({text, 1, 1}, "is empty; expected a command");
  return parse_command(tokens, options);
}

ParsedCommand parse_command(std::span<const Token> tokens, const Options& options) {
  const Token& name = tokens.front();
  const std::optional<std::uint16_t> code = code_of(name.text);
  if (!code) {
    return failed(name, quoted(name.text) + " is not a command" + nearest_names(upper_case(name.text)));
  }
  Command command{.code = *code};
  const CommandRow& row = command.row();
  const std::size_t count = row.parameter_count();
  if (tokens.size() != count + 1) {
    const Token& last = tokens.size() > count + 1 ? tokens[count + 1] : tokens.back();
    return failed(last, std::string(name_of(*code)) + " has " + std::to_string(tokens.size() - 1) +
                            " parameters; expected " + names_of_parameters(row));
  }
  const auto misfit = [&](std::size_t i) {
    return failed(tokens[i + 1], "parameter " + std::string(row.parameters[i].name) + ": " +
                                     quoted(tokens[i + 1].text) + " does not fit; expected " +
                                     expected_of(command, i));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<std::int64_t> value =
        value_of(tokens[i + 1].text, row.parameters[i], command.is_macro_line());
    if (!value || !fits(*value, row.parameters[i].width)) return misfit(i);
    command.values[i] = static_cast<std::uint32_t>(*value);
  }
  if (const std::optional<std::size_t> bad = bad_parameter(command, options)) {
    if (bad_parameter(command)) return misfit(*bad);
    // A choice refuses the value, not its range.
    return failed(tokens[*bad + 1], "parameter " + std::string(row.parameters[*bad].name) + ": " +
                                        quoted(tokens[*bad + 1].text) +
                                        " is refused by a choice of the bench; expected " +
                                        (is_reference(command, *bad) ? "a constant" : "another value"));
  }
  if (const std::optional<std::size_t> bad = bad_operand(command)) return misfit(*bad);
  return {.command = command, .error = {}};
}

}  // namespace understudy::interpreter::rs_m8194h
