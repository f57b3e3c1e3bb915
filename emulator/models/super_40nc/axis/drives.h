// Motions of a single axis that a program or the PLC starts: DRV, MRK and VDRV.
#pragma once

#include <cstdint>

#include "emulator/models/super_40nc/axis/axis_inputs.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/starts.h"
#include "motion/move.h"

namespace understudy::emulator::models::super_40nc {

class Drives : protected Chips {
 public:
  Drives(const Chips& chips, AxisInputs& inputs, Starts& starts)
      : Chips(chips), inputs_(inputs), starts_(starts) {}

  /// Returns D8005 within its limits.
  double override_percent() const;
  /// Returns the speed law of DRV. A choice decides whether the feed override scales it.
  motion::SpeedLaw drive_law(int axis, std::int32_t rpm, Mover mover) const;
  // Each of these functions returns true if the motion has begun; otherwise, it reports its error.
  bool begin_drive(int axis_number, std::int64_t target_lu, std::int32_t rpm, Mover mover);
  bool begin_mark(int axis_number, std::int64_t distance, std::int64_t search, std::int32_t rpm, Mover mover);
  bool begin_blind_mark(int axis_number, std::int64_t target_lu, std::int32_t rpm, Mover mover);
  bool begin_turning(int axis_number, std::int32_t rpm, Mover mover);
  void change_turning(int axis_number, std::int32_t rpm, Mover mover);

 private:
  motion::SpeedLaw line_law(int axis, double rpm, Mover mover) const;

  AxisInputs& inputs_;
  Starts& starts_;
};

}  // namespace understudy::emulator::models::super_40nc
