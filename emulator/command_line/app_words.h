// The words that `understudy` understands, as its flag parser knows them.
#pragma once

#include <string>

#include "emulator/command_line/completion.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace understudy::emulator::command_line {

/// All commands and flags, with their help.
CommandWords words_of(const CLI::App& app);

/// What is wrong with a command line that it does not understand, in the words of this program: the first
/// word that is no command or flag, with the nearest one, or what `error` is about.
std::string complaint_about(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv);

}  // namespace understudy::emulator::command_line
