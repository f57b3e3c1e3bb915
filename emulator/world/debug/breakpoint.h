// Breakpoints and stops of a debugger (debugger.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "base/simulated_time.h"

namespace understudy::emulator::world {

/// The message is a line with what cannot be watched and what was expected.
struct BreakpointError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct BreakpointSetup {
  enum class Kind : std::uint8_t {
    line,         // the first instruction of `line` begins
    instruction,  // instruction number `line` of the part `program` begins, counted from 0
    condition,    // `condition` becomes true
    write,        // the register `name` is written
    event,        // an event of kind `name` happens
  } kind = Kind::line;
  std::size_t device = 0;  // for a line or an instruction
  std::string program{};   // for an instruction: "PLC", "MP21"; empty if there is only one
  int line = 0;            // the source line, from 1
  std::string name{};
  std::string by{};         // for a write: host, control, page or device; empty: any author
  std::string condition{};  // for all other kinds: a hit counts only while this is true; may be empty
  std::uint64_t nth = 1;    // it takes effect from this hit on
  std::string log{};  // if not empty, the breakpoint prints this and never stops; {expressions} are replaced
};

struct Breakpoint {
  int number = 0;
  BreakpointSetup setup{};
  int line = 0;  // the source line of the instruction; 0 if it is not in the current program
  std::uint64_t hits = 0;
};

struct InstructionPlace {
  std::string program{};  // the part; empty if there is only one
  int number = 0;         // within the part, from 0
  int line = 0;           // the source line, from 1
  std::string text{};
};

struct DebugStop {
  enum class Reason : std::uint8_t { breakpoint, step, program, power } reason = Reason::breakpoint;
  SimTime time{0};
  int breakpoint = 0;    // the breakpoint's number
  std::string text{};    // for people
  std::string device{};  // set for an instruction; otherwise empty
  InstructionPlace place{};
  std::size_t depth = 0;  // the number of callers at the stop
};

/// Where a step ends.
enum class StepKind : std::uint8_t {
  instruction,  // until the next instruction
  line,         // until the next instruction on another line
  over,         // until the next instruction outside routines called from here
  out,          // until the next instruction after this routine's end
  stand,        // until no axis of the device is moving
};

}  // namespace understudy::emulator::world
