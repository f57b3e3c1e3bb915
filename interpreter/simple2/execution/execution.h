// A running Simple2-R3 program, which executes one line in each slot of 2 ms. Its state is a plain value.
// These functions advance it line by line, and the device may change the lines in between.
#pragma once

#include <cstdint>

#include "interpreter/simple2/dialect.h"
#include "interpreter/simple2/machine.h"
#include "interpreter/simple2/program.h"

namespace understudy::interpreter::simple2 {

/// 500 lines per second (appendix B). Slots are at even milliseconds.
inline constexpr std::int64_t kSlotMs = 2;
/// Means that no slot will do anything until a command arrives.
inline constexpr std::int64_t kNoSlot = INT64_MAX;

/// Why a program is not running.
enum class Ending : std::uint8_t {
  not_started,
  end_instruction,
  past_last_line,
  nested_loop,  // rule 2 of Loop
  unknown_command,
  undefined_operand,
  stopped,  // from outside
  wait_cut_short,
};

/// What the next slot begins with.
enum class Phase : std::uint8_t {
  line,   // a line
  delay,  // the end of a delay
  move,   // the end of a move that the current line has started
};

/// The active Loop; there is at most one.
struct LoopState {
  bool counts = false;
  std::uint8_t first_line = 0;
  std::uint8_t loop_line = 0;  // the line that contains the Loop
  std::uint16_t passes = 0;    // passes begun so far; an endless loop does not count them

  bool operator==(const LoopState&) const = default;
};

struct Execution {
  bool running = false;
  Ending ending = Ending::not_started;  // while not running
  std::uint8_t now_line = 0;            // the current line, or the last one that ran
  std::uint16_t next_line = 0;          // 256 or more: past the last line
  Phase phase = Phase::line;
  std::int64_t delay_until_ms = 0;
  bool waits_for_a = false;  // for a move that the line started or, with WaitCutShort, found running
  bool waits_for_b = false;
  bool waits = false;  // the current line was tested and is waiting; set only if a choice needs it
  LoopState loop = {};
  // The current line as it was when it began to wait, without its flag. If no line is waiting, it is NOP,
  // which never waits.
  Line held = {};

  bool operator==(const Execution&) const = default;
};

/// Starts a program at line 0 to 255, even if a program is running. The line runs in the next slot.
void start(Execution& execution, std::uint8_t line);
/// Stops a running program at once. Motion that it has started continues.
void stop(Execution& execution);

/// Runs one slot. `now_ms` must be even, and later than in the previous slot. Executes at most one line, or
/// two if a choice lets the line after a wait run in the same slot.
void step(Execution& execution, std::int64_t now_ms, const Program& program, const Dialect& dialect,
          Machine& machine);

/// Returns the first slot after `done_ms` in which step() may change anything, or kNoSlot. This assumes that
/// the program and the machine do not change. Earlier slots may be skipped without changing the execution.
std::int64_t next_active_slot_ms(const Execution& execution, std::int64_t done_ms, const Program& program,
                                 const Dialect& dialect, const MachineView& machine);

}  // namespace understudy::interpreter::simple2
