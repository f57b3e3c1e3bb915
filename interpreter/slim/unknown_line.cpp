#include "interpreter/slim/unknown_line.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

/// Words of other languages.
struct ForeignWord {
  std::string_view word;
  std::string_view here;
};
constexpr ForeignWord kForeign[] = {{"GOTO", "JP addr"},
                                    {"JMP", "JP addr"},
                                    {"WAIT", "WT tm, WI i or DN"},
                                    {"SLEEP", "WT tm"},
                                    {"DELAY", "WT tm"},
                                    {"PRINT", "OUT #var or OUT \"text\""},
                                    {"IF", "a jump: JZ, JNZ, JE, JNE, JG, JNG, JI or JNI"},
                                    {"GOSUB", "CALL addr"},
                                    {"RETURN", "RET"},
                                    {"END", "RET"},
                                    {"STOP", "TASTOP, or JG0 for a jog"},
                                    {"HOME", "H"},
                                    {"MOVE", "MA x or MR x"}};

/// Returns the word after the label, in upper case and as it appears in the table: "TpMA" for "T1MA".
std::string word_of(std::string_view line) {
  if (line.starts_with('$')) line = without_blanks(line.substr(std::min(line.find(' '), line.size())));
  std::string word = take_word(line);
  const bool is_of_module = word.size() > 2 && word[0] == 'T' && is_digit(word[1]);
  if (is_of_module) word.replace(1, 1, "p");
  return word;
}

/// Returns "SET" for "SET EV".
std::string first_word(std::string_view command) { return std::string(command.substr(0, command.find(' '))); }

}  // namespace

std::string why_not_command(std::string_view line) {
  const std::string word = word_of(line);
  std::string forms;
  std::vector<std::string> known;
  for (const CommandRow& row : kCommands) {
    known.push_back(first_word(row.command));
    if (known.back() == word) forms += (forms.empty() ? "" : ", or ") + std::string(row.syntax);
  }
  if (!forms.empty()) return quoted(line) + " is not a form of " + word + "; expected " + forms;
  for (const ForeignWord& foreign : kForeign) {
    if (foreign.word == word)
      return quoted(line) + " is not a command; expected " + std::string(foreign.here);
  }
  const std::string many = "; expected one of `understudy describe slim commands`";
  const auto nearest = near_word(word, known);
  return quoted(line) + " is not a command" + (nearest ? "; the nearest is '" + *nearest + "'" : many);
}

}  // namespace understudy::interpreter::slim
