#include "emulator/command_line/text_argument.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

namespace understudy::emulator {

FileText read_text_argument(const std::string& path) {
  if (path != "-" && path != "/dev/stdin") return read_text_file(path);
  FileText text;
  std::string bytes;
  std::array<char, std::size_t{1} << 16> piece{};
  while (true) {
    const ssize_t size = ::read(STDIN_FILENO, piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return text;
    if (size == 0) break;
    if (bytes.size() + static_cast<std::size_t>(size) > kMostTextBytes) {
      text.why = "is larger than " + std::to_string(kMostTextBytes >> 20) + " MiB";
      return text;
    }
    bytes.append(piece.data(), static_cast<std::size_t>(size));
  }
  text.emplace(std::move(bytes));
  return text;
}

}  // namespace understudy::emulator
