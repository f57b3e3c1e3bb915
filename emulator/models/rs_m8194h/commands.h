// RS-M8194H: what each command does, a function each. The table of them (command_table.cpp) has one for every
// verb that a device carries out.
#pragma once

#include "emulator/models/rs_m8194h/device.h"
#include "interpreter/rs_m8194h/command.h"

namespace understudy::emulator::models::rs_m8194h {

using CommandAction = Took (*)(RsM8194h& it, const lang::Command& command);

/// What a command of the device does.
CommandAction action_of(lang::Verb verb);

}  // namespace understudy::emulator::models::rs_m8194h
