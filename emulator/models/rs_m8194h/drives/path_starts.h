// RS-M8194H: interpolation (lines, arcs, streams, rectangle, helix; 7.2, 7.4). Decides whether a path begins,
// waits, is held, is void, or joins its stream.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/drives/drives.h"
#include "emulator/models/rs_m8194h/drives/path_drawing.h"
#include "emulator/models/rs_m8194h/drives/path_rows.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "interpreter/rs_m8194h/command.h"
#include "motion/path.h"

namespace understudy::emulator::models::rs_m8194h {

class PathStarts final : public Part {
 public:
  PathStarts(const Ground& ground, Chip& chip, Interrupts& interrupts, Streams& streams, Drives& drives)
      : Part(ground), chip_(chip), interrupts_(interrupts), streams_(streams), drives_(drives) {}

  /// Starts a path. The path may have to wait, be held, or have no effect.
  Took follow(const lang::Command& command);
  /// Starts the held paths that may begin now.
  void start_held();

 private:
  std::array<std::uint8_t, 3> codes_of(const lang::Command& command) const;
  bool is_refused(const HeldPath& path) const;
  Took begin(const HeldPath& path);
  /// Returns what happens to a path that does not join a stream.
  Start may_begin(const HeldPath& path);
  Took hold(const HeldPath& path);
  /// Draws a command that can begin, or that joins its stream. Throws BadMotion if it cannot be drawn.
  void draw(const HeldPath& path, bool joins);
  bool set_out(const HeldPath& path, const PathDrawing& drawing);
  bool is_kept_off(const std::array<std::uint8_t, 3>& codes, const motion::Point& direction);

  Chip& chip_;
  Interrupts& interrupts_;
  Streams& streams_;
  Drives& drives_;
};

}  // namespace understudy::emulator::models::rs_m8194h
