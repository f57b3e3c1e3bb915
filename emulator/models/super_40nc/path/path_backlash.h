// Backlash before a LIN or an arc and, depending on a choice, within an arc.
#pragma once

#include <array>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/path/path_state.h"
#include "motion/path.h"

namespace understudy::emulator::models::super_40nc {

class PathBacklash : protected Chips {
 public:
  PathBacklash(const Chips& chips, PathState& state) : Chips(chips), state_(state) {}

  /// Returns true while backlash must still be sent before the path.
  bool awaits_path() const;
  void begin_path_backlash(const motion::Path& path);
  void step_path_backlash(Tick tick, std::array<std::int64_t, kAxisCount>& sent);
  void step_arc_backlash(const std::array<std::int8_t, kAxisCount>& directions_before,
                         std::array<std::int64_t, kAxisCount>& sent);

 private:
  void end_path_backlash();

  PathState& state_;
};

}  // namespace understudy::emulator::models::super_40nc
