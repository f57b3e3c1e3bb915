// Macros at work: an MP with the ones it calls, and an ISR that interrupts it. What they are doing is a plain
// value; these functions advance it over the lines. Commands that are not program flow go to the machine.
//
// A tick has a budget of lines, which an ISR spends before an MP does; a line that waits ends the tick for
// all behind it. What is left while no macro is alive belongs to the FIFO.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/macro.h"

namespace understudy::interpreter::rs_m8194h {

inline constexpr std::int64_t kNever = INT64_MAX;

/// What the manual leaves open about running.
struct RunOptions {
  CommandOptions command = {};
  /// An MP goes on while an ISR waits, or is suspended.
  bool mp_runs_beside_isr = false;
  /// An ISR interrupts another one, or comes after it.
  bool isr_interrupts_isr = false;
  /// A line of an ISR that would wait is passed over.
  bool isr_never_waits = false;
  /// GET and SET_RVAR of MP and ISR use one register, or one each.
  bool one_return_register = false;
  /// A value can be stored once, the next SET_RVAR is an execution error; or it stays until the next GET.
  bool return_value_is_used_up = false;
  /// A negative time from a variable is 0, or an execution error.
  bool negative_time_is_error = false;
  /// The seven levels are those of calls inside the macro that was started, or it is the first of them.
  bool calls_alone_have_levels = false;
  /// The eighth level is not called; its caller goes on behind the line, or ends.
  bool call_too_deep_ends_macro = false;
  /// A call of a macro without lines is an execution error, or over at once.
  bool missing_macro_is_error = false;
  /// EXIT_FOR takes 1 from the variable of its FOR, as the end of a pass does.
  bool exit_for_counts = false;
  /// FRNET_WAIT waits for a change to its level, or takes it if it is there already.
  bool frnet_wait_needs_edge = false;
  /// FRNET_WAIT whose time is over is an execution error.
  bool frnet_wait_timeout_is_error = false;
  /// The value of GET_DI_SIGNAL_ALL is not for SET_RVAR.
  bool raw_signals_are_not_returned = false;
  /// Results of VAR_CALCULATE end at the ends of 32 bits, or come round.
  bool results_end_at_32_bits = false;
  /// A division by 0 leaves the result as it is, or makes it 0.
  bool division_by_zero_keeps = false;
  /// FOR with a count below 1 runs its block once.
  bool for_runs_once_at_least = false;

  bool operator==(const RunOptions&) const = default;
};

/// A FOR with a constant. One with a variable counts in it.
struct Loop {
  std::uint16_t line = 0;  // of FOR
  std::int32_t left = 0;   // this pass and those behind it

  bool operator==(const Loop&) const = default;
};

struct Level {
  std::uint8_t number = 0;  // of the macro
  std::uint16_t line = 0;   // the next one, or the one that the machine lets wait
  std::vector<Loop> loops = {};

  bool operator==(const Level&) const = default;
};

/// What holds a run.
enum class Hold : std::uint8_t {
  nothing,
  begin,    // until `until_ms`
  timer,    // TIMER, until `until_ms`
  axes,     // STOP_WAIT, for the mask `awaited`
  frnet,    // FRNET_WAIT, for `awaited`, or until `until_ms`
  machine,  // the machine said: not yet
};

struct Run {
  bool is_isr = false;
  std::vector<Level> levels = {};  // the one at work last; none: it does not run
  Hold hold = Hold::nothing;
  std::int64_t until_ms = 0;
  std::uint32_t awaited = 0;
  bool saw_other_level = false;  // FRNET_WAIT that needs an edge

  bool is_alive() const { return !levels.empty(); }
  bool operator==(const Run&) const = default;
};

/// What GET has read and SET_RVAR stores.
struct ReturnRegister {
  std::int32_t value = 0;
  bool is_full = false;

  bool operator==(const ReturnRegister&) const = default;
};

struct Execution {
  Run mp = {};
  std::vector<Run> isrs = {};  // the one at work last; more than one only where ISRs interrupt each other
  ReturnRegister mp_return = {};
  ReturnRegister isr_return = {};

  bool is_alive() const { return mp.is_alive() || !isrs.empty(); }
  bool operator==(const Execution&) const = default;
};

/// The number of the MP, or of the ISR, that is at work; 0: none. Input 24 shows the MP's.
int running_mp(const Execution& execution);
int running_isr(const Execution& execution);

/// False for what was never downloaded as well.
bool has_lines(const MacroName& name, const Machine& machine);
/// Its first line runs at `first_ms`. What has no lines ends at once. None may run.
void start_mp(Execution& execution, int number, std::int64_t first_ms, Machine& machine);
/// Ahead of its turn, for MP_ISR_CALL where it does not wait: Machine::take_isr() is the usual way.
void start_isr(Execution& execution, int number, std::int64_t first_ms, Machine& machine);
/// MP_TERMINATE from outside.
void terminate(Execution& execution);
/// A waiting line is given up, and the next one runs: what an "abort command" event does.
void drop_wait(Execution& execution, Machine& machine);
/// A new macro has taken the place of one: where that one ran, it ends.
void replaced(Execution& execution, const MacroName& name, Machine& machine);

/// One tick, at a `now_ms` later than the one before. Returns how many lines are left for the FIFO: none
/// while a macro is alive. While paused, no MP goes on.
int run_tick(Execution& execution, std::int64_t now_ms, int budget, bool is_paused, const RunOptions& options,
             Machine& machine);
/// One line of the macro whose turn it is. False: none is alive, or it waits.
bool run_line(Execution& execution, std::int64_t now_ms, bool is_paused, const RunOptions& options,
              Machine& machine);

/// The first tick after `done_ms` in which run_tick() may do anything, provided that the machine has no ISR
/// for it; kNever if none. While it asks the machine (axes, FRnet, a drive), that is the next one.
std::int64_t next_active_ms(const Execution& execution, std::int64_t done_ms);

/// Whether a run of these macros can have reached this state: for what is restored from a file.
bool is_sound(const Execution& execution, const Machine& machine);

}  // namespace understudy::interpreter::rs_m8194h
