// A scene as a picture: what moved, how fast, and what switched, over time.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "emulator/play/report/footage.h"
#include "emulator/play/results/result.h"

namespace understudy::emulator::play {

struct PictureMarks {
  std::span<const StepResult> steps;  // those of the scene
  std::size_t first_number = 1;       // of them
  std::optional<SimTime> failed_at;
  std::string_view of;  // what is shown, for those who hear the page: the scenario's name
};

/// As an SVG element, whose classes page_parts.h gives their looks; empty if nothing of the scene varies,
/// unless it failed. Each line has its data in `points`, as milliseconds since `data-begin` of the whole and
/// amounts beyond `data-base` of its own, so that what is shown of a value under the pointer is exact.
std::string picture(const Scene& scene, const PictureMarks& marks);

}  // namespace understudy::emulator::play
