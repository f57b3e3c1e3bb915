#pragma once

#include <span>
#include <string>
#include <string_view>

#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"

namespace understudy::emulator::play {

/// Results as one HTML page that needs nothing else, neither files nor a network: a list of the scenarios,
/// then for each one why it failed, pictures of what moved and switched (where the result has footage), its
/// steps with their times and frames. Equal results make equal pages. `version`: of the program. `all`: of
/// how many results these are a part.
std::string report_page(std::span<const ScenarioResult> results, std::string_view version,
                        const Tally* all = nullptr);

}  // namespace understudy::emulator::play
