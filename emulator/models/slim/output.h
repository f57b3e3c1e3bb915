// Sends the text of a SLIM line by line.
#pragma once

#include <string_view>

#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"

namespace understudy::emulator::models::slim {

/// Adds text. Text is dropped beyond a limit that no listing reaches, because a host may type faster than its
/// line can send.
void send_line(State& state, const Setup& setup, std::string_view text);
/// Returns true if there is room for unrequested output from a program, which is faster than its line.
bool has_room_to_print(const State& state, const Setup& setup);
/// Acknowledges a successful command that has no other reply.
void acknowledge(State& state, const Setup& setup);
/// Sends and stores an error. Returns the module to which the error is assigned.
int fail(State& state, const Setup& setup, int module, Error error);
/// Sends the prompt that follows each completed line.
void conclude(State& state, const Setup& setup);

}  // namespace understudy::emulator::models::slim
