// Runs a command as a child process in its own process group, so that all processes that it starts end with
// it. If this process has the terminal, the group gets it meanwhile, as from a shell: Ctrl-C and Ctrl-Z reach
// the command.
#pragma once

#include <sys/types.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/parent_signals.h"

namespace understudy::emulator::serve {

/// Thrown if the command could not be started. The message is one line with the command and the reason.
struct ChildError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ChildCommand {
  std::vector<std::string> words;                                // the program and its arguments
  std::vector<std::pair<std::string, std::string>> environment;  // in addition to our own
  /// A descriptor for its output; the command then has no input and no terminal. -1: the command uses our
  /// output.
  int output = -1;
};

/// A running command. Only one may exist at a time, because it waits for every child of this process and
/// every inherited orphan.
class Child {
 public:
  /// The time between asking a group to end and killing it.
  static constexpr WallTime kGrace = std::chrono::seconds(5);

  /// Starts the command. Calls `over` once, when the command has ended and its whole group is gone. Throws
  /// ChildError.
  Child(EventLoop& loop, const ParentSignals& signals, const ChildCommand& command,
        std::function<void()> over);
  /// Kills the remaining processes of the group.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Call this on SIGCHLD.
  void look_after_children();
  /// Sends a signal to the group. Processes that still exist after kGrace are killed.
  void end_with(int signal_number);

  /// Returns the number of the command's process.
  int process() const { return pid_; }
  /// Returns the exit code of the command, or 128 + n if signal n ended it.
  int exit_code() const { return exit_code_; }
  /// Returns true if the command was told to end, or was ended by a signal.
  bool was_ended() const { return was_asked_ || by_signal_; }

 private:
  void start(const ChildCommand& command);
  [[noreturn]] void become(char* const* words, char* const* environment, int diagnostics, int output);
  void on_end(const siginfo_t& how);
  void on_stop();
  void check_group();
  void be_over();
  void give_terminal_to(pid_t group) const;
  void set_timer(WallTime interval) const;

  EventLoop& loop_;
  const ParentSignals& signals_;
  std::function<void()> over_;
  pid_t parent_ = -1;
  pid_t pid_ = -1;  // also the number of its group
  int terminal_ = -1;
  int timer_ = -1;
  WallTime deadline_{0};  // when the group will be killed; 0: it was not told to end
  bool has_ended_ = false;
  bool is_over_ = false;
  bool was_asked_ = false;
  bool by_signal_ = false;
  int exit_code_ = -1;
};

}  // namespace understudy::emulator::serve
