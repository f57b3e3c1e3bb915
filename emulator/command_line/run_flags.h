// The flags of `run` and `exec`. Only flags.cpp includes this file, because CLI11 is slow to compile.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/command_line/box_flags.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/serving_flags.h"

namespace understudy::emulator::command_line {

inline const CLI::Validator kCourses(
    [](const std::string& value) {
      const auto number = parse_integer(value);
      if (!number)
        return quoted(value) + " is not a number of courses; expected a whole number, up to " +
               std::to_string(INT64_MAX);
      return *number >= 1 ? std::string() : value + " is too few; expected 1 or more";
    },
    "");

inline void add_save_below(CLI::App& command, std::string& folder) {
  command
      .add_option("--save-below", folder,
                  "Folder below which scenarios may `save` files [the folder of each scenario]")
      ->check(kNotEmpty);
}

/// Adds the flags of `run` and `exec` for the cases of a scenario.
inline void add_case_flags(CLI::App& command, RunArguments& run) {
  command
      .add_option("--junit", run.junit,
                  "Write the results to this file as JUnit XML; - writes to standard output")
      ->check(kNotEmpty);
  command.add_flag("--hash", run.hash,
                   "Print a hash of everything that each scenario's devices sent and did, to compare runs");
  command.add_option("--jobs", run.jobs,
                     "Number of scenarios to run at a time [one for each core; in real time at least 8]");
  command.add_option("--shard", run.shard, "I/N: run the I-th of all scenarios, and every N-th after it")
      ->check(kNotEmpty);
  command.add_option("--seed", run.seed, "Use this seed instead of the scenarios' own")->check(kSeed);
  command
      .add_option(
          "--filter", run.filter,
          "Run only scenarios whose names match this pattern, such as '*move*', or one case, by its ID")
      ->check(kNotEmpty);
  command
      .add_option("--results", run.results,
                  "Write a row for each case to this file: FILE.jsonl or FILE.sqlite; can be given twice")
      ->allow_extra_args(false)
      ->check(kNotEmpty);
  command.add_flag("--resume", run.resume, "Skip cases that already have a row in the --results file");
  command
      .add_option("--failures", run.failures,
                  "Folder for recordings of failures, the first of each kind [below /tmp]")
      ->check(kNotEmpty);
}

inline void add_run_flags(CLI::App& command, RunArguments& run) {
  command.add_option("SCENARIO", run.scenarios, "Scenario files, or folders whose scenarios are all run")
      ->required();
  command.add_flag("--real-time", run.real_time,
                   "Run in real time over real ports, with libmodbus as the host");
  command
      .add_option("--on", run.on.on,
                  "LINE=PORT: play the scenarios on a real controller at this port, instead of the bench's "
                  "devices on that line; can be given for several lines. PORT is as for photograph")
      ->allow_extra_args(false)
      ->check(kNotEmpty);
  add_stage_flags(command, run.on);
  command.add_flag(
      "--dialogue", run.dialogue,
      "With --on: after the scenario's steps, read more steps from standard input, as lines of JSON");
  command.add_option("--report", run.report, "Write a report on all scenarios to this file, as HTML")
      ->check(kNotEmpty);
  command
      .add_option("--record", run.record,
                  "Folder for the recordings of all scenarios [only failures are recorded, below /tmp]")
      ->check(kNotEmpty);
  command.add_option("--trace", run.trace, "Folder for a trace of each scenario, as CSV")->check(kNotEmpty);
  command.add_option("--trace-also", run.trace_also, kTraceAlsoHelp)->delimiter(',')->check(kNotEmpty);
  command.add_option("--capture", run.capture, "Folder for a capture of each scenario, for Wireshark")
      ->check(kNotEmpty);
  add_save_below(command, run.save_below);
  command.add_flag("--lint", run.lint, kLintHelp);
  command.add_option("--coverage", run.coverage, kCoverageHelp)->check(kNotEmpty);
  command.add_option("--coverage-min", run.coverage_min,
                     "Fail if less than this percentage of the programs' lines has run");
  command.add_option("--device-coverage", run.device_coverage, kDeviceCoverageHelp)->check(kNotEmpty);
  add_case_flags(command, run);
}

inline void add_hunt_flags(CLI::App& command, HuntArguments& hunt) {
  command
      .add_option("SCENARIO", hunt.scenario,
                  "A scenario file with a `hunt` section; `-- COMMAND` comes after it")
      ->required();
  command.add_option("--for", hunt.time, "End after this much real time [60s, unless --courses is given]")
      ->check(kNotEmpty);
  command.add_option("--courses", hunt.courses, "End after this many courses [any number]")->check(kCourses);
  command.add_option("--seed", hunt.seed, "Seed of the courses: any whole number")
      ->check(kSeed)
      ->capture_default_str();
  command.add_option("--jobs", hunt.jobs, "Number of courses to play at a time [one for each core]");
  command.add_option("--shard", hunt.shard, "I/N: play the I-th of all courses, and every N-th after it")
      ->check(kNotEmpty);
  command.add_flag(
      "--unguided", hunt.unguided,
      "Draw each course independently, instead of building on courses that reached something new");
  command.add_flag("--plan", hunt.plan, "Print the possible disturbances as JSON, and play no course");
  command
      .add_option("--corpus", hunt.corpus,
                  "Store courses that reached something new in this file, and start from those in it")
      ->check(kNotEmpty);
  command.add_option("--coverage", hunt.coverage, kCoverageHelp)->check(kNotEmpty);
  command.add_option("--device-coverage", hunt.device_coverage, kDeviceCoverageHelp)->check(kNotEmpty);
  command
      .add_option("--found", hunt.found,
                  "Folder for the findings: a scenario, a recording and a page for each kind of failure")
      ->capture_default_str()
      ->check(kNotEmpty);
  command.add_option("--timeout", hunt.timeout, "End the command after this much real time in a course")
      ->capture_default_str()
      ->check(kNotEmpty);
}

/// Adds the flags that `exec` has in addition to those of `serve`.
inline void add_exec_flags(CLI::App& command, ExecArguments& exec) {
  command.add_option("--with", exec.with, "Scenario to run while the command runs [none]")->check(kNotEmpty);
  add_save_below(command, exec.save_below);
  command.add_flag("--tty-shim", exec.host.tty_shim,
                   "Preload a library with which hosts that insist on parity can use a pseudo-terminal");
  command.add_flag("--host-time", exec.host.host_time,
                   "Also run the command in simulated time; implies --tty-shim");
  command.add_option("--repeat", exec.repeat,
                     "Run the command this many times, and compare the recordings (with --host-time)");
  command.add_flag_callback(
      "--twice", [&exec] { exec.repeat = 2; }, "The same as --repeat 2");
  command
      .add_option("--timeout", exec.timeout,
                  "End the command after this much real time [never; 60s in the cases of a scenario]")
      ->check(kNotEmpty);
  add_case_flags(command, exec.cases);
}

}  // namespace understudy::emulator::command_line
