// RS-M8194H: handles an axis that reaches an edge, at the exact moment and for any kind of motion: records
// errors, marks interrupts, and executes synchronous actions (7.3) on all axes that they affect.
#pragma once

#include <array>
#include <cstddef>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/drives/drives.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "motion/axis.h"
#include "motion/shared_tick.h"
#include "motion/synchronous.h"

namespace understudy::emulator::models::rs_m8194h {

class Edges final : public Part, public motion::EdgeOwner {
 public:
  Edges(const Ground& ground, Chip& chip, Interrupts& interrupts, Streams& streams, Drives& drives)
      : Part(ground), chip_(chip), interrupts_(interrupts), streams_(streams), drives_(drives) {}

  void at_edge(motion::SharedTick& tick, std::size_t axis, motion::Events events) override;

 private:
  // how motions end (ends.cpp)
  motion::Events on_axis_end(std::size_t axis, motion::Events events);
  void on_homed(std::size_t axis);
  void note_end_of_path(std::size_t axis);
  bool is_no_cause(motion::Cause cause, bool is_at_its_end) const;
  // synchronous actions
  void act_together(motion::SharedTick& tick, std::size_t trigger, motion::Events events);
  void act_on_path(motion::SharedTick& tick, motion::SyncAction::Drive drive);

  Chip& chip_;
  Interrupts& interrupts_;
  Streams& streams_;
  Drives& drives_;
};

}  // namespace understudy::emulator::models::rs_m8194h
