// Enters a program line by line (PG, PA, PE, PI, PD and DLP).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/program.h"

namespace understudy::interpreter::slim {

/// How lines from the host become lines of the program.
struct Editor {
  enum class Mode : std::uint8_t {
    none,
    lines,     // PG, PA: all lines, until EXIT, ESC, or an empty line (unless empty lines are ignored)
    replace,   // PE: the next valid line replaces `line`
    insert,    // PI: the next valid line is inserted before `line`
    download,  // DLP: all lines, until END, EXIT or ESC
  } mode = Mode::none;
  int line = 0;  // from 0

  bool operator==(const Editor&) const = default;
};

constexpr bool is_editing(const Editor& editor) { return editor.mode != Editor::Mode::none; }

/// Executes one of the six commands. If it returns an error, it has changed nothing.
Error begin_edit(Editor& editor, Program& program, const Command& command, const Options& options = {});

/// Handles a line that arrives during editing. A line with an error is not stored, and editing continues,
/// because the next line also belongs to the program. A line that contains ESC (0x1B) ends editing and is
/// not stored.
Error enter_line(Editor& editor, Program& program, std::string_view text, const Options& options = {});

/// Returns the number of the next line, for a prompt.
std::optional<int> next_line_number(const Editor& editor, const Program& program,
                                    const Options& options = {});

}  // namespace understudy::interpreter::slim
