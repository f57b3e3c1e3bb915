// Writes the first files of a user.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::command_line {

struct NewFile {
  std::string path;
  std::string text;
};

/// Throws FileError if any of the names exists already.
void require_new(const std::vector<NewFile>& files);
/// Writes all files, or none. Never overwrites a file. Throws FileError if one exists already, and
/// GrowingFileError if one cannot be written.
void write_all(const std::vector<NewFile>& files);

}  // namespace understudy::emulator::command_line
