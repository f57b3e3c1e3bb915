#include "emulator/model_file/list_enumeration.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/parse_integer.h"
#include "emulator/model_file/list_values.h"

namespace understudy::emulator::model_file {

namespace {

constexpr std::string_view kSeparators = ",;|";

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n'; }
bool is_letter(char c) {
  return static_cast<unsigned char>(c) >= 0x80 || std::isalpha(static_cast<unsigned char>(c)) != 0;
}

/// Reads a text from left to right.
class Cursor {
 public:
  Cursor(std::string_view text, std::size_t at) : text_(text), at_(at) {}

  std::size_t at() const { return at_; }
  char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  std::string_view rest() const { return text_.substr(at_); }

  void skip_blanks() {
    while (is_blank(next())) ++at_;
  }
  bool take(std::string_view what) {
    if (!rest().starts_with(what)) return false;
    at_ += what.size();
    return true;
  }
  bool take_in_any_case(std::string_view what) {
    const bool is_there = rest().size() >= what.size() &&
                          std::equal(what.begin(), what.end(), rest().begin(), [](char one, char other) {
                            return one == std::tolower(static_cast<unsigned char>(other));
                          });
    if (is_there) at_ += what.size();
    return is_there;
  }
  std::optional<std::int64_t> take_number() {
    std::size_t end = at_;
    if (end < text_.size() && (text_[end] == '-' || text_[end] == '+')) ++end;
    const std::size_t begin = end;
    const bool is_hexadecimal = text_.substr(end).starts_with("0x") || text_.substr(end).starts_with("0X");
    if (is_hexadecimal) end += 2;
    const auto is_in_number = [&](char c) {
      return is_digit(c) || (is_hexadecimal && std::isxdigit(static_cast<unsigned char>(c)) != 0);
    };
    while (end < text_.size() && is_in_number(text_[end])) ++end;
    std::string_view digits = text_.substr(at_, end - at_);
    if (begin > at_ && text_[at_] == '+') digits.remove_prefix(1);
    if (!is_hexadecimal) {  // "01" is 1
      const bool is_negative = digits.starts_with('-');
      std::string_view plain = digits.substr(is_negative ? 1 : 0);
      if (plain.empty()) return std::nullopt;
      plain.remove_prefix(std::min(plain.find_first_not_of('0'), plain.size() - 1));
      const auto number = parse_integer(plain);
      if (number) at_ = end;
      return number && is_negative ? std::optional(-*number) : number;
    }
    const auto number = parse_integer(digits);
    if (number) at_ = end;
    return number;
  }

