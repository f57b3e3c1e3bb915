#include "emulator/command_line/completion.h"

#include <cstdio>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/device/model.h"
#include "emulator/world/faults/kinds.h"

namespace understudy::emulator::command_line {

namespace {

/// Calls `act` for each command with its path, such as "understudy ctl get".
void for_each(const CommandWords& command, const std::string& path,
              const std::function<void(const std::string& path, const CommandWords& command)>& act) {
  act(path, command);
  for (const CommandWords& below : command.commands) for_each(below, path + " " + below.name, act);
}

std::string names_of(ModelList models) {
  std::string names;
  for (const ListedModel& model : models) {
    names += (names.empty() ? "" : " ") + std::string(model.name());
  }
  return names;
}

std::string fault_names() {
  std::string names;
  for (const world::FaultKindRow& row : world::fault_kinds()) {
    names += (names.empty() ? "" : " ") + std::string(row.name);
  }
  return names;
}

/// Lists the words that a command accepts as one of its operands.
struct OperandWords {
  std::string path;
  int place = 0;  // the operand's position, starting at 0
  std::string words;
};
std::vector<OperandWords> operand_words(ModelList models) {
  return {{"understudy describe", 0, names_of(models)},
          {"understudy describe", 1, "registers parameters instructions commands choices ports blocks thing"},
          {"understudy schema", 0, "bench scenario model"},
          {"understudy completion", 0, "bash zsh fish"},
          {"understudy ctl inject", 0, fault_names()},
          {"understudy ctl clear", 0, "all"},
          {"understudy ctl power", 1, "on off cycle"},
          {"understudy ctl get", 0, "time"},
          {"understudy ctl watch", 0, "time"}};
}

/// Returns the flags whose value is a separate word: "--bench", "--control", ...
std::vector<std::string> flags_with_value(const CommandWords& words) {
  std::set<std::string> flags;
  for_each(words, words.name, [&](const std::string&, const CommandWords& command) {
    for (const CommandWords::Flag& flag : command.flags) {
      if (flag.takes_value) flags.insert("--" + flag.name);
    }
  });
  return {flags.begin(), flags.end()};
}

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

/// Encloses a text in single quotes, which all three shells accept.
std::string in_quotes(const std::string& text, std::string_view quote_in_quotes) {
  std::string quoted_text = "'";
  for (const char c : text) c == '\'' ? quoted_text += quote_in_quotes : quoted_text += c;
  return quoted_text + "'";
}

/// Returns all paths except the program's own name, as the patterns of a `case`.
std::string patterns_of(const CommandWords& words, const std::string& separator) {
  std::string patterns;
  for_each(words, words.name, [&](const std::string& path, const CommandWords&) {
    if (path != words.name) patterns += (patterns.empty() ? "" : separator) + ("'" + path + "'");
  });
  return patterns;
}

std::string bash_script(const CommandWords& words, ModelList models) {
  std::string cases;
  for_each(words, words.name, [&](const std::string& path, const CommandWords& command) {
    std::string commands;
    std::string flags;
    for (const CommandWords& below : command.commands) commands += (commands.empty() ? "" : " ") + below.name;
    for (const CommandWords::Flag& flag : command.flags) flags += (flags.empty() ? "--" : " --") + flag.name;
    cases += "    '" + path + "') commands='" + commands + "' flags='" + flags + "' ;;\n";
  });
  std::string operands;
  for (const OperandWords& row : operand_words(models)) {
    operands += "    '" + row.path + " " + std::to_string(row.place) + "') operands='" + row.words + "' ;;\n";
  }
  return "# bash completion for understudy, made by `understudy completion bash`\n"
         "_understudy() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
         "  local commands= flags= operands= path=understudy place=0 i\n"
         "  COMPREPLY=()\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    [[ ${COMP_WORDS[i]} == -- ]] && return\n"
         "    case \"$path ${COMP_WORDS[i]}\" in\n"
         "      " +
         patterns_of(words, " | ") +
         ") path=\"$path ${COMP_WORDS[i]}\"; continue ;;\n"
         "    esac\n"
         "    case ${COMP_WORDS[i]} in\n"
         "      " +
         joined(flags_with_value(words), " | ") +
         ") ((++i)) ;;\n"
         "      -*) ;;\n"
         "      *) ((++place)) ;;\n"
         "    esac\n"
         "  done\n"
         "  case $path in\n" +
         cases +
         "  esac\n"
         "  case \"$path $place\" in\n" +
         operands +
         "  esac\n"
         "  if [[ $before == --model ]]; then\n"
         "    COMPREPLY=($(compgen -W '" +
         names_of(models) +
         "' -- \"$word\"))\n"
         "  elif [[ $word == -* ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$flags\" -- \"$word\"))\n"
         "  elif [[ -n $commands ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$commands\" -- \"$word\"))\n"
         "  elif [[ -n $operands ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$operands\" -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -o default -F _understudy understudy\n";
}

std::string zsh_script(const CommandWords& words, ModelList models) {
  const auto entry = [](const std::string& name, const std::string& help) {
    std::string text = name + ":";
    for (const char c : help) text += c == ':' ? std::string("\\:") : std::string(1, c);
    return " " + in_quotes(text, "'\\''");
  };
  std::string cases;
  for_each(words, words.name, [&](const std::string& path, const CommandWords& command) {
    cases += "    '" + path + "')\n      commands=(";
    for (const CommandWords& below : command.commands) cases += entry(below.name, below.help);
    cases += ")\n      flags=(";
    for (const CommandWords::Flag& flag : command.flags) cases += entry("--" + flag.name, flag.help);
    cases += ") ;;\n";
  });
  std::string operands;
  for (const OperandWords& row : operand_words(models)) {
    operands += "    '" + row.path + " " + std::to_string(row.place) + "') operands=(" + row.words + ") ;;\n";
  }
  return "#compdef understudy\n"
         "# zsh completion for understudy, made by `understudy completion zsh`\n"
         "_understudy() {\n"
         "  local path_=understudy place=0 i\n"
         "  local -a commands flags models operands\n"
         "  for ((i = 2; i < CURRENT; ++i)); do\n"
         "    if [[ ${words[i]} == -- ]]; then _files; return; fi\n"
         "    case \"$path_ ${words[i]}\" in\n"
         "      (" +
         patterns_of(words, "|") +
         ") path_=\"$path_ ${words[i]}\"; continue ;;\n"
         "    esac\n"
         "    case ${words[i]} in\n"
         "      (" +
         joined(flags_with_value(words), "|") +
         ") (( ++i )) ;;\n"
         "      (-*) ;;\n"
         "      (*) (( ++place )) ;;\n"
         "    esac\n"
         "  done\n"
         "  case $path_ in\n" +
         cases +
         "  esac\n"
         "  case \"$path_ $place\" in\n" +
         operands +
         "  esac\n"
         "  models=(" +
         names_of(models) +
         ")\n"
         "  if [[ ${words[CURRENT-1]} == --model ]]; then\n"
         "    compadd -a models\n"
         "  elif [[ ${words[CURRENT]} == -* ]]; then\n"
         "    _describe -o flag flags\n"
         "  elif (( $#commands )); then\n"
         "    _describe command commands\n"
         "  elif (( $#operands )); then\n"
         "    compadd -a operands\n"
         "  else\n"
         "    _files\n"
         "  fi\n"
         "}\n"
         "if [[ $funcstack[1] == _understudy ]]; then _understudy \"$@\"; else compdef _understudy "
         "understudy; fi\n";
}

std::string fish_script(const CommandWords& words, ModelList models) {
  std::string script =
      "# fish completion for understudy, made by `understudy completion fish`\n"
      "function __understudy_path\n"
      "  set -l path understudy\n"
      "  for word in (commandline -opc)[2..-1]\n"
      "    switch \"$path $word\"\n"
      "      case " +
      patterns_of(words, " ") +
      "\n"
      "        set path \"$path $word\"\n"
      "    end\n"
      "  end\n"
      "  echo $path\n"
      "end\n"
      "function __understudy_place\n"
      "  set -l path understudy\n"
      "  set -l place 0\n"
      "  set -l is_value 0\n"
      "  for word in (commandline -opc)[2..-1]\n"
      "    if test $is_value = 1\n"
      "      set is_value 0\n"
      "      continue\n"
      "    end\n"
      "    switch \"$path $word\"\n"
      "      case " +
      patterns_of(words, " ") +
      "\n"
      "        set path \"$path $word\"\n"
      "        continue\n"
      "    end\n"
      "    switch $word\n"
      "      case " +
      joined(flags_with_value(words), " ") +
      "\n"
      "        set is_value 1\n"
      "      case '-*'\n"
      "      case '*'\n"
      "        set place (math $place + 1)\n"
      "    end\n"
      "  end\n"
      "  echo $path $place\n"
      "end\n";
  for (const OperandWords& row : operand_words(models)) {
    script += "complete -c understudy -n 'test (__understudy_place) = \"" + row.path + " " +
              std::to_string(row.place) + "\"' -f -a '" + row.words + "'\n";
  }
  for_each(words, words.name, [&](const std::string& path, const CommandWords& command) {
    const std::string here =
        "complete -c understudy -n " + in_quotes("test (__understudy_path) = \"" + path + "\"", "\\'");
    for (const CommandWords& below : command.commands) {
      script += here + " -f -a " + below.name + " -d " + in_quotes(below.help, "\\'") + "\n";
    }
    for (const CommandWords::Flag& flag : command.flags) {
      const std::string value = flag.name == "model" ? " -x -a '" + names_of(models) + "'"
                                : flag.takes_value   ? " -r"
                                                     : "";
      script += here + " -l " + flag.name + value + " -d " + in_quotes(flag.help, "\\'") + "\n";
    }
  });
  return script;
}

}  // namespace

std::optional<std::string> completion_script(const CommandWords& words, const std::string& shell,
                                             ModelList models) {
  if (shell == "bash") return bash_script(words, models);
  if (shell == "zsh") return zsh_script(words, models);
  if (shell == "fish") return fish_script(words, models);
  return std::nullopt;
}

int print_completion(const CommandWords& words, const std::string& shell, ModelList models) {
  const auto script = completion_script(words, shell, models);
  if (!script) {
    throw UsageError("completion: " + understudy::quoted(shell) +
                     " is not a known shell; expected bash, zsh or fish");
  }
  std::fputs(script->c_str(), stdout);
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
