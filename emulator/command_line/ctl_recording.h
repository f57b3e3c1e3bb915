// Implements the `ctl` commands that only a recording has (docs/control.md): its marks, and moving in it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "emulator/command_line/commands.h"

namespace understudy::emulator::command_line {

/// Adds the words of `timeline`, `seek` and `what-if` to the message, which already has its "do". Returns
/// false if it is another message. Throws UsageError.
bool add_recording_words(const ControlArguments& arguments, nlohmann::ordered_json& message);

/// Prints the reply to `timeline`: the failure with what led there, then the marks.
void print_timeline(const nlohmann::ordered_json& reply);

}  // namespace understudy::emulator::command_line
