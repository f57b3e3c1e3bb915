#include "emulator/command_line/yaml_files.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/files/file_error.h"

namespace understudy::emulator::command_line {

namespace fs = std::filesystem;

std::vector<std::string> files_below(const std::string& folder, std::span<const std::string_view> endings) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const fs::path& path = it->path();
    const bool is_hidden = path.filename().string().starts_with(".");
    if (is_hidden && it->is_directory()) it.disable_recursion_pending();
    if (is_hidden || it->is_directory()) continue;
    if (std::find(endings.begin(), endings.end(), path.extension().string()) != endings.end())
      files.push_back(path.lexically_normal().string());  // services that annotate files do not accept "./"
  }
  if (error)
    throw FileError(folder + ": folder: cannot be read (" + error.message() +
                    "); expected a readable folder");
  if (files.empty())
    throw FileError(folder + ": folder: has no " + std::string(endings.front()) +
                    " file; expected at least one");
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> with_folders_opened(const std::vector<std::string>& paths,
                                             std::span<const std::string_view> endings) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    const auto below = files_below(path, endings);
    files.insert(files.end(), below.begin(), below.end());
  }
  return files;
}

}  // namespace understudy::emulator::command_line
