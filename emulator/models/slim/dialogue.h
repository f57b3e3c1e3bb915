// Handles a line of the dialogue, and creates the reply.
#pragma once

#include <string_view>

#include "emulator/device/register_map/refusal.h"
#include "emulator/device/text/text_protocol.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/machine.h"

namespace understudy::emulator::models::slim {

TextRules text_rules(const Setup& setup);
/// Enters a program line, passes a number to GETI or GETR, or executes a command. The reply is in the state.
void receive_line(State& state, const Setup& setup, const lang::Machine& machine, std::string_view line);
void receive_overlong(State& state, const Setup& setup);
/// Executes a command silently, without using the line.
DeviceAnswer take_command(State& state, const Setup& setup, const lang::Machine& machine,
                          std::string_view line);

}  // namespace understudy::emulator::models::slim
