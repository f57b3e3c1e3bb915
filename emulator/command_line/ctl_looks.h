// Implements the `ctl` commands for observers (docs/control.md): the bench's contents, events, and time.
#pragma once

#include <nlohmann/json.hpp>

#include "emulator/command_line/commands.h"

namespace understudy::emulator::command_line {

/// Adds the words of a command line to the message, which already contains "do". Returns false if the message
/// is not one of these commands. Throws UsageError.
bool add_look_words(const ControlArguments& arguments, nlohmann::ordered_json& message);

/// Prints the reply. Returns false if the reply does not belong to one of these commands.
bool print_look(const nlohmann::ordered_json& reply);

}  // namespace understudy::emulator::command_line
