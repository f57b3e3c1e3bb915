// RS-M8194H: stops, locks, holds and pauses, and what ends them (7.5), according to the rows of
// transitions.h.
#pragma once

#include <cstddef>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/drives/drives.h"
#include "emulator/models/rs_m8194h/drives/path_starts.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "emulator/models/rs_m8194h/drives/transitions.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"

namespace understudy::emulator::models::rs_m8194h {

class Stops final : public Part {
 public:
  Stops(const Ground& ground, Chip& chip, Streams& streams, Drives& drives, PathStarts& path_starts)
      : Part(ground), chip_(chip), streams_(streams), drives_(drives), path_starts_(path_starts) {}

  void halt(AxisMask axes, const StopRow& row);
  /// Slows down axes without a lock, for a trigger.
  void slow_down(AxisMask axes);
  void clear_stop(AxisMask axes);
  void clear_path_stop();
  void clear_emergency();

  void hold(AxisMask axes);
  void release(AxisMask axes);
  /// Starts held or waiting motion that may begin now.
  void start_held();

  /// Brings moving axes to rest. resume() continues their motion. Homing is not affected.
  void pause();
  void resume();

 private:
  void halt_axis(std::size_t axis, Halt halt, bool leaves_others);
  void leave_path(std::size_t axis, Halt halt);
  Cleared still_there(std::size_t axis, bool other_lock) const;

  Chip& chip_;
  Streams& streams_;
  Drives& drives_;
  PathStarts& path_starts_;
};

}  // namespace understudy::emulator::models::rs_m8194h
