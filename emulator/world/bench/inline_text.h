// A text, such as a program, that is written inside another file.
#pragma once

#include <string>

#include "base/files/file_error.h"
#include "emulator/device/program_error.h"

namespace understudy::emulator::world {

struct InlineText {
  FilePlace place;      // the value's place in the file
  std::string field;    // the value's field in the file
  int first_line = 0;   // where the text begins in the file; 0: its lines are not lines of the file
  int indentation = 0;  // the indentation of those lines, in characters
};

/// Returns what is wrong with the text, at the exact line of the file if the text's lines are lines of the
/// file.
FileError::Diagnostic diagnostic_in(const InlineText& text, const ProgramMistake& mistake);

}  // namespace understudy::emulator::world
