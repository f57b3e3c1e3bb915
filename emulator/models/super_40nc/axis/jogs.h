// Jogs that a contact or the PLC requests.
#pragma once

#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/starts.h"
#include "motion/move.h"

namespace understudy::emulator::models::super_40nc {

class Jogs : protected Chips {
 public:
  Jogs(const Chips& chips, Starts& starts) : Chips(chips), starts_(starts) {}

  void start_jog(int axis_number, int direction, bool AxisState::*asked_by);
  /// Stops a jog along its ramp when no request remains.
  void release_jog(int axis_number, bool AxisState::*asked_by);
  /// Applies D8022.
  void change_jog_speed();

 private:
  motion::SpeedLaw jog_law(int axis) const;

  Starts& starts_;
};

}  // namespace understudy::emulator::models::super_40nc
