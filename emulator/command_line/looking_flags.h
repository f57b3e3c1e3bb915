// The flags of commands that show past events. Only flags.cpp includes this file, because CLI11 is slow to
// compile.
#pragma once

#include <CLI/CLI.hpp>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/serving_flags.h"

namespace understudy::emulator::command_line {

inline void add_watch_flags(CLI::App& command, WatchArguments& watched) {
  command.add_option("NAME", watched.names, "Names to show, as for `get` [everything]");
  command.add_option("--every", watched.every, "Time between two updates")->capture_default_str();
  command.add_option("--times", watched.times, "Number of updates; 0 continues until Ctrl-C")
      ->capture_default_str();
}

inline void add_frames_flags(CLI::App& command, FramesArguments& frames) {
  command.add_option("--last", frames.last, "Number of earlier frames to show first")->capture_default_str();
  command.add_flag("--once", frames.once, "Show these and exit");
  command.add_option("--every", frames.every, "Time between two updates")->capture_default_str();
  command.add_option("--times", frames.times, "Number of updates; 0 continues until Ctrl-C")
      ->capture_default_str();
}

inline void add_plot_flags(CLI::App& command, PlotArguments& plot) {
  command.add_option("TRACE", plot.trace, "A file written by --trace")->required();
  command.add_option("-o,--output", plot.output, "FILE.png or FILE.svg [a PNG next to the trace]")
      ->check(kNotEmpty);
  command.add_option("--also", plot.also, "Columns to draw in separate panels, such as feeder.STATUS")
      ->delimiter(',')
      ->check(kNotEmpty);
}

}  // namespace understudy::emulator::command_line
