// HOME and ZERO: how they start, and their results (《X20.》 to 《X32.》, 《X26.》).
#pragma once

#include "emulator/models/super_40nc/axis/axis_inputs.h"
#include "emulator/models/super_40nc/axis/axis_parameters.h"
#include "emulator/models/super_40nc/axis/chip_pins.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/starts.h"

namespace understudy::emulator::models::super_40nc {

class Homes : protected Chips {
 public:
  Homes(const Chips& chips, AxisInputs& inputs, AxisParameters& parameters, ChipPins& pins, Starts& starts)
      : Chips(chips), inputs_(inputs), parameters_(parameters), pins_(pins), starts_(starts) {}

  void start_home(int axis_number, int order = 0);
  void start_zero(int axis_number, int order = 0);
  /// Called when a homing has ended. `code` is the reason for a failure; none: the homing was abandoned.
  void home_ended(int axis_number, bool found, Code code);
  /// Called when the zero return of an axis has ended before its target.
  void zero_failed(int axis_number);

 private:
  void home_fails(int axis_number);

  AxisInputs& inputs_;
  AxisParameters& parameters_;
  ChipPins& pins_;
  Starts& starts_;
};

}  // namespace understudy::emulator::models::super_40nc
