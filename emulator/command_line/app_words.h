// Collects the words of the command line of `understudy` from its parser.
#pragma once

#include <string>

#include "emulator/command_line/completion.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace understudy::emulator::command_line {

/// Returns all commands and flags with their help texts.
CommandWords words_of(const CLI::App& app);

/// Returns an error text for a command line: the first unknown command or flag with the nearest known one, or
/// else the subject of `error`.
std::string diagnostic_about(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv);

}  // namespace understudy::emulator::command_line
