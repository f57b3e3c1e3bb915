// The words that `understudy` understands, as its flag parser knows them.
#pragma once

#include <string>

#include "emulator/command_line/completion.h"

namespace CLI {
class App;
}

namespace understudy::emulator::command_line {

/// All commands and flags, with their help.
CommandWords words_of(const CLI::App& app);

/// CLI11 takes an unknown command for a stray word and complains that one is missing. Says which word or flag
/// it was, and what is similar; empty if the trouble is something else.
std::string unknown_command(const CLI::App& app, int argc, char** argv, int first);

}  // namespace understudy::emulator::command_line
