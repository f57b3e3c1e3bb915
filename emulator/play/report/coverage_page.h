// Shows how often program lines have run.
#pragma once

#include <string>
#include <string_view>

#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::play {

/// Returns a table of the programs, beginning with those that have the most lines that have not run, followed
/// by each program with its counts. The texts are read from the paths in the report. Lines that have not run,
/// and outcomes that have not occurred, are highlighted.
std::string coverage_section(const world::CoverageReport& report);

/// Returns the section as an HTML page that needs no other files and no network. Equal reports about equal
/// files result in equal pages.
std::string coverage_page(const world::CoverageReport& report, std::string_view version);

/// Returns "83 of 120 lines (69.2 %), 30 of 40 branches (75.0 %)".
std::string coverage_text(const world::CoverageTotals& totals);

}  // namespace understudy::emulator::play
