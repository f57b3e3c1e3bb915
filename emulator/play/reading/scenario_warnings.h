// Warns about a scenario that can run, but that contains programs (in its bench or its steps) that look
// wrong.
#pragma once

#include <vector>

#include "base/files/file_error.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

/// Returns the warnings in the order of the bench and the steps.
std::vector<FileError::Diagnostic> warnings_of(const Scenario& scenario);

}  // namespace understudy::emulator::play
