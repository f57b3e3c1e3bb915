// Warnings about a bench's programs that load but look wrong (ProgramLanguage::warnings).
#pragma once

#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench/inline_text.h"

namespace understudy::emulator::world {

/// Returns a line for each warning, at its place in the program's file, or in the bench if it contains the
/// program.
std::vector<FileError::Diagnostic> program_warnings(const Bench& bench);
/// Returns the warnings for a text that loads into a device of the bench. `inside` is its place if it is not
/// a file of its own.
std::vector<FileError::Diagnostic> program_warnings(const DeviceSetup& device, const std::string& text,
                                                    const std::string& file, const InlineText* inside);

}  // namespace understudy::emulator::world
