// Writes the `hunt` section of a scenario as JSON, for programs that generate disturbances themselves.
#pragma once

#include <string>

#include "emulator/hunt/course.h"
#include "emulator/play/reading/hunt_plan.h"

namespace understudy::emulator::command_line {

/// Returns a line of JSON. Each drawn value in a step is `{"drawn": N}`, which is entry N of `values`, a list
/// of texts. Longer ranges are reduced to a thousand values.
std::string plan_text(const play::HuntPlan& plan, const hunt::Undisturbed& undisturbed);

}  // namespace understudy::emulator::command_line
