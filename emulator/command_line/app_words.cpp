#include "emulator/command_line/app_words.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_real.h"
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

namespace {

constexpr std::string_view kListed = " (--help lists them)";

bool is_flag(std::string_view word) { return word.size() > 1 && word.starts_with("-"); }

/// Returns the flag with that name if the command accepts it, including flags of the commands above it.
const CLI::Option* flag_called(const CLI::App& command, const std::string& name) {
  for (const CLI::App* app = &command; app != nullptr; app = app->get_parent()) {
    if (const CLI::Option* const flag = app->get_option_no_throw(name)) return flag;
    if (!app->get_fallthrough()) break;
  }
  return nullptr;
}

std::vector<std::string> flags_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* app = &command; app != nullptr; app = app->get_parent()) {
    for (const CLI::Option* const option : app->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    if (!app->get_fallthrough()) break;
  }
  return names;
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  const auto near = near_word(word, known);
  return near ? "; the nearest is " + quoted(*near) : "";
}

/// The commands and flags on a command line, read in order.
struct Walk {
  const CLI::App* command;  // the most recent command
  std::string diagnostic;   // describes the first unknown word
};

Walk walk(const CLI::App& app, int argc, char** argv) {
  Walk found{.command = &app, .diagnostic = {}};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--") break;
    if (is_flag(word)) {
      const std::string name = word.substr(0, word.find('='));
      const CLI::Option* const flag = flag_called(*found.command, name);
      const bool is_number = parse_real(word).has_value();
      if (flag == nullptr && is_number) continue;
      if (flag == nullptr) {
        found.diagnostic = quoted(name) + " is not a flag here";
        found.diagnostic += std::filesystem::exists(word)
                                ? "; expected ./" + word + " for the file of that name"
                                : nearest(name, flags_of(*found.command)) + std::string(kListed);
        return found;
      }
      const bool has_value = flag->get_items_expected_min() > 0 && word.find('=') == std::string::npos;
      if (has_value) ++i;
      continue;
    }
    const auto commands = found.command->get_subcommands(nullptr);
    if (commands.empty()) continue;  // the word is an operand
    std::vector<std::string> names;
    for (const CLI::App* const command : commands) names.push_back(command->get_name());
    const auto named = std::find(names.begin(), names.end(), word);
    if (named == names.end()) {
      found.diagnostic = quoted(word) + " is not a command" + nearest(word, names) + std::string(kListed);
      return found;
    }
    found.command = commands[static_cast<std::size_t>(named - names.begin())];
  }
  return found;
}

/// Returns a prefix such as "ctl clear: ", or an empty text for the program itself.
std::string path_of(const CLI::App& command) {
  std::string path;
  for (const CLI::App* app = &command; app->get_parent() != nullptr; app = app->get_parent()) {
    path = app->get_name() + (path.empty() ? "" : " ") + path;
  }
  return path.empty() ? "" : path + ": ";
}

/// Returns the first word on the command line that no command or flag accepted.
std::string first_left(const CLI::App& app, int argc, char** argv) {
  const std::vector<std::string> left = app.remaining(true);
  for (int i = 1; i < argc; ++i) {
    if (std::find(left.begin(), left.end(), argv[i]) != left.end()) return argv[i];
  }
  return left.empty() ? "" : left.front();
}

/// Returns the description of the option's expected value from its help, for use within a sentence.
std::string expected_of(const CLI::App& command, const std::string& option) {
  const CLI::Option* const found = command.get_option_no_throw(option);
  std::string help = found == nullptr ? "" : found->get_description();
  if (help.empty()) return "one";
  const bool is_word = help.size() > 1 && std::islower(static_cast<unsigned char>(help[1])) != 0;
  if (is_word || help[1] == ' ')
    help[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(help[0])));
  return help;
}

/// Returns the text before `end`, such as "--page" from "--page: ...".
std::string before(const std::string& text, std::string_view end) { return text.substr(0, text.find(end)); }

}  // namespace

std::string diagnostic_about(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const Walk found = walk(app, argc, argv);
  if (!found.diagnostic.empty()) return found.diagnostic;
  const std::string message = error.what();
  const std::string& kind = error.get_name();
  const std::string where = path_of(*found.command);
  if (kind == "RequiredError") {
    const std::string what = before(message, " is required");
    if (what == "A subcommand") return where + "expected a command" + std::string(kListed);
    return where + what + " is missing; expected " + expected_of(*found.command, what);
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)  // the error's name is the command's name
    return where + quoted(first_left(app, argc, argv)) + " is one argument too many; expected nothing more";
  if (kind == "ExcludesError") {
    const std::string first = before(message, " excludes ");
    return where + first + " and " + message.substr(first.size() + std::string_view(" excludes ").size()) +
           " cannot be combined; expected one of the two";
  }
  if (kind == "ArgumentMismatch") {
    if (message.find("At Most") != std::string::npos)
      return before(message, ":") + ": is given twice; expected it only once";
    if (message.find("flag override") == std::string::npos)
      return before(message, ":") + ": has no value; expected one";
    return before(message, " was given") + ": has a value; expected none";
  }
  if (kind == "ConversionError") {
    constexpr std::string_view kBegin = "Could not convert: ";
    if (!message.starts_with(kBegin)) return before(message, ":") + ": has a value; expected none";
    const std::string name = before(message.substr(kBegin.size()), " = ");
    const CLI::Option* const option = flag_called(*found.command, name);
    if (option != nullptr && option->get_items_expected_max() == 0)
      return name + ": has a value; expected none";
    const bool is_real = option != nullptr && option->get_type_name() == "FLOAT";
    return name + ": " + quoted(message.substr(kBegin.size() + name.size() + 3)) +
           (is_real ? " is not a number; expected a number"
                    : " is not a whole number, or is too large; expected a whole number");
  }
  return message;
}

}  // namespace understudy::emulator::command_line
