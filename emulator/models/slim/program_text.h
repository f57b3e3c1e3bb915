// Reads the text of a SLIM program, and returns the position of the program.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "emulator/device/program_error.h"
#include "emulator/device/program_parts.h"
#include "emulator/device/user_program.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/program.h"

namespace understudy::emulator::models::slim {

/// The result of reading a program: its valid lines, and the mistakes.
struct ReadProgram {
  lang::Program program{};
  std::vector<int> text_lines{};  // the line numbers of its lines, counted from 1
  std::vector<ProgramMistake> mistakes{};
};
ReadProgram read_program(const Setup& setup, std::string_view text);

/// Returns the program as observers count it.
ProgramPart part_of(const ReadProgram& read);
/// Returns a hash that identifies the program.
std::uint64_t mark_of(const lang::Program& program);

/// Returns true if PZ has paused the program.
bool program_is_held(const State& state, const Setup& setup);
std::vector<ProgramLocation> program_locations(const State& state, const Setup& setup);

}  // namespace understudy::emulator::models::slim
