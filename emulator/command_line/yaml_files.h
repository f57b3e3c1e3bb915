// Replaces folders among the arguments of `run` and `check` with their files.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::command_line {

inline constexpr std::array<std::string_view, 2> kYamlEndings{".yaml", ".yml"};

/// Returns all files with one of these endings in a folder and its subfolders, sorted by name. Skips hidden
/// files, and folders that are links. Throws FileError if a folder cannot be read, or contains no such files.
std::vector<std::string> files_below(const std::string& folder, std::span<const std::string_view> endings);

/// Replaces each folder with the files in it.
std::vector<std::string> with_folders_opened(const std::vector<std::string>& paths,
                                             std::span<const std::string_view> endings);

}  // namespace understudy::emulator::command_line
