#include "emulator/world/bench/inline_text.h"

#include <string>

#include "base/files/file_error.h"
#include "emulator/device/program_error.h"

namespace understudy::emulator::world {

FileError::Diagnostic diagnostic_in(const InlineText& text, const ProgramMistake& mistake) {
  if (text.first_line == 0 || mistake.line == 0)
    return FileError(text.place, text.field + ": " + in_text(mistake)).diagnostics().front();
  const FilePlace place{.file = text.place.file,
                        .line = text.first_line + mistake.line - 1,
                        .column = text.indentation + (mistake.column > 0 ? mistake.column : 1)};
  return FileError(place, text.field + ": " + mistake.what).diagnostics().front();
}

}  // namespace understudy::emulator::world
