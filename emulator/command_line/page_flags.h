// The flags of `page`. Only flags.cpp includes this file, because CLI11 is slow to compile.
#pragma once

#include <CLI/CLI.hpp>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/serving_flags.h"

namespace understudy::emulator::command_line {

inline void add_page_flags(CLI::App& command, PageArguments& page) {
  command
      .add_option("--control", page.sockets,
                  "Control socket of a bench; can be given several times [all running daemons]")
      ->check(kNotEmpty)
      ->allow_extra_args(false);
  command.add_option("--port", page.port, "Port to listen on; 0 selects any free port")
      ->capture_default_str();
  command.add_option("--listen", page.listen, "Address to listen on")
      ->capture_default_str()
      ->check(kNotEmpty);
  command.add_option("--host", page.hosts, "Name that browsers may use for this machine, besides localhost")
      ->check(kNotEmpty)
      ->allow_extra_args(false);
  command.add_flag("--read-only", page.read_only, "Let browsers read, but change nothing");
  command.add_option("--web", page.folder, "Serve the page's files from this folder, while you work on them")
      ->check(kNotEmpty);
}

}  // namespace understudy::emulator::command_line
