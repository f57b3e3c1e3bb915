// Turns the files and folders given to `run` and `check` into files.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::command_line {

/// All .yaml and .yml files in a folder and those below it, by their names; nothing hidden, and no folder
/// that is a link. Throws FileError if a folder cannot be read, or has none.
std::vector<std::string> yaml_files_below(const std::string& folder);

/// Replaces each folder by its files.
std::vector<std::string> with_folders_opened(const std::vector<std::string>& paths);

}  // namespace understudy::emulator::command_line
