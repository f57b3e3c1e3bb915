// RS-M8194H: the effects of commands. The table in commands.cpp has a function for every verb that a device
// executes.
#pragma once

#include "emulator/models/rs_m8194h/module.h"
#include "interpreter/rs_m8194h/command.h"

namespace understudy::emulator::models::rs_m8194h {

using CommandAction = Took (*)(Module& it, const lang::Command& command);

/// Returns the function of a verb that the device executes.
CommandAction action_of(lang::Verb verb);

}  // namespace understudy::emulator::models::rs_m8194h
