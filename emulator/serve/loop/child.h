// A command as a child process, in a process group of its own, so that what it starts ends with it. Where we
// have the terminal, the group has it meanwhile, as a shell would do: Ctrl-C and Ctrl-Z reach the command.
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

/// It could not be started: one line that names it and says why.
struct ChildError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ChildCommand {
  std::vector<std::string> words;  // the program and its arguments
  std::vector<std::pair<std::string, std::string>>
      environment;  // beside our own, or instead of what is there
};

/// One at a time: it takes care of every child that this process has, or is given when its parent has gone.
class Child {
 public:
  /// Between asking a group to end and making it end.
  static constexpr WallTime kGrace = std::chrono::seconds(5);

  /// Starts it; `over` is called once, when it has ended and its whole group is gone. Throws ChildError.
  Child(EventLoop& loop, const ParentSignals& signals, const ChildCommand& command,
        std::function<void()> over);
  /// Whatever is left of the group is killed.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// To be called for SIGCHLD.
  void look_after_children();
  /// To the group; what is still there after kGrace is killed.
  void end_with(int signal_number);

  /// What the command ended with: its exit code, or 128 + n if signal n ended it.
  int exit_code() const { return exit_code_; }
  /// It was asked to end, or ended by a signal, and not by itself.
  bool was_ended() const { return was_asked_ || by_signal_; }

 private:
  void start(const ChildCommand& command);
  [[noreturn]] void become(char* const* words, char* const* environment, int complaints);
  void on_end(const siginfo_t& how);
  void on_stop();
  void look_at_group();
  void be_over();
  void give_terminal_to(pid_t group) const;
  void set_timer(WallTime interval) const;

  EventLoop& loop_;
  const ParentSignals& signals_;
  std::function<void()> over_;
  pid_t parent_ = -1;
  pid_t pid_ = -1;  // and the number of its group
  int terminal_ = -1;
  int timer_ = -1;
  WallTime deadline_{0};  // when the group is made to end; 0: nobody has asked it to
  bool has_ended_ = false;
  bool is_over_ = false;
  bool was_asked_ = false;
  bool by_signal_ = false;
  int exit_code_ = -1;
};

}  // namespace understudy::emulator::serve
