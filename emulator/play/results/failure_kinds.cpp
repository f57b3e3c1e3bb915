#include "emulator/play/results/failure_kinds.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

#include "emulator/play/results/result.h"

namespace understudy::emulator::play {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit_or_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_figure(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool is_hex(char c) { return is_figure(c) || (c >= 'A' && c <= 'F'); }

/// Returns true if there is a byte at this place, as in frames: "C0", which is not part of a longer word.
bool is_byte_at(std::string_view text, std::size_t at) {
  return at + 2 <= text.size() && is_hex(text[at]) && is_hex(text[at + 1]) &&
         (at == 0 || !(is_digit_or_letter(text[at - 1]) || text[at - 1] == '.')) &&
         (at + 2 == text.size() || !is_digit_or_letter(text[at + 2])) &&
         (at + 3 >= text.size() || text[at + 2] != '.' || !is_digit_or_letter(text[at + 3]));
}

/// Returns the length of the bytes that begin here: "01 03 C0 B8". A single byte may be a name, so it is
/// accepted only at the end of a phrase.
std::size_t length_of_bytes(std::string_view text, std::size_t begin) {
  std::size_t end = begin;
  for (std::size_t at = begin; is_byte_at(text, at) && (at == begin || text[at - 1] == ' '); at += 3) {
    end = at + 2;
  }
  if (end - begin > 2) return end - begin;
  const bool says_no_more = end == text.size() || text[end] == ';' || text[end] == ',';
  return says_no_more ? end - begin : 0;
}

/// Returns the length of a hexadecimal word, which is a digest, or bytes after an equals sign.
std::size_t length_of_hex(std::string_view text, std::size_t begin) {
  constexpr std::size_t kDigest = 8;
  if (begin > 0 && (is_digit_or_letter(text[begin - 1]) || text[begin - 1] == '.')) return 0;
  std::size_t end = begin;
  while (end < text.size() && std::isxdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
  if (end < text.size() && (is_digit_or_letter(text[end]) || text[end] == '.')) return 0;
  const std::string_view word = text.substr(begin, end - begin);
  const bool has_figure = word.find_first_of("0123456789") != std::string_view::npos;
  const bool is_behind_equals = begin > 0 && text[begin - 1] == '=' && word.size() % 2 == 0;
  return has_figure && (word.size() >= kDigest || is_behind_equals) ? word.size() : 0;
}

/// Returns the length of an escape such as "\x0d", which stands for an unprintable character.
std::size_t length_of_escape(std::string_view text, std::size_t at) {
  const bool is_one = text.substr(at).starts_with("\\x") && at + 4 <= text.size() &&
                      std::isxdigit(static_cast<unsigned char>(text[at + 2])) != 0 &&
                      std::isxdigit(static_cast<unsigned char>(text[at + 3])) != 0;
  return is_one ? 4 : 0;
}

/// Adds a single `#` for adjacent numbers and bytes, because these cannot be distinguished.
void add_sign(std::string& made) {
  if (made.ends_with("# ")) {
    made.pop_back();
  } else {
    made += '#';
  }
}

/// Replaces numbers with their units, and any number of bytes, with #. Keeps numbers in names (Aaxis_2,
/// STATUS.4).
std::string without_numbers(std::string_view text) {
  std::string made;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t hex =
        std::max({length_of_bytes(text, at), length_of_hex(text, at), length_of_escape(text, at)});
    if (hex > 0) {
      at += hex;
      add_sign(made);
    } else if (is_letter(text[at])) {
      // This is a name, including all parts that are joined by dots.
      while (at < text.size() && (is_digit_or_letter(text[at]) || (text[at] == '.' && at + 1 < text.size() &&
                                                                   is_digit_or_letter(text[at + 1])))) {
        made += text[at++];
      }
    } else if (is_figure(text[at])) {
      if (made.ends_with('-')) made.pop_back();
      while (at < text.size() && (is_digit_or_letter(text[at]) ||
                                  (text[at] == '.' && at + 1 < text.size() && is_figure(text[at + 1])))) {
        ++at;
      }
      add_sign(made);
    } else {
      made += text[at++];
    }
  }
  return made;
}

}  // namespace

std::string kind_of_failure(const ScenarioResult& result) {
  if (!result.failure) return {};
  const std::string what = without_numbers(result.failure->what);
  if (result.is_unreadable || result.steps.empty()) return result.file + ": " + what;
  const StepResult& step = result.steps.back();
  return step.file + ":" + std::to_string(step.line) + ": " + what;
}

const FailureKinds::Kind* FailureKinds::add(const ScenarioResult& result) {
  const std::string text = kind_of_failure(result);
  auto it = numbers_.find(text);
  if (it == numbers_.end()) {
    if (kinds_.size() >= kMax) {
      ++others_;
      return nullptr;
    }
    it = numbers_.emplace(text, kinds_.size()).first;
    kinds_.push_back({.text = text, .first = result.name});
  }
  Kind& kind = kinds_[it->second];
  ++kind.count;
  if (result.which.is_varied) ++kind.varied;
  return &kind;
}

}  // namespace understudy::emulator::play
