// Tells a recording as a file: `replay --export`, `--picture`.
#pragma once

#include "emulator/command_line/commands.h"
#include "emulator/serve/control/timeline_door.h"

namespace understudy::emulator::command_line {

/// Checks the flags for files that tell a recording. Throws UsageError.
void require_story_flags(const ReplayArguments& arguments);

/// Returns true if a file was asked for.
bool wants_story(const ReplayArguments& arguments);

/// Writes the files. The recording has been played.
void tell_story(const ReplayArguments& arguments, serve::TimelineSetup setup);

}  // namespace understudy::emulator::command_line
