// Applies written parameters and counters to an axis.
#pragma once

#include <cstdint>

#include "emulator/models/super_40nc/axis/axis_inputs.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/comparators.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

class AxisParameters : protected Chips {
 public:
  AxisParameters(const Chips& chips, Comparators& comparators, AxisInputs& inputs)
      : Chips(chips), comparators_(comparators), inputs_(inputs) {}

  /// Applies a written register of an axis: D9x00 + `number`, or, if `number` is 0, a D8x.
  void apply_axis_parameters(int axis_number, int number);
  /// Applies the parameters of all axes.
  void apply_all_axis_parameters();
  void set_work_lu(int axis_number, std::int64_t position);
  void set_counter(int axis_number, int number, std::int32_t pulses);
  /// Executes ZERO SET.
  void set_zero(int axis_number);
  motion::AxisSettings motor_settings(int axis, bool homes) const;

 private:
  motion::AxisSettings motor_settings(int axis) const {
    return motor_settings(axis, chip(axis).homing.active());
  }
  void keep_display(int axis);

  Comparators& comparators_;
  AxisInputs& inputs_;
};

}  // namespace understudy::emulator::models::super_40nc
