// A running SLIM program, which by default executes one line per tick of 1 ms. Its state is a plain value,
// which these functions advance line by line. Commands that are not program flow go to the machine, which may
// make the program wait.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "interpreter/slim/events.h"
#include "interpreter/slim/machine.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/program.h"

namespace understudy::interpreter::slim {

/// Means that no tick will do anything until a command arrives.
inline constexpr std::int64_t kNever = INT64_MAX;

/// Why a program is not running.
enum class Ending : std::uint8_t {
  not_started,
  returned,  // RET outside any routine
  past_last_line,
  exited,  // EXIT, TASTOP
  failed,  // with `error`
};

/// What the current line is waiting for.
enum class Hold : std::uint8_t {
  nothing,
  timer,    // WT: until `until_ms`
  input,    // WI, WNI
  window,   // JTI, JNTI: an input, until `until_ms`
  machine,  // until the machine executes the command
  number,   // GETI, GETR: until the host sends a number
};

struct Frame {
  int line = 0;  // where the program continues after the routine
  bool of_event = false;
  Hold hold = Hold::nothing;  // what the interrupted line was waiting for
  std::int64_t until_ms = 0;

  bool operator==(const Frame&) const = default;
};

struct Execution {
  bool running = false;
  Ending ending = Ending::not_started;  // while not running
  Error error = Error::none;            // for Ending::failed
  int line = 0;                         // the current or the next line; after the end, the last one
  Hold hold = Hold::nothing;
  std::int64_t until_ms = 0;
  std::vector<Frame> stack = {};
  Events events = {};       // events persist after the program has ended
  bool has_number = false;  // the host has sent the number for GETI or GETR
  double number = 0;

  bool operator==(const Execution&) const = default;
};

/// `G`: starts at an address (null: line 0) in the next tick. If there is no such line, returns
/// Error::address and changes nothing.
Error start(Execution& execution, const Program& program, const Operand* address, const Options& options);
/// Returns true between an event and the RET of its routine.
bool in_event_routine(const Execution& execution);
/// `EXIT`: stops the program. Motion that it has started continues.
void stop(Execution& execution);

/// Returns true if the program is waiting for a number, which must be the host's next line.
constexpr bool wants_number(const Execution& execution) {
  return execution.running && execution.hold == Hold::number && !execution.has_number;
}
/// Handles the host's line while wants_number() is true. If the line is refused (syntax, range), the program
/// continues to wait.
Error give_number(Execution& execution, const Program& program, std::string_view text,
                  const Options& options = {});

/// Runs one tick. `now_ms` must be later than in the previous tick. Returns the error if a line failed.
Error step(Execution& execution, std::int64_t now_ms, const Program& program, const Options& options,
           Machine& machine);

/// Returns the first tick after `done_ms` in which step() may do anything, or kNever. Earlier ticks may be
/// skipped. This assumes that the program and the machine do not change and that the host sends nothing.
/// While the machine makes a command wait (Hold::machine), only the machine can determine when it will
/// execute the command.
std::int64_t next_active_ms(const Execution& execution, std::int64_t done_ms, const Program& program,
                            const Options& options, const Machine& machine);

/// Returns true if a run of this program can have reached this state. Used for states restored from files.
bool is_sound(const Execution& execution, const Program& program, const Options& options);

}  // namespace understudy::interpreter::slim
