// The commands of the window as text, with the names in the manual: `RSM_FIXED_MOVE XYZU 10000`.
#pragma once

#include "emulator/device/command_window.h"

namespace understudy::emulator::models::rs_m8194h {

/// Returns the real-time commands and macro lines as text. Parameters are checked against the manual; a
/// device also checks commands against its choices and its state.
const CommandWindow& command_names();

}  // namespace understudy::emulator::models::rs_m8194h
