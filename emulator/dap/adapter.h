// Serves a session of the Debug Adapter Protocol on two descriptors.
#pragma once

#include <functional>
#include <string>

#include "emulator/dap/session.h"

namespace understudy::emulator::dap {

/// Serves until the client ends the session or disconnects, or `is_interrupted` returns true after a signal.
/// Returns an empty text, or one sentence if the input is not the protocol and nothing more can be read.
std::string serve_session(int input, int output, const Launcher& launcher,
                          const std::function<bool()>& is_interrupted);

/// Tells a client that it will not be served, in the reply to its first request if one arrives soon.
void refuse_session(int client, const std::string& why);

}  // namespace understudy::emulator::dap
