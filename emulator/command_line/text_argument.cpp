#include "emulator/command_line/text_argument.h"

#include <unistd.h>

#include <string>

#include "base/files/text_file.h"

namespace understudy::emulator::command_line {

FileText read_text_argument(const std::string& path) {
  return path == "-" || path == "/dev/stdin" ? read_text_of(STDIN_FILENO) : read_text_file(path);
}

}  // namespace understudy::emulator::command_line
