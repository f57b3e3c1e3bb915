#include "emulator/world/bench_file/diagnostics.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/device/mistakes_told.h"
#include "emulator/device/program_error.h"

namespace understudy::emulator::world {

FileError program_diagnostics(const ProgramError& error, const std::string& file) {
  std::vector<FileError::Diagnostic> diagnostics;
  for (const ProgramMistake& mistake : with_word_of_more(error.mistakes)) {
    diagnostics.push_back({.place = {.file = file, .line = mistake.line, .column = mistake.column},
                           .text = one_line(in_file(mistake, file))});
  }
  return FileError(std::move(diagnostics));
}

void Diagnostics::add(const FileError& error, const std::string& behind) {
  for (FileError::Diagnostic diagnostic : error.diagnostics()) {
    if (!told_.insert(diagnostic.text).second) continue;
    diagnostic.text += behind;
    diagnostics_.push_back(std::move(diagnostic));
  }
  if (diagnostics_.size() >= kMaxKept) throw LastError(std::vector<FileError::Diagnostic>());
}

void Diagnostics::throw_if_any() const {
  if (diagnostics_.empty()) return;
  std::map<std::string, std::size_t> files;  // in the order of their first diagnostics
  for (const FileError::Diagnostic& diagnostic : diagnostics_)
    files.emplace(diagnostic.place.file, files.size());
  const auto place = [&](const FileError::Diagnostic& diagnostic) {
    return std::tuple(files[diagnostic.place.file], diagnostic.place.line, diagnostic.place.column);
  };
  std::vector<FileError::Diagnostic> sorted = diagnostics_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto& left, const auto& right) { return place(left) < place(right); });
  if (sorted.size() > kMaxTold) {
    const std::size_t more = sorted.size() - kMaxTold;
    sorted.resize(kMaxTold);
    const FileError rest("and " + std::to_string(more) + " more; the first " + std::to_string(kMaxTold) +
                         " are shown");
    sorted.push_back(rest.diagnostics().front());
  }
  throw FileError(std::move(sorted));
}

}  // namespace understudy::emulator::world
