// A SLIM program at work: one line a tick of 1 ms, unless chosen otherwise. What a program is doing is a
// plain value; these functions advance it over the lines. Commands that are not program flow go to the
// machine, which may let the program wait.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "interpreter/slim/events.h"
#include "interpreter/slim/machine.h"
#include "interpreter/slim/program.h"

namespace understudy::interpreter::slim {

/// "Nothing happens by itself."
inline constexpr std::int64_t kNever = INT64_MAX;

/// What the manual leaves open about running.
struct FlowOptions {
  ProgramOptions program = {};
  int lines_per_tick = 1;  // a line that waits or fails is the last of its tick
  int lines_every_ms = 1;  // lines run in the milliseconds that this divides
  int window_unit_ms = 1;  // of tm in JTI and JNTI
  int call_depth = 16;
  EventOptions events = {};
  /// GETI or GETR alone on its line: the number is nobody's, or N0's and R0's.
  enum class BareNumber : std::uint8_t { is_dropped, into_n0_or_r0 } bare_number = BareNumber::is_dropped;
  /// Events are of a program that runs; or they call their routine when there is none, too.
  bool events_need_program = true;
  /// WT and JTI that an event has interrupted: they begin again, or their time has gone on.
  enum class InterruptedTimer : std::uint8_t {
    begins_again,
    goes_on
  } interrupted_timer = InterruptedTimer::begins_again;
  /// A line that the machine refuses ends the program, or is passed over.
  enum class FailedLine : std::uint8_t { ends_program, is_passed } failed_line = FailedLine::ends_program;

  bool operator==(const FlowOptions&) const = default;
};

/// Why a program is not running.
enum class Ending : std::uint8_t {
  not_started,
  returned,  // RET at the top
  past_last_line,
  exited,  // EXIT, TASTOP
  failed,  // with `error`
};

/// What holds the line at work.
enum class Hold : std::uint8_t {
  nothing,
  timer,    // WT: until `until_ms`
  input,    // WI, WNI
  window,   // JTI, JNTI: an input, until `until_ms`
  machine,  // the machine said: not yet
  number,   // GETI, GETR: until the host gives one
};

struct Frame {
  int line = 0;  // where to go on
  bool of_event = false;
  Hold hold = Hold::nothing;  // what the event has interrupted
  std::int64_t until_ms = 0;

  bool operator==(const Frame&) const = default;
};

struct Execution {
  bool running = false;
  Ending ending = Ending::not_started;  // while not running
  Error error = Error::none;            // of Ending::failed
  int line = 0;                         // the one at work or the next; after the end, the last one
  Hold hold = Hold::nothing;
  std::int64_t until_ms = 0;
  std::vector<Frame> stack = {};
  Events events = {};       // outlive the program
  bool has_number = false;  // the host has given what GETI or GETR waits for
  double number = 0;

  bool operator==(const Execution&) const = default;
};

/// `G`: runs from an address on (null: line 0), from the next tick. Refused with Error::address: no such
/// line; nothing is changed then.
Error start(Execution& execution, const Program& program, const Operand* address, const FlowOptions& options);
/// Between an event and the RET of its routine.
bool in_event_routine(const Execution& execution);
/// `EXIT`. What the program has started goes on.
void stop(Execution& execution);

/// Whether the program waits for a number, so that the host's next line is one.
constexpr bool wants_number(const Execution& execution) {
  return execution.running && execution.hold == Hold::number && !execution.has_number;
}
/// The host's line while wants_number(). Refused (syntax, range): the program goes on waiting.
Error give_number(Execution& execution, const Program& program, std::string_view text,
                  const Dialect& dialect = {});

/// One tick, at a `now_ms` that is later than the one before. Returns the error of a line that failed.
Error step(Execution& execution, std::int64_t now_ms, const Program& program, const FlowOptions& options,
           Machine& machine);

/// The first tick after `done_ms` in which step() may do anything, provided that the program and the machine
/// stay as they are and the host gives nothing; kNever if none. Ticks before it may be left out. While the
/// machine lets a command wait (Hold::machine), only the machine can tell when it would carry it out.
std::int64_t next_active_ms(const Execution& execution, std::int64_t done_ms, const Program& program,
                            const FlowOptions& options, const Machine& machine);

/// Whether a run of this program can have reached this state: for what is restored from a file.
bool is_sound(const Execution& execution, const Program& program, const FlowOptions& options);

}  // namespace understudy::interpreter::slim
