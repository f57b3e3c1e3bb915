// Writes the `hunt` section of a scenario as JSON, for programs that draw disturbances themselves.
#pragma once

#include <string>

#include "emulator/hunt/course.h"
#include "emulator/play/reading/hunt_plan.h"

namespace understudy::emulator::command_line {

/// Returns a line of JSON. Each drawn value in a step is `{"drawn": N}`, the N-th of the entry's `values`: a
/// list of texts. A range of more than a thousand values is thinned out to that many.
std::string plan_text(const play::HuntPlan& plan, const hunt::Undisturbed& undisturbed);

}  // namespace understudy::emulator::command_line
