// Coverage as lcov's tracefile, which is also what the sum of several runs is made from.
#pragma once

#include <string>
#include <string_view>

#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::world {

/// Reads a tracefile: of this program, or several merged by lcov. Throws FileError, which names `file`
/// and the line.
CoverageReport read_tracefile(std::string_view text, const std::string& file);

}  // namespace understudy::emulator::world
