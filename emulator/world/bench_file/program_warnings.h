// What is odd about the programs of a bench, though they load (ProgramLanguage::warnings).
#pragma once

#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

/// Each as a line about the file that the program stands in; of one that the bench has itself,
/// "mill.program".
std::vector<FileError::Complaint> program_warnings(const Bench& bench);
/// Of a text that a device of the bench could be given, and loads.
std::vector<FileError::Complaint> program_warnings(const DeviceSetup& device, const std::string& text,
                                                   const std::string& file);

}  // namespace understudy::emulator::world
