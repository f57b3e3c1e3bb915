#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace understudy {

/// A place in a file. Lines and columns are counted from 1. Without a line, it is the whole file.
struct FilePlace {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Reports the errors in a file that a user wrote, one line per error: "file:line:column: field: what is
/// wrong; what was expected".
class FileError : public std::runtime_error {
 public:
  struct Diagnostic {
    FilePlace place;
    std::string text;  // the whole line
  };

  explicit FileError(const std::string& text);
  FileError(const FilePlace& place, const std::string& text);
  explicit FileError(std::vector<Diagnostic> diagnostics);

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace understudy
