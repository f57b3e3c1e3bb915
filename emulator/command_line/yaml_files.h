// Files and folders as they are given to `run` and `check`, as files.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::command_line {

/// All .yaml and .yml files in a folder and those below it, by their names; nothing from what is hidden, and
/// no folder that is a link. Throws FileError for a folder that cannot be read, or has none.
std::vector<std::string> yaml_files_below(const std::string& folder);

/// Each folder's files in its place.
std::vector<std::string> with_folders_opened(const std::vector<std::string>& paths);

}  // namespace understudy::emulator::command_line
