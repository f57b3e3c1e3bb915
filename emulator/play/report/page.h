#pragma once

#include <span>
#include <string>
#include <string_view>

#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"

namespace understudy::emulator::play {

/// Returns the results as one HTML page that needs neither files nor a network: a list of the scenarios, then
/// for each one the reason for its failure, pictures of motion and signals (if the result has a run log), and
/// its steps with their times and frames. Equal results make equal pages. `version` is the version of the
/// program. `all` counts all results if `results` has only some of them. `programs` is a section on programs
/// (coverage_page.h), or empty.
std::string report_page(std::span<const ScenarioResult> results, std::string_view version,
                        const Tally* all = nullptr, std::string_view programs = {});

}  // namespace understudy::emulator::play
