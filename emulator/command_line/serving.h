// Code shared by all commands that serve a bench.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "emulator/command_line/commands.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::command_line {

struct Serving {
  world::Bench bench;
  serve::DaemonOptions options;
  std::optional<gid_t> group;  // a group that may also open the ports
};

/// Reads the bench and its initial memories. Throws the errors of both. `command` is used in messages.
Serving make_serving(ModelList models, const ServeArguments& arguments, const std::string& command);

/// Prints a line for each port: its pseudo-terminal and its link. Throws PortError if standard output cannot
/// be written.
void print_ready(const serve::Daemon& daemon);

/// Prints the findings of `--lint` to standard error.
void print_findings(const std::vector<std::string>& findings);

}  // namespace understudy::emulator::command_line
