// Writes the page or a picture of a recording: `replay --export`, `--picture`.
#pragma once

#include "emulator/command_line/commands.h"
#include "emulator/serve/control/timeline_door.h"

namespace understudy::emulator::command_line {

/// Checks the flags for these files. Throws UsageError.
void require_story_flags(const ReplayArguments& arguments);

/// Returns true if the flags ask for a file.
bool wants_story(const ReplayArguments& arguments);

/// Writes the requested files about a replayed recording.
void print_story(const ReplayArguments& arguments, serve::TimelineSetup setup);

}  // namespace understudy::emulator::command_line
