#include "interpreter/slim/editor.h"

#include <string>

#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

constexpr char kEscape = '\x1B';

/// From 0; -1 for line 0 where lines have numbers from 1.
int line_named_by(const Command& command, const ProgramOptions& options) {
  return static_cast<int>(command.operands.at(0).number) - options.first_number;
}

bool is_end(Editor::Mode mode, std::string_view text, const ProgramOptions& options) {
  if (text.find(kEscape) != std::string_view::npos) return true;
  const std::string word = in_capitals(without_blanks(text));
  if (word == "EXIT") return true;
  if (mode == Editor::Mode::download) return word == "END";
  return word.empty() && options.empty_line == ProgramOptions::EmptyLine::ends_editing;
}

}  // namespace

Error begin_edit(Editor& editor, Program& program, const Command& command, const ProgramOptions& options) {
  // Without a number behind it the command names no line.
  const int line = command.operands.empty() ? 0 : line_named_by(command, options);
  switch (command.verb) {
    case Verb::program_new:
      program.clear();
      editor = {.mode = Editor::Mode::lines};
      return Error::none;
    case Verb::program_append: editor = {.mode = Editor::Mode::lines}; return Error::none;
    case Verb::download:
      program.clear();
      editor = {.mode = Editor::Mode::download};
      return Error::none;
    case Verb::program_edit:
      if (line < 0 || line >= program.size()) return Error::range;
      editor = {.mode = Editor::Mode::replace, .line = line};
      return Error::none;
    case Verb::program_insert:
      if (line < 0 || line > program.size()) return Error::range;
      if (program.size() >= options.capacity) return Error::buffer_full;
      editor = {.mode = Editor::Mode::insert, .line = line};
      return Error::none;
    case Verb::program_delete: return program.remove(line);
    default: return Error::syntax;
  }
}

Error enter_line(Editor& editor, Program& program, std::string_view text, const ProgramOptions& options) {
  const Editor at_work = editor;
  if (is_end(at_work.mode, text, options)) {
    editor = {};
    return Error::none;
  }
  // Ignored where empty lines end nothing; a file sent by a terminal may have them.
  if (without_blanks(text).empty()) return Error::none;
  const auto one_line = [&](Error error) {
    const bool is_over =
        error == Error::none || options.refused_line == ProgramOptions::RefusedLine::ends_pe_and_pi;
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

std::optional<int> next_line_number(const Editor& editor, const Program& program,
                                    const ProgramOptions& options) {
  switch (editor.mode) {
    case Editor::Mode::none: return std::nullopt;
    case Editor::Mode::replace:
    case Editor::Mode::insert: return editor.line + options.first_number;
    default: return program.size() + options.first_number;
  }
}

}  // namespace understudy::interpreter::slim
