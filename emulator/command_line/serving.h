// The flags that all serving commands share, and what they mean.
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
  std::optional<gid_t> group;  // that may open the ports as well
};

/// Reads the bench and the memories it begins with. `command` is for messages. Throws what is wrong with
/// them.
Serving make_serving(ModelList models, const ServeArguments& arguments, const std::string& command);

/// One line for each port on standard output: its pty and its link. Throws PortError if nobody can read it.
void say_ready(const serve::Daemon& daemon);

/// What `--lint` has found, on standard error.
void print_findings(const std::vector<std::string>& findings);

}  // namespace understudy::emulator::command_line
