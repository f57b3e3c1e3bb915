// Programs as values: the contents of a SUPER-40NC's program memory.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/instructions.h"
#include "interpreter/super_40nc/operand.h"

namespace understudy::interpreter::super_40nc {

struct Instruction {
  Op op = Op::nop;
  std::array<Operand, 4> fields{};

  bool operator==(const Instruction&) const = default;
};

constexpr int steps_of(const Instruction& instruction) { return row_of(instruction.op).steps; }

/// The program of one area, or of one path file.
struct AreaProgram {
  int base = 0;  // the number of its first step in the listing
  std::vector<Instruction> lines = {};

  bool operator==(const AreaProgram&) const = default;
};

struct Program {
  // areas that are missing from a listing are empty
  std::array<std::optional<AreaProgram>, kAreaCount> areas = {};
  std::map<int, AreaProgram> files = {};  // programs for C, by number

  const std::optional<AreaProgram>& area(Area which) const { return areas[index_of(which)]; }
  bool operator==(const Program&) const = default;
};

}  // namespace understudy::interpreter::super_40nc
