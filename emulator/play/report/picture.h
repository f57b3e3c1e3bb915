// Draws a stretch: positions, speeds and digital signals over time.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "emulator/play/report/run_log.h"
#include "emulator/play/results/result.h"

namespace understudy::emulator::play {

struct PictureMarks {
  std::span<const StepResult> steps;  // the steps of the stretch
  std::size_t first_number = 1;       // the number of its first step
  std::optional<SimTime> failed_at;
  std::string_view of;  // the scenario's name, for screen readers
};

/// Returns an SVG element with the classes that page_parts.h styles. Unless the stretch has failed, the
/// result is empty if nothing in it varies. Each line has its data in `points`: milliseconds since the
/// picture's `data-begin`, and amounts relative to the line's own `data-base`, so the value shown under the
/// pointer is exact.
std::string picture(const Stretch& stretch, const PictureMarks& marks);

}  // namespace understudy::emulator::play
