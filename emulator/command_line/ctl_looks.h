// The words of `ctl` for onlookers (docs/control.md): what there is, what has happened, how time goes by.
#pragma once

#include <nlohmann/json.hpp>

#include "emulator/command_line/commands.h"

namespace understudy::emulator::command_line {

/// Puts the words of a command line into the message, which says already what to do. False: it is another
/// one's. Throws UsageError.
bool add_look_words(const ControlArguments& arguments, nlohmann::ordered_json& message);

/// False: it is another message's reply.
bool print_look(const nlohmann::ordered_json& reply);

}  // namespace understudy::emulator::command_line
