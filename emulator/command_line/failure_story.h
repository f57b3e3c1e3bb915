// Lists the events that led to the failure of a scenario, from its recording. The live page shows the same
// text.
#pragma once

#include <string>
#include <vector>

#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// Returns a line for each event. Returns no lines if the recording cannot be replayed.
std::vector<std::string> events_before_failure(ModelList models, const std::string& recording);

}  // namespace understudy::emulator::command_line
