// Warnings about programs that load but look wrong (ProgramLanguage::warnings).
#pragma once

#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench/inline_text.h"

namespace understudy::emulator::world {

/// Returns a line for each warning, with its position in the program's file or, if the bench contains the
/// program, in the bench.
std::vector<FileError::Diagnostic> program_warnings(const Bench& bench);
/// Returns the warnings for a text that loads into a device of the bench. `inside` is the place of the text
/// if it is not a separate file.
std::vector<FileError::Diagnostic> program_warnings(const DeviceSetup& device, const std::string& text,
                                                    const std::string& file, const InlineText* inside);

}  // namespace understudy::emulator::world
