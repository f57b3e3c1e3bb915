// A text, such as a program, that is written within another file.
#pragma once

#include <string>

#include "base/files/file_error.h"
#include "emulator/device/program_error.h"

namespace understudy::emulator::world {

struct InlineText {
  FilePlace place;      // the value's position in the file
  std::string field;    // the value's field in the file
  int first_line = 0;   // the line in the file where the text begins; 0: its lines are not lines of the file
  int indentation = 0;  // the indentation of those lines, in characters
};

/// Returns what is wrong with the text. If the text's lines are lines of the file, the diagnostic has the
/// exact line of the file.
FileError::Diagnostic diagnostic_in(const InlineText& text, const ProgramMistake& mistake);

}  // namespace understudy::emulator::world
