// Begins and ends motions of an axis, independent of their kind.
#pragma once

#include <cstdint>

#include "emulator/models/super_40nc/axis/axis_inputs.h"
#include "emulator/models/super_40nc/axis/axis_parameters.h"
#include "emulator/models/super_40nc/axis/chip_pins.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "motion/axis.h"
#include "motion/move.h"

namespace understudy::emulator::models::super_40nc {

class Starts : protected Chips {
 public:
  Starts(const Chips& chips, AxisInputs& inputs, AxisParameters& parameters, ChipPins& pins)
      : Chips(chips), inputs_(inputs), parameters_(parameters), pins_(pins) {}

  /// Returns the grant of the axis's holder. A refusal is reported with the PLC's line.
  Grant ask(int axis_number, Request request);
  /// Reads the parameters that a motion needs when it starts.
  void prepare(int axis_number, bool homes = false);
  void begun(int axis_number, motion::Cause why_not, Activity holder);
  /// Writes the chip's registers as a start would leave them.
  void mirror_start(int axis_number, int mode, std::int64_t distance_pulses, const motion::SpeedLaw& law);
  void fail(int axis_number, Code code);
  void let_go(int axis_number);
  /// Returns the limit at which the axis is, if the limit blocks both directions.
  motion::Cause blocked_both_ways(int axis) const;

 private:
  AxisInputs& inputs_;
  AxisParameters& parameters_;
  ChipPins& pins_;
};

}  // namespace understudy::emulator::models::super_40nc
