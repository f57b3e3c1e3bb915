// Executes one line of a macro.
#pragma once

#include <cstdint>

#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/options.h"
#include "interpreter/rs_m8194h/run.h"

namespace understudy::interpreter::rs_m8194h {

MacroName name_of_level(const Run& run, const Level& level);

void hold(Run& run, Hold what, std::int64_t until_ms = 0, std::uint32_t awaited = 0);

/// Returns true if the run need not wait any longer. A line that is waiting for the machine is simply run
/// again.
bool is_over(Run& run, std::int64_t now_ms, const Options& options, Machine& machine);

/// Returns true if `awaited` can be an input of FRNET_WAIT.
bool is_frnet_input(std::uint32_t awaited);

/// The effect of a line on its run.
enum class Ran : std::uint8_t {
  on,
  waits,
  all_ended,  // the run has ended
};

/// Runs the next line of a run that is active and not waiting.
Ran run_next_line(Execution& execution, Run& run, std::int64_t now_ms, const Options& options,
                  Machine& machine);

}  // namespace understudy::interpreter::rs_m8194h
