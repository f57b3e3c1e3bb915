#include "interpreter/rs_m8194h/run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/line_run.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::interpreter::rs_m8194h {
namespace {

bool is_at_end(const Run& run, const Machine& machine) {
  const Level& level = run.levels.back();
  const Macro* macro = machine.macro(name_of_level(run, level));
  return macro == nullptr || level.line >= macro->size();
}

/// Leaves the levels whose macro has no more lines. A wait in the last line ends first.
void leave_ended(Run& run, const Machine& machine) {
  while (run.is_alive() && run.hold == Hold::nothing && is_at_end(run, machine)) run.levels.pop_back();
}

/// Removes runs that have ended.
void settle(Execution& execution, Machine& machine) {
  for (Run& isr : execution.isrs) leave_ended(isr, machine);
  std::erase_if(execution.isrs, [](const Run& isr) { return !isr.is_alive(); });
  if (!execution.mp.is_alive()) return;
  leave_ended(execution.mp, machine);
  if (execution.mp.is_alive()) return;
  execution.mp = {};
  machine.mp_ended();
}

/// Checks the waits, even while an ISR runs.
void watch(Execution& execution, std::int64_t now_ms, const Options& options, Machine& machine) {
  const auto look = [&](Run& run) {
    const bool is_watched = run.hold != Hold::nothing && run.hold != Hold::machine;
    if (is_watched && is_over(run, now_ms, options, machine)) hold(run, Hold::nothing);
  };
  look(execution.mp);
  for (Run& isr : execution.isrs) look(isr);
  settle(execution, machine);
}

/// Returns false if the run is waiting.
bool run_line_of(Execution& execution, Run& run, std::int64_t now_ms, const Options& options,
                 Machine& machine) {
  if (!is_over(run, now_ms, options, machine)) return false;
  const Ran ran = run_next_line(execution, run, now_ms, options, machine);
  if (ran == Ran::on) settle(execution, machine);
  return ran != Ran::waits;
}

void take_isrs(Execution& execution, std::int64_t now_ms, const Options& options, Machine& machine) {
  while (execution.isrs.empty() || options.chose(option("isr_nesting", "nested"))) {
    const int number = machine.take_isr();
    if (number == 0) return;
    if (!options.chose(option("return_registers", "one_for_both"))) execution.isr_return = {};
    start_isr(execution, number, now_ms, machine);
  }
}

Run started(bool is_isr, int number, std::int64_t first_ms) {
  Run run{.is_isr = is_isr};
  run.levels.push_back({.number = static_cast<std::uint8_t>(number)});
  hold(run, Hold::begin, first_ms);
  return run;
}

/// Returns true if the open loops of a level are the loops around its next line.
bool is_sound_level(const Run& run, const Level& level, const Machine& machine) {
  const MacroName name = name_of_level(run, level);
  const Macro* macro = exists(name) ? machine.macro(name) : nullptr;
  if (macro == nullptr || level.line > macro->size()) return false;
  Blocks blocks = blocks_behind({macro->lines.begin(), macro->lines.begin() + level.line});
  std::erase_if(blocks, [](const Block& block) { return block.opener != Verb::for_; });
  return std::ranges::equal(blocks, level.loops, {}, &Block::line, &Loop::line) &&
         std::ranges::all_of(level.loops, [](const Loop& loop) { return loop.left > 0; });
}

bool is_sound_hold(const Run& run, const Machine& machine) {
  if (!run.is_alive()) return run.hold == Hold::nothing;
  const bool is_in_last_line = run.hold == Hold::timer || run.hold == Hold::axes || run.hold == Hold::frnet;
  if (!is_in_last_line && is_at_end(run, machine)) return false;
  if (run.hold == Hold::axes) return run.awaited <= kAllAxes;
  return run.hold != Hold::frnet || is_frnet_input(run.awaited);
}

bool is_sound_run(const Run& run, const Machine& machine) {
  const std::size_t deepest = run.is_isr ? 1 : static_cast<std::size_t>(kDeepestCall);
  return run.levels.size() <= deepest && is_sound_hold(run, machine) &&
         std::ranges::all_of(run.levels,
                             [&](const Level& level) { return is_sound_level(run, level, machine); });
}

}  // namespace

