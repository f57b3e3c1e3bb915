#include "emulator/command_line/app_words.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/command_line/completion.h"

namespace understudy::emulator::command_line {

CommandWords words_of(const CLI::App& app) {
  CommandWords words{.name = app.get_name(), .help = app.get_description(), .flags = {}, .commands = {}};
  for (const CLI::Option* const option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      words.flags.push_back({name, option->get_description(), option->get_items_expected_max() > 0});
    }
  }
  for (const CLI::App* const command : app.get_subcommands(nullptr)) {
    words.commands.push_back(words_of(*command));
  }
  return words;
}

std::string unknown_command(const CLI::App& app, int argc, char** argv, int first) {
  for (int i = first; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("-")) {
      const CLI::Option* const flag = app.get_option_no_throw(word.substr(0, word.find('=')));
      if (flag == nullptr) return understudy::quoted(word) + " is not a flag here";
      if (flag->get_items_expected_max() > 0 && word.find('=') == std::string::npos) ++i;  // its value
      continue;
    }
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
      names.push_back(command->get_name());
      if (word != command->get_name()) continue;
      return command->get_subcommands(nullptr).empty() ? "" : unknown_command(*command, argc, argv, i + 1);
    }
    return understudy::quoted(word) + " is not a command" + suggestion(word, names);
  }
  return "";
}

}  // namespace understudy::emulator::command_line
