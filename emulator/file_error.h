#pragma once

#include <stdexcept>
#include <string>

#include "emulator/one_line.h"

namespace understudy::emulator {

/// What is wrong with a file that a user wrote. One line: "file:line: field: what is wrong; what was
/// expected".
struct FileError : std::runtime_error {
  explicit FileError(const std::string& text) : std::runtime_error(one_line(text)) {}
};

}  // namespace understudy::emulator
