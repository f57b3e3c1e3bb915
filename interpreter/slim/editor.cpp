#include "interpreter/slim/editor.h"

#include <string>

#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

constexpr char kEscape = '\x1B';

int line_named_by(const Command& command) { return static_cast<int>(command.operands.at(0).number); }

bool is_end(Editor::Mode mode, std::string_view text) {
  if (text.find(kEscape) != std::string_view::npos) return true;
  const std::string word = in_capitals(without_blanks(text));
  if (word == "EXIT") return true;
  return mode == Editor::Mode::download ? word == "END" : word.empty();
}

}  // namespace

Error begin_edit(Editor& editor, Program& program, const Command& command) {
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
      if (line_named_by(command) >= program.size()) return Error::range;
      editor = {.mode = Editor::Mode::replace, .line = line_named_by(command)};
      return Error::none;
    case Verb::program_insert:
      if (line_named_by(command) > program.size()) return Error::range;
      if (program.size() >= kProgramCapacity) return Error::buffer_full;
      editor = {.mode = Editor::Mode::insert, .line = line_named_by(command)};
      return Error::none;
    case Verb::program_delete: return program.remove(line_named_by(command));
    default: return Error::syntax;
  }
}

Error enter_line(Editor& editor, Program& program, std::string_view text, const Dialect& dialect) {
  const Editor at_work = editor;
  if (is_end(at_work.mode, text)) {
    editor = {};
    return Error::none;
  }
  switch (at_work.mode) {
    case Editor::Mode::replace: editor = {}; return program.replace(at_work.line, text, dialect);
    case Editor::Mode::insert: editor = {}; return program.insert(at_work.line, text, dialect);
    case Editor::Mode::download:
      // A file sent by a terminal may have empty lines.
      if (without_blanks(text).empty()) return Error::none;
      return program.insert(program.size(), text, dialect);
    case Editor::Mode::lines: return program.insert(program.size(), text, dialect);
    case Editor::Mode::none: break;
  }
  return Error::not_allowed;
}

std::optional<int> next_line_number(const Editor& editor, const Program& program) {
  switch (editor.mode) {
    case Editor::Mode::none: return std::nullopt;
    case Editor::Mode::replace:
    case Editor::Mode::insert: return editor.line;
    default: return program.size();
  }
}

}  // namespace understudy::interpreter::slim
