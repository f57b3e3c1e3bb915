// A Simple2-R3 program as text and back, without loss: any 1024 cells survive disassemble() and assemble().
//
//         Delay_mSec 1500          ; one instruction per line, in the manual's spelling, in any case
// again:  Out DOUT_0 ON            ; a label: any free flag, 1 to 64
//         VAR_DirectAdd MEM3 -5    ; parameters by their aliases in the manual, or by number
//         Wait_IO DIN_3, OFF       ; with or without commas
//         Loop again 3
// JMP7:   Jump JMP9                ; JMP1 to JMP64: exactly this flag @200    NOP                      ; the
// JMP cell itself, 0 to 255, even if it is not a flag
//         Wait_Move_A @0           ; as an operand: a flag that no line can have
//         .at 40                   ; the number of the next line; lines between are NOP
//         .line 0x0A 1 2 7         ; the four cells of a line: CMD DATA1 DATA2 JMP
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/simple2/program.h"

namespace understudy::interpreter::simple2 {

struct ListingError {
  int line = 0;       // of the text, from 1
  int column = 0;     // in bytes, from 1
  std::string field;  // "label", "mnemonic", "operand 2", ".at" or ".line"
  std::string what;
  std::string expected;

  bool operator==(const ListingError&) const = default;
};

/// Returns "4:9: operand 2: 'maybe' is not a level; expected ON or OFF".
std::string to_string(const ListingError& error);

struct Assembly {
  std::optional<Lines> lines;                // empty if there is an error
  std::array<int, kLineCount> text_lines{};  // for each program line, its line in the text, or 0
  std::vector<ListingError> errors;          // the first kMaxMistakes, in the order of the text
};

Assembly assemble(std::string_view text);

/// Writes lines as text. Lines of zeros at the end are omitted. Elsewhere, longer runs of them become `.at`.
std::string disassemble(const Lines& lines);

}  // namespace understudy::interpreter::simple2
