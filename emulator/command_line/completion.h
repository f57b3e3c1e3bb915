// Generates shell completion scripts for `understudy` from its flags.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// A command with its flags and subcommands.
struct CommandWords {
  struct Flag {
    std::string name;  // "link", without dashes
    std::string help;
    bool takes_value = false;
  };
  std::string name;
  std::string help;
  std::vector<Flag> flags;
  std::vector<CommandWords> commands;
};

/// Returns the script for "bash", "zsh" or "fish", or nothing for other shells. Where no command or flag is
/// expected, the script offers known words (models, faults) or files. After --model it offers the models.
std::optional<std::string> completion_script(const CommandWords& words, const std::string& shell,
                                             ModelList models);

/// Runs `understudy completion SHELL`.
int print_completion(const CommandWords& words, const std::string& shell, ModelList models);

}  // namespace understudy::emulator::command_line
