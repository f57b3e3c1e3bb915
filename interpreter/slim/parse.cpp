#include "interpreter/slim/parse.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/slots.h"
#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

using Kind = Operand::Kind;

ParseResult refused(Error error) { return {.error = error}; }
ParseResult understood(Command command) { return {.line = {.command = std::move(command)}}; }

/// Returns the first word of a row's name, without a prefix.
constexpr std::string_view head_of(const CommandRow& row) {
  std::string_view head = row.command;
  if (head.starts_with("Tp")) head.remove_prefix(2);
  return head.substr(0, head.find(' '));
}

/// The part of a row that is compared with a word of a line.
struct RowKey {
  enum class Syntax : std::uint8_t { plain, assignment, query };
  Syntax syntax = Syntax::plain;
  bool takes_module = false;
  std::string_view head;  // for a query, everything after the "?"

  constexpr explicit RowKey(const CommandRow& row)
      : syntax(row.is_query()        ? Syntax::query
               : row.is_assignment() ? Syntax::assignment
                                     : Syntax::plain),
        takes_module(row.takes_module()),
        head(row.is_query() ? row.command.substr(1) : head_of(row)) {}

  /// Compares with a word, which must be in upper case.
  constexpr bool is_called(std::string_view word) const {
    return std::equal(head.begin(), head.end(), word.begin(), word.end(),
                      [](char a, char b) { return capital(a) == b; });
  }
};

template <std::size_t... i>
constexpr auto keys_of(std::index_sequence<i...>) {
  return std::array{RowKey(kCommands[i])...};
}
constexpr auto kRowKeys = keys_of(std::make_index_sequence<kCommands.size()>());

/// A word after its prefix `Tn` was removed.
struct Prefixed {
  bool has_prefix = false;
  int module = -1;
  std::string word;
};

/// Splits off a prefix: one digit directly after the T, or two (T15, for sixteen modules). TX, TM and TAPZ
/// have no prefix.
Prefixed split_prefix(std::string word) {
  const bool has_prefix = word.size() >= 2 && word[0] == 'T' && is_digit(word[1]);
  if (!has_prefix) return {.word = std::move(word)};
  if (word.size() < 3 || word[1] == '0' || !is_digit(word[2])) return {true, word[1] - '0', word.substr(2)};
  return {true, 10 * (word[1] - '0') + (word[2] - '0'), word.substr(3)};
}

bool is_no_module(const Prefixed& name) { return name.has_prefix && name.module >= kModuleCount; }

bool is_variable_word(std::string_view word) { return is_numbered(word, "N") || is_numbered(word, "R"); }

/// Returns true for letters that are followed by letters and digits, except names of variables and axis maps.
bool is_parameter_name(std::string_view word) {
  static constexpr std::array<std::string_view, 9> kOthers{"TX", "TY", "TZ", "TW", "AIN",
                                                           "N",  "R",  "NS", "RS"};
  if (word.empty() || is_digit(word.front()) || is_variable_word(word)) return false;
  for (const std::string_view other : kOthers) {
    if (word == other) return false;
  }
  return true;
}

/// Keeps the better of the results that several rows produce for the same operands.
void keep_better(ParseResult& best, bool is_first, Error error) {
  if (is_first || error == Error::range) best.error = error;
}

ParseResult parse_plain(const Prefixed& name, std::string_view rest, const Options& options) {
  std::vector<std::string_view> items;
  if (begins_with_quote(rest)) {
    items.push_back(rest);
  } else {
    items = split_at_commas(rest);
  }
  ParseResult best = refused(Error::syntax);
  bool is_first = true;
  for (std::size_t i = 0; i < kCommands.size(); ++i) {
    const RowKey& key = kRowKeys[i];
    if (key.syntax != RowKey::Syntax::plain || key.takes_module != name.has_prefix) continue;
    if (!key.is_called(name.word)) continue;
    if (is_no_module(name)) return refused(Error::range);
    const CommandRow& row = kCommands[i];
    Operands operands = match_slots(row, items, nullptr, options);
    if (operands.error == Error::none) {
      return understood({.verb = row.verb,
                         .row = static_cast<int>(i),
                         .module = name.module,
                         .operands = std::move(operands.operands)});
    }
    keep_better(best, is_first, operands.error);
    is_first = false;
  }
  return best;
}

/// Parses the part after "=", for a row with its own name or for a parameter.
ParseResult assign(const Prefixed& name, int row_number, std::string_view data, const Options& options) {
  const CommandRow& row = kCommands[static_cast<std::size_t>(row_number)];
  const std::array<std::string_view, 1> items{without_blanks(data)};
  Operands operands = match_slots(row, items, nullptr, options);
  if (operands.error != Error::none) return refused(operands.error);
  Command command{.verb = row.verb, .row = row_number, .module = name.module};
  command.operands = std::move(operands.operands);
  if (row.verb == Verb::set_parameter) command.name = name.word;
  // In AIN=N0, the variable receives the value.
  if (row.verb == Verb::set_variable) command.operands.push_back({.kind = Kind::analog});
  return understood(std::move(command));
}

/// Returns the row of a variable. Everything else is treated as R#, because its error is detected elsewhere.
int row_of_variable(Kind kind, bool is_query) {
  if (is_query) return holds_integer(kind) ? row_of("?N#") : row_of("?R#");
  if (is_array(kind)) return holds_integer(kind) ? row_of("NS(i)=data") : row_of("RS(i)=data");
  return holds_integer(kind) ? row_of("N#=data") : row_of("R#=data");
}