bool has_lines(const MacroName& name, const Machine& machine) {
  const Macro* macro = machine.macro(name);
  return macro != nullptr && macro->size() != 0;
}

int running_mp(const Execution& execution) {
  return execution.mp.is_alive() ? execution.mp.levels.back().number : 0;
}

int running_isr(const Execution& execution) {
  return execution.isrs.empty() ? 0 : execution.isrs.back().levels.back().number;
}

void start_mp(Execution& execution, int number, std::int64_t first_ms, Machine& machine) {
  if (!has_lines({false, number}, machine)) return machine.mp_ended();
  execution.mp = started(false, number, first_ms);
  execution.mp_return = {};
}

void start_isr(Execution& execution, int number, std::int64_t first_ms, Machine& machine) {
  if (has_lines({true, number}, machine)) execution.isrs.push_back(started(true, number, first_ms));
}

void terminate(Execution& execution) {
  execution.mp = {};
  execution.isrs.clear();
}

void drop_wait(Execution& execution, Machine& machine) {
  const auto drop = [](Run& run) {
    if (run.hold == Hold::begin) return;
    if (run.hold == Hold::machine) ++run.levels.back().line;
    hold(run, Hold::nothing);
  };
  drop(execution.mp);
  for (Run& isr : execution.isrs) drop(isr);
  settle(execution, machine);
}

void replaced(Execution& execution, const MacroName& name, Machine& machine) {
  const auto drop = [&name](Run& run) {
    const auto old = std::ranges::find_if(
        run.levels, [&](const Level& level) { return name_of_level(run, level) == name; });
    if (old == run.levels.end()) return;
    run.levels.erase(old, run.levels.end());
    hold(run, Hold::nothing);
  };
  const bool ran = execution.mp.is_alive();
  drop(execution.mp);
  for (Run& isr : execution.isrs) drop(isr);
  if (ran && !execution.mp.is_alive()) {
    execution.mp = {};
    machine.mp_ended();
  }
  settle(execution, machine);
}

bool run_line(Execution& execution, std::int64_t now_ms, bool is_paused, const Options& options,
              Machine& machine) {
  take_isrs(execution, now_ms, options, machine);
  if (!execution.isrs.empty()) {
    if (run_line_of(execution, execution.isrs.back(), now_ms, options, machine)) return true;
    if (!options.chose(option("mp_during_isr", "goes_on_while_it_waits"))) return false;
  }
  if (!execution.mp.is_alive() || is_paused) return false;
  return run_line_of(execution, execution.mp, now_ms, options, machine);
}

int run_tick(Execution& execution, std::int64_t now_ms, int budget, bool is_paused, const Options& options,
             Machine& machine) {
  watch(execution, now_ms, options, machine);
  int left = budget;
  while (left > 0 && run_line(execution, now_ms, is_paused, options, machine)) --left;
  return execution.is_alive() ? 0 : left;
}

std::int64_t next_active_ms(const Execution& execution, std::int64_t done_ms) {
  std::int64_t next_ms = kNever;
  const auto look = [&](const Run& run) {
    if (!run.is_alive()) return;
    const bool is_timed = run.hold == Hold::begin || run.hold == Hold::timer;
    next_ms = std::min(next_ms, is_timed ? std::max(run.until_ms, done_ms + 1) : done_ms + 1);
  };
  look(execution.mp);
  for (const Run& isr : execution.isrs) look(isr);
  return next_ms;
}

bool is_sound(const Execution& execution, const Machine& machine) {
  const bool are_isrs = std::ranges::all_of(
      execution.isrs, [](const Run& run) { return run.is_isr && run.levels.size() == 1; });
  return are_isrs && !execution.mp.is_isr && is_sound_run(execution.mp, machine) &&
         std::ranges::all_of(execution.isrs, [&](const Run& run) { return is_sound_run(run, machine); });
}

}  // namespace understudy::interpreter::rs_m8194h
