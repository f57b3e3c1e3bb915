// RS-M8194H: what a command of 7.2 or 7.4 draws, and how fast, as a value. The path itself is part of
// motion/.
#pragma once

#include <array>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "motion/move.h"
#include "motion/path.h"
#include "motion/path_run.h"

namespace understudy::emulator::models::rs_m8194h {

struct PathDrawing {
  motion::PathRun run;
  std::array<double, 4> end{};  // in pulses from where the run began
  double length = 0;            // length of the part drawn now; 0: the command draws nothing
  motion::SpeedLaw law;

  motion::Point at() const { return {end[0], end[1], end[2], end[3]}; }
  void add(const motion::Path& path, Tick now) {
    run.append(path, {.rule = motion::Joint::Rule::join}, now);
    length += path.length_u;
    for (Eigen::Index i = 0; i < motion::kPathAxes; ++i) end[static_cast<std::size_t>(i)] = path.end[i];
  }
};

/// Draws a path. If it joins its stream, it follows the running path. Throws BadMotion if it cannot be drawn.
PathDrawing draw_path(const Chip& chip, const HeldPath& path, bool joins);

}  // namespace understudy::emulator::models::rs_m8194h
