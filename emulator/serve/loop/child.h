// Runs a command as a child process in its own process group, so that everything it starts ends with it. If
// this process has the terminal, the group gets it meanwhile, as from a shell: Ctrl-C and Ctrl-Z reach the
// command.
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

/// Thrown if the command could not be started. The message is one line that names it and has the reason.
struct ChildError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ChildCommand {
  std::vector<std::string> words;                                // the program and its arguments
  std::vector<std::pair<std::string, std::string>> environment;  // in addition to our own, or replacing them
  /// A descriptor for its output; the command then has no input and no terminal. -1: it uses ours.
  int output = -1;
};

/// Only one may exist at a time, because it waits for every child of this process and every orphan that it
/// inherits.
class Child {
 public:
  /// The time between asking a group to end and killing it.
  static constexpr WallTime kGrace = std::chrono::seconds(5);

  /// Starts the command. `over` is called once, when the command has ended and its whole group is gone.
  /// Throws ChildError.
  Child(EventLoop& loop, const ParentSignals& signals, const ChildCommand& command,
        std::function<void()> over);
  /// Kills the remaining processes of the group.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Must be called for SIGCHLD.
  void look_after_children();
  /// Sends a signal to the group. Processes that still exist after kGrace are killed.
  void end_with(int signal_number);

  /// Returns the exit code of the command, or 128 + n if signal n ended it.
  int exit_code() const { return exit_code_; }
  /// Returns true if the command was asked to end, or was ended by a signal.
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
  WallTime deadline_{0};  // when the group will be killed; 0: it was not asked to end
  bool has_ended_ = false;
  bool is_over_ = false;
  bool was_asked_ = false;
  bool by_signal_ = false;
  int exit_code_ = -1;
};

}  // namespace understudy::emulator::serve
