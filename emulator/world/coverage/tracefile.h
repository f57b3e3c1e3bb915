// Reads coverage from lcov tracefiles, so that several runs can be added up.
#pragma once

#include <string>
#include <string_view>

#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::world {

/// Reads a tracefile that this program or lcov has written. Throws FileError, which contains `file` and the
/// line.
CoverageReport read_tracefile(std::string_view text, const std::string& file);

}  // namespace understudy::emulator::world
