// Entering a program line by line: PG, PA, PE, PI, PD and DLP.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "interpreter/slim/program.h"

namespace understudy::interpreter::slim {

/// Which lines from the host are program lines now.
struct Editor {
  enum class Mode : std::uint8_t {
    none,
    lines,     // PG, PA: all, until an empty line (unless those are ignored), EXIT or ESC
    replace,   // PE: the next good one, in place of `line`
    insert,    // PI: the next good one, before `line`
    download,  // DLP: all, until END, EXIT or ESC
  } mode = Mode::none;
  int line = 0;  // from 0

  bool operator==(const Editor&) const = default;
};

constexpr bool is_editing(const Editor& editor) { return editor.mode != Editor::Mode::none; }

/// Carries out one of the six commands. An error changes nothing.
Error begin_edit(Editor& editor, Program& program, const Command& command,
                 const ProgramOptions& options = {});

/// A line that arrives while editing. With an error the line is not stored, and editing goes on: what comes
/// next is meant for the program, too. A line that contains ESC (0x1B) ends the editing and is not stored.
Error enter_line(Editor& editor, Program& program, std::string_view text, const ProgramOptions& options = {});

/// The number that the next line gets, for a prompt.
std::optional<int> next_line_number(const Editor& editor, const Program& program,
                                    const ProgramOptions& options = {});

}  // namespace understudy::interpreter::slim
