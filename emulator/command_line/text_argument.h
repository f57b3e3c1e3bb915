#pragma once

#include <string>

#include "base/files/text_file.h"

namespace understudy::emulator::command_line {

/// Reads a text file given on the command line. "-" and "/dev/stdin" mean standard input, which is read to
/// its end.
FileText read_text_argument(const std::string& path);

}  // namespace understudy::emulator::command_line
