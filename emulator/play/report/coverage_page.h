// Shows how often the lines of programs have run.
#pragma once

#include <string>
#include <string_view>

#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::play {

/// Returns a table of the programs, those with the most lines that have not run first, and then each program
/// with its counts. Texts are read from the paths of the report. Lines that have not run, and outcomes that
/// have not occurred, stand out.
std::string coverage_section(const world::CoverageReport& report);

/// Returns the section as an HTML page that needs neither files nor a network. Equal reports of equal files
/// make equal pages.
std::string coverage_page(const world::CoverageReport& report, std::string_view version);

/// Returns "83 of 120 lines (69.2 %), 30 of 40 branches (75.0 %)".
std::string coverage_text(const world::CoverageTotals& totals);

}  // namespace understudy::emulator::play
