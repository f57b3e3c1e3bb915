// Writes the first files for a new user.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::command_line {

struct NewFile {
  std::string path;
  std::string text;
};

/// Throws FileError if any of the files already exists.
void require_new(const std::vector<NewFile>& files);
/// Writes either all files or none. Never overwrites a file. Throws FileError if a file already exists, and
/// GrowingFileError if a file cannot be written.
void write_all(const std::vector<NewFile>& files);

}  // namespace understudy::emulator::command_line
