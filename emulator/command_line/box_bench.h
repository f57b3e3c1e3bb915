// The input of `compare` and `calibrate`: captures, and a bench that stands for the controller.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/content_kind.h"
#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/command_line/commands.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::command_line {

struct BoxBench {
  world::Bench bench;
  std::vector<box::Capture> captures;
  box::CompareSettings settings;
};

/// Reads everything that the arguments name. `command` is for messages. Throws UsageError and FileError.
BoxBench read_box_bench(ModelList models, const std::string& command, const CompareArguments& arguments);

/// Returns what the reader of a capture has noticed, in sentences: "3 bytes belong to no frame".
std::vector<std::string> notes_text(const box::CaptureNotes& notes);

/// Returns why a command that wants another kind of file refuses one that begins with `head`, like
/// is_another_kind(). It knows captures of other programs, too, and says which command takes them.
std::string why_no_capture_is_expected(std::string_view head, ContentKind expected);

/// Returns "feeder" and the id of a choice: "feeder.exceptions".
std::string choice_text(const world::Bench& bench, std::size_t device, const std::string& id);

}  // namespace understudy::emulator::command_line
