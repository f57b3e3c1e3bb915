// The flags of `run`. Included by flags.cpp only: CLI11 is slow to compile.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/serving_flags.h"

namespace understudy::emulator::command_line {

inline void add_save_below(CLI::App& command, std::string& folder) {
  command
      .add_option("--save-below", folder, "Let scenarios `save` below this folder [each one's own folder]")
      ->check(kNotEmpty);
}

inline void add_run_flags(CLI::App& command, RunArguments& run) {
  command.add_option("SCENARIO", run.scenarios, "Scenario files; folders, of which all scenarios are played")
      ->required();
  command.add_flag("--real-time", run.real_time,
                   "By the wall clock, over real ports, with libmodbus as the host");
  command
      .add_option("--junit", run.junit, "Write the results to this file, as JUnit XML; - for standard output")
      ->check(kNotEmpty);
  command.add_option("--report", run.report, "Write a page about all of it to this file, as HTML")
      ->check(kNotEmpty);
  command
      .add_option("--record", run.record,
                  "Folder for the recordings of all scenarios [those of failures, below /tmp]")
      ->check(kNotEmpty);
  command.add_option("--trace", run.trace, "Folder for a trace of each scenario, as CSV")->check(kNotEmpty);
  command.add_option("--trace-also", run.trace_also, kTraceAlsoHelp)->delimiter(',')->check(kNotEmpty);
  command.add_option("--capture", run.capture, "Folder for a capture of each scenario, for Wireshark")
      ->check(kNotEmpty);
  add_save_below(command, run.save_below);
  command.add_flag("--lint", run.lint, kLintHelp);
  command.add_flag("--hash", run.hash,
                   "Print a hash of all that each scenario's devices said and did, for comparison");
  command.add_option("--jobs", run.jobs,
                     "How many are played at a time [one for each core; in real time at least 8]");
  command.add_option("--shard", run.shard, "I/N: the I-th of all scenarios, and every N-th after it")
      ->check(kNotEmpty);
  command.add_option("--seed", run.seed, "Instead of the scenarios' own seeds")->check(kSeed);
  command
      .add_option("--filter", run.filter,
                  "Those whose names match this pattern, such as '*move*'; or one case, by its identity")
      ->check(kNotEmpty);
  command
      .add_option("--results", run.results,
                  "Write a row for each case to this file: FILE.jsonl or FILE.sqlite; may be given twice")
      ->allow_extra_args(false)
      ->check(kNotEmpty);
  command.add_flag("--resume", run.resume, "Leave out the cases that --results has rows of already");
  command
      .add_option("--failures", run.failures,
                  "Folder for the recordings of failures, the first of each kind [below /tmp]")
      ->check(kNotEmpty);
}

}  // namespace understudy::emulator::command_line
