#include "emulator/play/results/failure_kinds.h"

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

/// With # for each number and its unit; what is in a name (Aaxis_2, STATUS.4) stays.
std::string without_numbers(std::string_view text) {
  std::string made;
  for (std::size_t at = 0; at < text.size();) {
    if (is_letter(text[at])) {
      // A name, with all that its dots join.
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
      made += '#';
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
    if (kinds_.size() >= kMost) {
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
