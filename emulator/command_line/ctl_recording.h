// Implements the `ctl` commands that are only for recordings (docs/control.md): they list marks, and move
// through the recording.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "emulator/command_line/commands.h"

namespace understudy::emulator::command_line {

/// Adds the words of `timeline`, `seek` and `what-if` to the message, which already contains "do". Returns
/// false for other messages. Throws UsageError.
bool add_recording_words(const ControlArguments& arguments, nlohmann::ordered_json& message);

/// Prints the reply to `timeline`: the failure with the events before it, then the marks.
void print_timeline(const nlohmann::ordered_json& reply);

}  // namespace understudy::emulator::command_line
