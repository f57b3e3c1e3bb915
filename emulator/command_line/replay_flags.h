// The flags of `replay`. Only flags.cpp includes this file, because CLI11 is slow to compile.
#pragma once

#include <CLI/CLI.hpp>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/serving_flags.h"

namespace understudy::emulator::command_line {

inline void add_replay_flags(CLI::App& command, ReplayArguments& replay) {
  command.add_option("RECORDING", replay.recording, "A file written by `serve --record` or `run`")
      ->required();
  command.add_option("--until", replay.until, "Stop at this simulated time and serve from there [the end]")
      ->check(kNotEmpty);
  command
      .add_option("--control", replay.control,
                  "Path of the control socket, with --until, --serve or --page [a private path]")
      ->check(kNotEmpty);
  CLI::Option* const trace = command.add_option(
      "--trace", replay.trace,
      "Write positions and signals over time to this file: FILE.csv, or FILE.vcd for GTKWave");
  CLI::Option* const trace_also = command.add_option("--trace-also", replay.trace_also, kTraceAlsoHelp);
  CLI::Option* const capture =
      command.add_option("--capture", replay.capture,
                         "Write the traffic on the lines to this file: FILE.pcapng for Wireshark, any "
                         "other name for a text log");
  CLI::Option* const report =
      command.add_option("--report", replay.report, "Write a report on the recording to this file, as HTML");
  for (CLI::Option* const file : {trace, trace_also, capture, report}) file->check(kNotEmpty);
  trace_also->delimiter(',');
  CLI::Option* const page = command.add_option(
      "--page", replay.page,
      "Open the recording in a browser, at the time of --until if given, on this port [any free port]");
  page->expected(0, 1)->default_str("0")->excludes(trace, trace_also, capture, report);
  CLI::Option* const story = command.add_option(
      "--export", replay.story,
      "Write the recording's page to this file, as HTML that needs neither a server nor a network");
  CLI::Option* const picture = command.add_option(
      "--picture", replay.picture, "Write a picture of the recording to this file: FILE.svg or FILE.png");
  command.add_option("--panel", replay.panel, "What --picture shows: timeline, axes, path or bus [timeline]")
      ->check(kNotEmpty);
  for (CLI::Option* const file : {story, picture}) {
    file->check(kNotEmpty)->excludes(trace, trace_also, capture, report, page);
    file->excludes("--until", "--control");
  }
  command
      .add_flag(
          "--serve", replay.serve,
          "Serve the recording for `ctl` and debuggers, at the time of --until, at its failure, or from its "
          "beginning")
      ->excludes(trace, trace_also, capture, report, story, picture);
  command
      .add_option("--at", replay.at,
                  "The moment that --export and --picture show [the failure or the beginning]")
      ->check(kNotEmpty);
}

}  // namespace understudy::emulator::command_line
