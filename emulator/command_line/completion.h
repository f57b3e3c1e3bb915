// Scripts that make shells complete the words of `understudy`, made from its flags.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// A command, what may come after it, and its subcommands.
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

/// For "bash", "zsh" or "fish"; nothing for other shells. Where neither a command nor a flag can come, it
/// offers what is known for that place (models, faults), or files; after --model, the models.
std::optional<std::string> completion_script(const CommandWords& words, const std::string& shell,
                                             ModelList models);

/// `understudy completion SHELL`.
int print_completion(const CommandWords& words, const std::string& shell, ModelList models);

}  // namespace understudy::emulator::command_line