ParseResult assign_variable(std::string_view target_text, std::string_view data, const Options& options) {
  const Item target = parse_item(target_text);
  const Kind kind = target.operand.kind;
  const int row_number = row_of_variable(kind, false);
  const CommandRow& row = kCommands[static_cast<std::size_t>(row_number)];
  const std::array<std::string_view, 1> items{without_blanks(data)};
  Operands operands = match_slots(row, items, &target.operand, options);
  if (target.error == Error::syntax || operands.error == Error::syntax) return refused(Error::syntax);
  if (target.error != Error::none) return refused(target.error);
  if (operands.error != Error::none) return refused(operands.error);
  operands.operands.insert(operands.operands.begin(), target.operand);
  return understood({.verb = row.verb, .row = row_number, .operands = std::move(operands.operands)});
}

ParseResult parse_assignment(const Prefixed& name, std::string_view data, const Options& options) {
  for (std::size_t i = 0; i < kCommands.size(); ++i) {
    const RowKey& key = kRowKeys[i];
    if (key.syntax != RowKey::Syntax::assignment || key.takes_module != name.has_prefix) continue;
    if (!key.is_called(name.word)) continue;
    const CommandRow& row = kCommands[i];
    const bool is_element =
        row.slots[0] == Slot::data && row.verb == Verb::set_variable;  // NS without an index
    if (is_element) continue;
    if (is_no_module(name)) return refused(Error::range);
    return assign(name, static_cast<int>(i), data, options);
  }
  if (!is_parameter_name(name.word)) return refused(Error::syntax);
  if (is_no_module(name)) return refused(Error::range);
  return assign(name, name.has_prefix ? row_of("Tp<name>=data") : row_of("<name>=data"), data, options);
}

/// Returns the row of a query without a prefix; -1 for a parameter.
int find_query(std::string_view word) {
  for (std::size_t i = 0; i < kCommands.size(); ++i) {
    if (kRowKeys[i].syntax == RowKey::Syntax::query && kRowKeys[i].is_called(word))
      return static_cast<int>(i);
  }
  return -1;
}

ParseResult query_variable(std::string_view text, int module) {
  Item item = parse_item(text);
  if (item.error != Error::none) return refused(item.error);
  if (!is_variable(item.operand.kind)) return refused(Error::syntax);
  const int row = module >= 0 ? row_of("?Tp<name>") : row_of_variable(item.operand.kind, true);
  Command command{.verb = Verb::query_variable, .row = row, .module = module};
  command.operands.push_back(std::move(item.operand));
  return understood(std::move(command));
}

ParseResult parse_query(std::string_view text, const Options& options) {
  std::string_view rest = text;
  Prefixed name = split_prefix(take_word(rest));
  if (name.word.empty()) return refused(Error::syntax);
  const bool is_element = (name.word == "NS" || name.word == "RS") && without_blanks(rest).starts_with('(');
  const bool is_known = is_element || is_variable_word(name.word);
  if (is_known) {
    if (is_no_module(name)) return refused(Error::range);
    return query_variable(name.has_prefix ? text.substr(2) : text, name.module);
  }
  const int plain_row = find_query(name.word);
  if (plain_row < 0 && !is_parameter_name(name.word)) return refused(Error::syntax);
  if (is_no_module(name)) return refused(Error::range);
  const int row = plain_row < 0 || name.has_prefix ? row_of("?Tp<name>") : plain_row;
  const CommandRow& meant = kCommands[static_cast<std::size_t>(plain_row < 0 ? row : plain_row)];
  Operands operands = match_slots(meant, split_at_commas(rest), nullptr, options);
  if (operands.error != Error::none) return refused(operands.error);
  return understood({.verb = meant.verb,
                     .row = row,
                     .module = name.module,
                     .operands = std::move(operands.operands),
                     .name = std::move(name.word)});
}

ParseResult parse_command(std::string_view text, const Options& options) {
  if (text.starts_with('?')) return parse_query(text.substr(1), options);
  std::string_view rest = text;
  const std::string word = take_word(rest);
  if (word.empty()) return refused(Error::syntax);
  rest = without_blanks(rest);

  if ((word == "NS" || word == "RS") && rest.starts_with('(')) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) return refused(Error::syntax);
    return assign_variable(without_blanks(text.substr(0, equals)), text.substr(equals + 1), options);
  }
  const bool is_assignment = rest.starts_with('=');
  if (is_assignment && is_variable_word(word)) return assign_variable(word, rest.substr(1), options);
  const Prefixed name = split_prefix(word);
  if (name.word.empty()) return refused(Error::syntax);
  return is_assignment ? parse_assignment(name, rest.substr(1), options) : parse_plain(name, rest, options);
}

}  // namespace

ParseResult parse_line(std::string_view text, const Options& options) {
  if (text.size() > longest_line(options)) return refused(Error::syntax);
  text = without_blanks(text);
  std::string label;
  if (text.starts_with('$')) {
    const std::size_t end = std::min(text.find(' '), text.find('\t'));
    Item item = parse_item(text.substr(0, end));
    if (item.error != Error::none) return refused(item.error);
    label = std::move(item.operand.text);
    text = end == std::string_view::npos ? std::string_view() : without_blanks(text.substr(end));
  }
  if (text.empty()) return {.line = {.label = std::move(label)}};
  ParseResult result = parse_command(text, options);
  if (result.error == Error::none) result.line.label = std::move(label);
  return result;
}

}  // namespace understudy::interpreter::slim