 private:
  std::string_view text_;
  std::size_t at_;
};

/// A value in front of its meaning, which begins at `end`.
struct ValueKey {
  std::size_t begin = 0;
  std::size_t end = 0;
  NamedValue value{};
  bool may_be_a_ratio = false;  // "8:1"
  bool may_be_a_time = false;   // "12:30"
  bool may_be_a_word = false;   // "2-wire"
};

bool take_sign(Cursor& cursor, ValueKey& key) {
  const std::size_t before = cursor.at();
  cursor.skip_blanks();
  if (cursor.take("=>") || cursor.take("->") || cursor.take("=")) return true;
  if (cursor.take(":")) {
    const std::string_view rest = cursor.rest();
    key.may_be_a_ratio = before + 1 == cursor.at() && !rest.empty() && is_digit(rest[0]);
    key.may_be_a_time = key.may_be_a_ratio && rest.size() >= 2 && is_digit(rest[1]) &&
                        (rest.size() == 2 || !is_digit(rest[2]));
    return true;
  }
  if (!cursor.take("-") && !cursor.take("–") && !cursor.take("—")) return false;
  cursor.skip_blanks();
  key.may_be_a_word = true;
  return is_letter(cursor.next());  // "0 - stop", but not "0 - 100"
}

/// Returns the key that begins at a place of the text, or nothing.
std::optional<ValueKey> key_at(std::string_view text, std::size_t begin) {
  Cursor cursor(text, begin);
  ValueKey key{.begin = begin};
  cursor.take("\"");
  key.value.is_bit = cursor.take_in_any_case("bit") || cursor.take_in_any_case("b");
  if (key.value.is_bit) cursor.skip_blanks();
  const auto first = cursor.take_number();
  if (!first) return std::nullopt;
  key.value.value = key.value.last = *first;
  const Cursor alone = cursor;
  cursor.skip_blanks();
  for (const std::string_view between : {"...", "..", "…", "to ", "bis ", "~", "–", "-"}) {
    if (!cursor.take(between)) continue;
    cursor.skip_blanks();
    const auto last = cursor.take_number();
    if (last && *last >= *first) {
      key.value.last = *last;
    } else {
      cursor = alone;
    }
    break;
  }
  if (key.value.last == key.value.value) cursor = alone;
  cursor.take("\"");
  if (!take_sign(cursor, key)) return std::nullopt;
  key.end = cursor.at();
  return key;
}

/// Returns true if a value may begin behind this character.
bool ends_a_meaning(char c) {
  return is_blank(c) || c == '/' || c == '(' || c == '[' || kSeparators.find(c) != std::string_view::npos;
}

std::vector<ValueKey> keys_of(std::string_view text) {
  const bool has_separators = text.find_first_of(kSeparators) != std::string_view::npos;
  std::vector<ValueKey> keys;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (at > 0 && !ends_a_meaning(text[at - 1])) continue;
    const auto key = key_at(text, at);
    if (!key) continue;
    // Blanks also separate words, ratios and times, so these count only behind a stronger separator.
    std::size_t before = at;
    while (before > 0 && is_blank(text[before - 1])) --before;
    const bool is_first = before == 0;
    if (!is_first && before == (keys.empty() ? 0 : keys.back().end)) continue;  // "1: 2-wire"
    const bool is_separated = !is_first && (kSeparators.find(text[before - 1]) != std::string_view::npos ||
                                            text[before - 1] == '/');
    if (key->may_be_a_time && !(is_first ? has_separators : is_separated)) continue;
    if (key->may_be_a_word && !is_first && !is_separated) continue;
    if (key->may_be_a_ratio && !is_first && !is_separated && has_separators) continue;
    keys.push_back(*key);
    at = key->end - 1;
  }
  return keys;
}

/// Returns true if something in a meaning may be another value: "off, 2 on" of "1: off, 2 on".
bool may_hold_a_value(std::string_view meaning) {
  for (std::size_t at = 1; at < meaning.size(); ++at) {
    if (kSeparators.find(meaning[at]) == std::string_view::npos) continue;
    const bool is_decimal = meaning[at] == ',' && is_digit(meaning[at - 1]);
    std::size_t next = at + 1;
    while (next < meaning.size() && is_blank(meaning[next])) ++next;
    if (next >= meaning.size() || !is_digit(meaning[next])) continue;
    if (!is_decimal || next > at + 1) return true;
  }
  return false;
}

}  // namespace

std::optional<std::vector<NamedValue>> parse_enumeration(std::string_view text) {
  constexpr std::array<std::pair<char, char>, 3> kAround{{{'{', '}'}, {'[', ']'}, {'(', ')'}}};
  text = bare(text);
  for (const auto& [first, last] : kAround) {
    const bool is_around =
        text.starts_with(first) && text.ends_with(last) && text.find(first, 1) == std::string_view::npos;
    if (is_around) text = bare(text.substr(1, text.size() - 2));
  }
  // The quotes around the first key have gone with the blanks.
  const std::vector<ValueKey> keys = keys_of(text);
  if (keys.empty() || keys.front().begin != 0) return std::nullopt;
  std::vector<NamedValue> all;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::size_t end = i + 1 < keys.size() ? keys[i + 1].begin : text.size();
    std::string_view name = bare(text.substr(keys[i].end, end - keys[i].end));
    while (!name.empty() && (ends_a_meaning(name.back()) || name.back() == '"'))
      name = bare(name.substr(0, name.size() - 1));
    if (name.empty() || may_hold_a_value(name)) return std::nullopt;
    all.push_back(keys[i].value);
    all.back().name = std::string(name);
    if (all.back().is_bit != all.front().is_bit) return std::nullopt;
  }
  return all;
}

}  // namespace understudy::emulator::model_file
