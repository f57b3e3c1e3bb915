#pragma once

#include <span>
#include <string>
#include <string_view>

#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"

namespace understudy::emulator::play {

/// Returns the results as one HTML page that needs no other files and no network. It contains a list of the
/// scenarios, followed by, for each scenario, the reason for its failure, pictures of motion and signals (if
/// the result has a run log), and its steps with their times and frames. Equal results produce equal pages.
/// `version` is the version of the program. If `results` contains only some of the results, `all` contains
/// the counts of all. `programs` is a section about programs (coverage_page.h), or empty.
std::string report_page(std::span<const ScenarioResult> results, std::string_view version,
                        const Tally* all = nullptr, std::string_view programs = {});

}  // namespace understudy::emulator::play
