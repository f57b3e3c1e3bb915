// What is odd about a scenario, though it can be played: about the programs of its bench and of its steps.
#pragma once

#include <vector>

#include "base/files/file_error.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

/// In the order of the bench and of the steps.
std::vector<FileError::Complaint> warnings_of(const Scenario& scenario);

}  // namespace understudy::emulator::play
