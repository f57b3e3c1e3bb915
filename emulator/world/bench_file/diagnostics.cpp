#include "emulator/world/bench_file/diagnostics.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/device/more_mistakes.h"
#include "emulator/device/program_error.h"
#include "emulator/world/bench/inline_text.h"

namespace understudy::emulator::world {

FileError program_diagnostics(const ProgramError& error, const std::string& file) {
  std::vector<FileError::Diagnostic> diagnostics;
  for (const ProgramMistake& mistake : with_word_of_more(error.mistakes)) {
    diagnostics.push_back({.place = {.file = file, .line = mistake.line, .column = mistake.column},
                           .text = one_line(in_file(mistake, file))});
  }
  return FileError(std::move(diagnostics));
}

FileError program_diagnostics(const ProgramError& error, const InlineText& text) {
  std::vector<FileError::Diagnostic> diagnostics;
  for (const ProgramMistake& mistake : with_word_of_more(error.mistakes))
    diagnostics.push_back(diagnostic_in(text, mistake));
  return FileError(std::move(diagnostics));
}

namespace {

constexpr std::string_view kAnd = "and ";

/// Returns the line that represents the errors that are not reported.
FileError::Diagnostic word_of_more(std::size_t more) {
  const FileError word(std::string(kAnd) + std::to_string(more) + " more; the first " +
                       std::to_string(Diagnostics::kMaxReported) + " are shown");
  return word.diagnostics().front();
}

/// Returns the number in a line from word_of_more(), or 0.
std::size_t more_in(const FileError::Diagnostic& diagnostic) {
  if (!diagnostic.place.file.empty() || !diagnostic.text.starts_with(kAnd)) return 0;
  const std::string number =
      diagnostic.text.substr(kAnd.size(), diagnostic.text.find(' ', kAnd.size()) - kAnd.size());
  const auto more = static_cast<std::size_t>(parse_integer(number).value_or(0));
  return diagnostic.text == word_of_more(more).text ? more : 0;
}

}  // namespace

void Diagnostics::add(const FileError& error, const std::string& suffix) {
  for (FileError::Diagnostic diagnostic : error.diagnostics()) {
    if (const std::size_t more = more_in(diagnostic)) {
      more_ += more;
      continue;
    }
    if (!reported_.insert(diagnostic.text).second) continue;
    diagnostic.text += suffix;
    diagnostics_.push_back(std::move(diagnostic));
  }
  if (diagnostics_.size() >= kMaxKept) throw LastError(std::vector<FileError::Diagnostic>());
}

void Diagnostics::throw_if_any() const {
  if (diagnostics_.empty()) return;
  std::map<std::string, std::size_t> files;  // in the order of the files' first diagnostics
  for (const FileError::Diagnostic& diagnostic : diagnostics_)
    files.emplace(diagnostic.place.file, files.size());
  const auto place = [&](const FileError::Diagnostic& diagnostic) {
    return std::tuple(files[diagnostic.place.file], diagnostic.place.line, diagnostic.place.column);
  };
  std::vector<FileError::Diagnostic> sorted = diagnostics_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto& left, const auto& right) { return place(left) < place(right); });
  const std::size_t more = more_ + sorted.size() - std::min(sorted.size(), kMaxReported);
  if (more > 0) {
    sorted.resize(std::min(sorted.size(), kMaxReported));
    sorted.push_back(word_of_more(more));
  }
  throw FileError(std::move(sorted));
}

}  // namespace understudy::emulator::world
