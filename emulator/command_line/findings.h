// What `check` found in each file, in the forms that people, editors and CI services read.
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
  std::string text;  // what is wrong and what was expected, without the place
  bool is_warning = false;
};

struct CheckedFile {
  std::string file;
  std::string kind;  // "bench", "scenario", "steps", "program" or "file": what it was taken for
  std::string is{};  // "a bench with 1 line and 2 devices"; empty where something is wrong
  std::vector<Finding> findings{};
  bool is_wrong() const { return is.empty(); }
};

enum class FindingFormat : std::uint8_t { text, json, sarif, github };
std::optional<FindingFormat> finding_format_called(std::string_view name);

/// One of `complaints` of a file error as a finding: its line of text begins with its place, which is taken
/// off.
Finding finding_of(const FileError::Complaint& complaint, const std::string& file);

/// "mill.lst:4: warning: label K1 stands twice", of a complaint that only warns.
std::string warning_line(const FileError::Complaint& odd);

/// As `check` has always said it: what is well on standard output, what is wrong on standard error.
void print_as_text(const CheckedFile& checked);
/// The whole of it, ready for standard output.
std::string findings_as(FindingFormat format, std::span<const CheckedFile> files);

}  // namespace understudy::emulator::command_line
