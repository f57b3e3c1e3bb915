#include "interpreter/slim/editor.h"

#include <optional>
#include <string>
#include <string_view>

#include "base/complete_table.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/program.h"
#include "interpreter/slim/verbs.h"
#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

constexpr char kEscape = '\x1B';

/// Returns the line number, counted from 0; -1 for line 0 if lines are numbered from 1.
int line_named_by(const Command& command, const Options& options) {
  return static_cast<int>(command.operands.at(0).number) - first_number(options);
}

bool is_end(Editor::Mode mode, std::string_view text, const Options& options) {
  if (text.find(kEscape) != std::string_view::npos) return true;
  const std::string word = in_capitals(without_blanks(text));
  if (word == "EXIT") return true;
  if (mode == Editor::Mode::download) return word == "END";
  return word.empty() && !options.chose(option("edit_end", "exit_or_esc"));
}

/// The arguments of an editing command.
struct EditArguments {
  Editor& editor;
  Program& program;
  const Options& options;
  int line;  // the line in the command
};
using Beginning = Error (*)(const EditArguments&);

constexpr HandlerRow<Verb, Beginning> kBeginningRows[] = {
    {Verb::program_new,
     [](const EditArguments& arguments) {
       arguments.program.clear();
       arguments.editor = {.mode = Editor::Mode::lines};
       return Error::none;
     }},
    {Verb::program_append,
     [](const EditArguments& arguments) {
       arguments.editor = {.mode = Editor::Mode::lines};
       return Error::none;
     }},
    {Verb::download,
     [](const EditArguments& arguments) {
       arguments.program.clear();
       arguments.editor = {.mode = Editor::Mode::download};
       return Error::none;
     }},
    {Verb::program_edit,
     [](const EditArguments& arguments) {
       if (arguments.line < 0 || arguments.line >= arguments.program.size()) return Error::range;
       arguments.editor = {.mode = Editor::Mode::replace, .line = arguments.line};
       return Error::none;
     }},
    {Verb::program_insert,
     [](const EditArguments& arguments) {
       if (arguments.line < 0 || arguments.line > arguments.program.size()) return Error::range;
       if (arguments.program.size() >= arguments.options.number(numbers("program_size")))
         return Error::buffer_full;
       arguments.editor = {.mode = Editor::Mode::insert, .line = arguments.line};
       return Error::none;
     }},
    {Verb::program_delete,
     [](const EditArguments& arguments) {
       return arguments.program.remove(arguments.line, arguments.options);
     }},
};
constexpr CompleteTable<Verb, Beginning> kBeginnings(kEditingVerbs, kBeginningRows);

}  // namespace

Error begin_edit(Editor& editor, Program& program, const Command& command, const Options& options) {
  if (!kBeginnings.has(command.verb)) return Error::syntax;
  // If no number follows, the command does not refer to a line.
  const int line = command.operands.empty() ? 0 : line_named_by(command, options);
  return kBeginnings[command.verb]({editor, program, options, line});
}

Error enter_line(Editor& editor, Program& program, std::string_view text, const Options& options) {
  const Editor at_work = editor;
  if (is_end(at_work.mode, text, options)) {
    editor = {};
    return Error::none;
  }
  // Ignored if empty lines do not end editing, because a file sent by a terminal may contain empty lines.
  if (without_blanks(text).empty()) return Error::none;
  const auto one_line = [&](Error error) {
    const bool is_over = error == Error::none || options.chose(option("refused_line", "ends_editing"));
    if (is_over) editor = {};
    return error;
  };
  switch (at_work.mode) {
    case Editor::Mode::replace: return one_line(program.replace(at_work.line, text, options));
    case Editor::Mode::insert: return one_line(program.insert(at_work.line, text, options));
    case Editor::Mode::download:
    case Editor::Mode::lines: return program.insert(program.size(), text, options);
    case Editor::Mode::none: break;
  }
  return Error::not_allowed;
}

std::optional<int> next_line_number(const Editor& editor, const Program& program, const Options& options) {
  switch (editor.mode) {
    case Editor::Mode::none: return std::nullopt;
    case Editor::Mode::replace:
    case Editor::Mode::insert: return editor.line + first_number(options);
    case Editor::Mode::lines:
    case Editor::Mode::download: break;
  }
  return program.size() + first_number(options);
}

}  // namespace understudy::interpreter::slim
