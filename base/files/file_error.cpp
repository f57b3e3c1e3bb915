#include "base/files/file_error.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/text/one_line.h"

namespace understudy {

namespace {

std::vector<FileError::Diagnostic> alone(FilePlace place, const std::string& text) {
  std::vector<FileError::Diagnostic> diagnostics(1);
  diagnostics.front().place = std::move(place);
  diagnostics.front().text = one_line(text);
  return diagnostics;
}

std::string joined(const std::vector<FileError::Diagnostic>& diagnostics) {
  std::string lines;
  for (const FileError::Diagnostic& diagnostic : diagnostics) {
    lines += (lines.empty() ? "" : "\n") + diagnostic.text;
  }
  return lines;
}

std::string to_text(const FilePlace& place) {
  return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": ";
}

}  // namespace

FileError::FileError(const std::string& text) : FileError(alone({}, text)) {}

FileError::FileError(const FilePlace& place, const std::string& text)
    : FileError(alone(place, to_text(place) + text)) {}

FileError::FileError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

}  // namespace understudy
