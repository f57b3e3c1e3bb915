// Formats the findings of `check` for people, editors and CI services.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file_error.h"

namespace understudy::emulator::command_line {

struct Finding {
  FilePlace place;   // line 0: the whole file; column 0: the whole line
  std::string text;  // the error and the expected input, without the position
  bool is_warning = false;
};

struct CheckedFile {
  std::string file;
  std::string kind;  // "bench", "scenario", "steps", "program" or "file": the kind of file that was expected
  std::string is{};  // "a bench with 1 line and 2 devices"; empty if there are errors
  std::vector<Finding> findings{};
  bool is_wrong() const { return is.empty(); }
};

enum class FindingFormat : std::uint8_t { text, json, sarif, github };
std::optional<FindingFormat> finding_format_called(std::string_view name);

/// Converts one of the `diagnostics` of a file error to a finding. Removes the position at the start of its
/// text.
Finding finding_of(const FileError::Diagnostic& diagnostic, const std::string& file);

/// Returns a line for a warning, such as "mill.lst:4: warning: label K1 stands twice".
std::string warning_line(const FileError::Diagnostic& odd);

/// Prints valid files to standard output, and errors to standard error in the usual format.
void print_as_text(const CheckedFile& checked);
/// Returns all findings as text for standard output.
std::string findings_as(FindingFormat format, std::span<const CheckedFile> files);

}  // namespace understudy::emulator::command_line
