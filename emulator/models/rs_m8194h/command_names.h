// The commands of the window by the manual's names, for people: `RSM_FIXED_MOVE XYZU 10000`.
#pragma once

#include "emulator/device/command_window.h"

namespace understudy::emulator::models::rs_m8194h {

/// Real-time commands and macro lines. Parameters are checked as the manual gives them; what a device's
/// choices and state say to a command, it says itself.
const CommandWindow& command_names();

}  // namespace understudy::emulator::models::rs_m8194h
