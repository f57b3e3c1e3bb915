// A Simple2-R3 program at work: one line in each slot of 2 ms. What a program is doing is a plain value;
// these functions advance it over the lines, which the device may change in between.
#pragma once

#include <cstdint>

#include "interpreter/simple2/dialect.h"
#include "interpreter/simple2/machine.h"
#include "interpreter/simple2/program.h"

namespace understudy::interpreter::simple2 {

/// 500 lines a second (appendix B). Slots are at even milliseconds.
inline constexpr std::int64_t kSlotMs = 2;
/// "Nothing happens by itself."
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
  move,   // the end of a move that the line at work has started
};

/// The one Loop that counts.
struct LoopState {
  bool counts = false;
  std::uint8_t first_line = 0;
  std::uint8_t loop_line = 0;  // where the Loop itself stands
  std::uint16_t passes = 0;    // begun so far; an endless loop does not count them

  bool operator==(const LoopState&) const = default;
};

struct Execution {
  bool running = false;
  Ending ending = Ending::not_started;  // while not running
  std::uint8_t now_line = 0;            // the line at work, or the last one that was
  std::uint16_t next_line = 0;          // from 256 on: past the last one
  Phase phase = Phase::line;
  std::int64_t delay_until_ms = 0;
  bool waits_for_a = false;  // for a move that it has started, or (by WaitCutShort) has met under way
  bool waits_for_b = false;
  bool waits = false;  // the line at work was tested and holds the program; kept where a choice asks for it
  LoopState loop = {};
  Line held =
      {};  // the line at work as it began to wait, without its flag; NOP, which never waits: it does not

  bool operator==(const Execution&) const = default;
};

/// Runs from a line on, 0 to 255, whatever was going on. It is executed in the next slot.
void start(Execution& execution, std::uint8_t line);
/// Forcibly stops a running program. What it has started goes on.
void stop(Execution& execution);

/// One slot, at an even `now_ms` that is later than the one before. Executes one line at most (two where a
/// choice lets the line behind a wait run in its slot).
void step(Execution& execution, std::int64_t now_ms, const Program& program, const Dialect& dialect,
          Machine& machine);

/// The first slot after `done_ms` in which step() may change anything, provided that program and machine stay
/// as they are; kNoSlot if none. Slots before it may be left out: the execution is then the same as with
/// them.
std::int64_t next_active_slot_ms(const Execution& execution, std::int64_t done_ms, const Program& program,
                                 const Dialect& dialect, const MachineView& machine);

}  // namespace understudy::interpreter::simple2
