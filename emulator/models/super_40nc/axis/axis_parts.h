// The parts of the axes. Each part may use only the parts before it.
#pragma once

#include "emulator/models/super_40nc/axis/axis_flags.h"
#include "emulator/models/super_40nc/axis/axis_inputs.h"
#include "emulator/models/super_40nc/axis/axis_parameters.h"
#include "emulator/models/super_40nc/axis/chip_pins.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/comparators.h"
#include "emulator/models/super_40nc/axis/counters.h"
#include "emulator/models/super_40nc/axis/drives.h"
#include "emulator/models/super_40nc/axis/homes.h"
#include "emulator/models/super_40nc/axis/jogs.h"
#include "emulator/models/super_40nc/axis/starts.h"
#include "emulator/models/super_40nc/axis/tick_edges.h"
#include "emulator/models/super_40nc/axis/wheel.h"

namespace understudy::emulator::models::super_40nc {

struct AxisParts {
  explicit AxisParts(const Chips& view) : chips(view) {}
  AxisParts(const AxisParts&) = delete;
  AxisParts& operator=(const AxisParts&) = delete;

  Chips chips;
  Comparators comparators{chips};
  AxisInputs inputs{chips};
  AxisParameters parameters{chips, comparators, inputs};
  Counters counters{chips, comparators, parameters};
  ChipPins pins{chips, parameters, counters};
  TickEdges edges{chips, inputs, counters, pins};
  AxisFlags flags{chips, comparators, pins};
  Starts starts{chips, inputs, parameters, pins};
  Jogs jogs{chips, starts};
  Wheel wheel{chips, starts};
  Homes homes{chips, inputs, parameters, pins, starts};
  Drives drives{chips, inputs, starts};
};

}  // namespace understudy::emulator::models::super_40nc
