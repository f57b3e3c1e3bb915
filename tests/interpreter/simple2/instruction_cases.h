// The effect of each instruction, worked out by hand from the manual's list.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/interpreter/simple2/scripted_machine.h"

namespace understudy::interpreter::simple2 {

// The instruction under test is in line 10. Line 40 has flag 7; no line has flag 9.
inline constexpr int kHere = 10;
inline constexpr int kNext = 11;
inline constexpr int kAfterNext = 12;
inline constexpr int kFlag7 = 40;
inline constexpr int kNoSuchFlag = 0;  // "the target is line 0"
inline constexpr int kEnd = -1;

struct InstructionCase {
  std::uint8_t opcode;
  std::uint8_t data1;
  std::uint8_t data2;
  std::function<void(ScriptedMachine&)> before;
  std::string calls;  // the calls to the machine
  int line_after;     // the current line one slot later
};

inline void as_it_is(ScriptedMachine&) {}
inline std::function<void(ScriptedMachine&)> with(int number, std::int32_t value) {
  return [=](ScriptedMachine& machine) { machine.parameters.at(static_cast<std::size_t>(number)) = value; };
}
inline std::function<void(ScriptedMachine&)> with(int number, std::int32_t value, int other,
                                                  std::int32_t other_value) {
  return [=](ScriptedMachine& machine) {
    machine.parameters.at(static_cast<std::size_t>(number)) = value;
    machine.parameters.at(static_cast<std::size_t>(other)) = other_value;
  };
}
inline std::function<void(ScriptedMachine&)> with_inputs(std::uint16_t inputs) {
  return [=](ScriptedMachine& machine) { machine.inputs = inputs; };
}
inline std::function<void(ScriptedMachine&)> with_status(std::uint16_t status) {
  return [=](ScriptedMachine& machine) { machine.status = status; };
}
inline std::function<void(ScriptedMachine&)> with_outputs(std::uint8_t outputs) {
  return [=](ScriptedMachine& machine) { machine.outputs = outputs; };
}
inline void a_moves(ScriptedMachine& machine) { machine.moving_a = true; }
inline void b_moves(ScriptedMachine& machine) { machine.moving_b = true; }

std::vector<InstructionCase> flow_cases();
std::vector<InstructionCase> output_cases();
std::vector<InstructionCase> number_cases();
std::vector<InstructionCase> motion_cases();

}  // namespace understudy::interpreter::simple2
