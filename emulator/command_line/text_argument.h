#pragma once

#include <string>

#include "base/files/text_file.h"

namespace understudy::emulator::command_line {

/// A text file that the command line names; "-" and "/dev/stdin" are standard input, read to its end.
FileText read_text_argument(const std::string& path);

}  // namespace understudy::emulator::command_line
