#include "emulator/text_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace understudy::emulator {

std::optional<std::string> read_text_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return std::nullopt;  // it opens, and reads as empty
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad()) return std::nullopt;
  return text;
}

}  // namespace understudy::emulator
