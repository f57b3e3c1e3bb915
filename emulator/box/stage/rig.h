// Acts on the environment of a real controller, through a command of the user or a person.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace understudy::emulator::box {

/// The exit code by which a rig says that it cannot do something.
inline constexpr int kRigCannot = 3;

struct CommandAnswer {
  int exit_code = 0;
  std::string output;  // on its standard output
};
/// Called again and again while a rig works or a person is awaited, and at once after a signal. It may throw.
using WhileWaiting = std::function<void()>;

/// Runs "COMMAND input feeder.DIN_2 on" in a shell. Exit code 127: it cannot be run. If `meanwhile` throws,
/// the shell is asked to end.
CommandAnswer run_command(const std::string& command, const std::vector<std::string>& words,
                          const WhileWaiting& meanwhile = {});

/// Asks the person at the terminal to do it. Returns false if that person skips it.
bool ask_person(const std::vector<std::string>& words, const WhileWaiting& meanwhile);

}  // namespace understudy::emulator::box
