#pragma once

#include <span>
#include <string>
#include <string_view>

#include "emulator/play/results/result.h"

namespace understudy::emulator::play {

/// Results as JUnit XML: a test suite for each file, a test case for each scenario or branch. Times are
/// simulated seconds; the steps and the lint's findings are in system-out.
std::string junit_text(std::span<const ScenarioResult> results);

/// For XML, in attributes as well: what XML cannot hold (control characters, broken UTF-8) becomes U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace understudy::emulator::play
