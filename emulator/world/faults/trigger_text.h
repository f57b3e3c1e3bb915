// Converts triggers to and from text: nth=3 function=6 when="feeder.A.position >= 12000" (docs/faults.md).
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/world/faults/trigger.h"

namespace understudy::emulator::world {

/// Returns the names that set_trigger_field() accepts.
std::vector<std::string> trigger_fields();
/// Returns false if there is no such field. Throws NameError if the field cannot have this value. An address
/// must be a number here, and names in `when` are not looked up.
bool set_trigger_field(FaultTrigger& trigger, std::string_view name, const std::string& text);
/// Throws NameError for fields that contradict each other.
void validate_trigger(const FaultTrigger& trigger);
/// Returns the fields that are set.
std::vector<std::pair<std::string, std::string>> fields_of(const FaultTrigger& trigger);

}  // namespace understudy::emulator::world
