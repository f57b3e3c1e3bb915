// Warnings about a bench's programs that load but look wrong (ProgramLanguage::warnings).
#pragma once

#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

/// Returns one line each, about the file of the program; a program inside the bench is called
/// "mill.program".
std::vector<FileError::Diagnostic> program_warnings(const Bench& bench);
/// Returns the warnings for a text that loads into a device of the bench.
std::vector<FileError::Diagnostic> program_warnings(const DeviceSetup& device, const std::string& text,
                                                    const std::string& file);

}  // namespace understudy::emulator::world
