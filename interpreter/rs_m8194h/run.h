// Running macros: an MP with the macros that it calls, and an ISR that interrupts it. Their state is a plain
// value, which these functions advance line by line. Commands that are not program flow go to the machine.
//
// A tick has a budget of lines. An ISR uses it before an MP does, and a waiting line ends the tick for all
// later lines. If no macro is alive, the rest of the budget belongs to the FIFO.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/options.h"

namespace understudy::interpreter::rs_m8194h {

inline constexpr std::int64_t kNever = INT64_MAX;

/// The state of a FOR with a constant. A FOR with a variable uses the variable as its counter.
struct Loop {
  std::uint16_t line = 0;  // line of FOR
  std::int32_t left = 0;   // remaining passes, including this one

  bool operator==(const Loop&) const = default;
};

struct Level {
  std::uint8_t number = 0;  // number of the macro
  std::uint16_t line = 0;   // the next line, or the line that is waiting for the machine
  std::vector<Loop> loops = {};

  bool operator==(const Level&) const = default;
};

/// What a run is waiting for.
enum class Hold : std::uint8_t {
  nothing,
  begin,    // until `until_ms`
  timer,    // TIMER, until `until_ms`
  axes,     // STOP_WAIT, for the axes in `awaited`
  frnet,    // FRNET_WAIT, for `awaited`, or until `until_ms`
  machine,  // until the machine executes the line
};

struct Run {
  bool is_isr = false;
  std::vector<Level> levels = {};  // the current macro is last; empty if the run is not alive
  Hold hold = Hold::nothing;
  std::int64_t until_ms = 0;
  std::uint32_t awaited = 0;
  bool saw_other_level = false;  // for an FRNET_WAIT that needs an edge: the input had the other level

  bool is_alive() const { return !levels.empty(); }
  bool operator==(const Run&) const = default;
};

/// The value that GET reads and SET_RVAR stores.
struct ReturnRegister {
  std::int32_t value = 0;
  bool is_full = false;

  bool operator==(const ReturnRegister&) const = default;
};

struct Execution {
  Run mp = {};
  std::vector<Run> isrs = {};  // the current one is last; several only if ISRs can be interrupted
  ReturnRegister mp_return = {};
  ReturnRegister isr_return = {};

  bool is_alive() const { return mp.is_alive() || !isrs.empty(); }
  bool operator==(const Execution&) const = default;
};

/// Return the number of the running MP or ISR, or 0 if there is none. Input 24 shows the number of the MP.
int running_mp(const Execution& execution);
int running_isr(const Execution& execution);

/// Returns true if the macro has lines. Returns false if it was never downloaded.
bool has_lines(const MacroName& name, const Machine& machine);
/// Starts an MP whose first line runs at `first_ms`. An MP without lines ends at once. No other MP may be
/// running.
void start_mp(Execution& execution, int number, std::int64_t first_ms, Machine& machine);
/// Starts an ISR immediately, for an MP_ISR_CALL that does not wait. Normally, Machine::take_isr() selects
/// the ISR.
void start_isr(Execution& execution, int number, std::int64_t first_ms, Machine& machine);
/// Executes an MP_TERMINATE that comes from outside.
void terminate(Execution& execution);
/// Abandons a waiting line and continues with the next one, as an "abort command" event requests.
void drop_wait(Execution& execution, Machine& machine);
/// Handles the replacement of a macro: if the old one was running, it ends.
void replaced(Execution& execution, const MacroName& name, Machine& machine);

/// Runs one tick. `now_ms` must be later than in the previous tick. Returns how many lines remain for the
/// FIFO: none while a macro is alive. While paused, no MP continues.
int run_tick(Execution& execution, std::int64_t now_ms, int budget, bool is_paused, const Options& options,
             Machine& machine);
/// Runs one line of the macro that is next. Returns false if no macro is active, or if the macro is waiting.
bool run_line(Execution& execution, std::int64_t now_ms, bool is_paused, const Options& options,
              Machine& machine);

/// Returns the first tick after `done_ms` in which run_tick() may do anything, or kNever. This assumes that
/// the machine has no pending ISR. While a run polls the machine (axes, FRnet, a drive), it is the next tick.
std::int64_t next_active_ms(const Execution& execution, std::int64_t done_ms);

/// Returns true if a run of these macros can have reached this state. Used for states restored from files.
bool is_sound(const Execution& execution, const Machine& machine);

}  // namespace understudy::interpreter::rs_m8194h
