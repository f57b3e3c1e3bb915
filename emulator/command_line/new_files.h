// Files that a command writes for somebody to begin with.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::command_line {

struct NewFile {
  std::string path;
  std::string text;
};

/// Throws FileError if something of one of their names is there already.
void demand_new(const std::vector<NewFile>& files);
/// All of them, or none. Nothing is ever overwritten. Throws FileError where something is there already, and
/// GrowingFileError where nothing can be written.
void write_all(const std::vector<NewFile>& files);

}  // namespace understudy::emulator::command_line
