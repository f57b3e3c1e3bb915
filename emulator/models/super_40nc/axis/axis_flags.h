// The flags of an axis that M8x20 to M8x58 and M8x92 to M8x99 show.
#pragma once

#include "emulator/models/super_40nc/axis/chip_pins.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/comparators.h"
#include "emulator/models/super_40nc/rows/effects.h"

namespace understudy::emulator::models::super_40nc {

class AxisFlags : protected Chips {
 public:
  AxisFlags(const Chips& chips, const Comparators& comparators, const ChipPins& pins)
      : Chips(chips), comparators_(comparators), pins_(pins) {}

  bool status(int axis_number, AxisStatus what) const;

 private:
  /// Returns true if M8x97 to M8x99 show a motion.
  bool shows_running(bool is_by_contact) const;

  const Comparators& comparators_;
  const ChipPins& pins_;
};

}  // namespace understudy::emulator::models::super_40nc
