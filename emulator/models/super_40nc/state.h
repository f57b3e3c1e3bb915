// The whole state of a SUPER-40NC as one value: the states of its parts.
#pragma once

#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/commands.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/panel/pressed_keys.h"
#include "emulator/models/super_40nc/path/path_state.h"
#include "emulator/models/super_40nc/programs/program_state.h"

namespace understudy::emulator::models::super_40nc {

struct State : GroundState, AxesState, PathState, PanelState, ProgramState, ScanState {
  bool operator==(const State&) const = default;
};

}  // namespace understudy::emulator::models::super_40nc
