// One line of a macro at work.
#pragma once

#include <cstdint>

#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/run.h"

namespace understudy::interpreter::rs_m8194h {

MacroName name_of_level(const Run& run, const Level& level);

void hold(Run& run, Hold what, std::int64_t until_ms = 0, std::uint32_t awaited = 0);

/// Whether what a run waits for has come. A drive that waits is asked for anew by its line.
bool is_over(Run& run, std::int64_t now_ms, const RunOptions& options, Machine& machine);

/// Whether `awaited` can be what FRNET_WAIT waits for.
bool is_frnet_input(std::uint32_t awaited);

/// What a line did to its run.
enum class Ran : std::uint8_t {
  on,
  waits,
  all_ended,  // the run is gone
};

/// Of a run that is alive and waits for nothing else.
Ran run_next_line(Execution& execution, Run& run, std::int64_t now_ms, const RunOptions& options,
                  Machine& machine);

}  // namespace understudy::interpreter::rs_m8194h
