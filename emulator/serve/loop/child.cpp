#include "emulator/serve/loop/child.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/timerfd.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/parent_signals.h"

namespace understudy::emulator::serve {

namespace {

// A group that was told to end is checked at this interval, because its members may not be our children.
constexpr WallTime kLook = std::chrono::milliseconds(10);
// A process that does not end when it is killed (for example because it waits for a broken disk) is abandoned
// after this time.
constexpr WallTime kAfterKilling = std::chrono::seconds(1);

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> environment_with(const std::vector<std::pair<std::string, std::string>>& added) {
  std::vector<std::string> all;
  for (const auto& [name, value] : added) all.push_back(name + "=" + value);
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view present = *entry;
    const std::string_view name = present.substr(0, present.find('='));
    const bool is_replaced =
        std::any_of(added.begin(), added.end(), [&](const auto& one) { return one.first == name; });
    if (!is_replaced) all.emplace_back(present);
  }
  return all;
}

}  // namespace

Child::Child(EventLoop& loop, const ParentSignals& signals, const ChildCommand& command,
             std::function<void()> over)
    : loop_(loop), signals_(signals), over_(std::move(over)), parent_(getpid()) {
  // Processes that the command leaves running become our children, so that they can be reaped.
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  if (command.output < 0) terminal_ = open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal_ >= 0 && tcgetpgrp(terminal_) != getpgrp()) {
    close(terminal_);  // the terminal belongs to another group
    terminal_ = -1;
  }
  timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
  try {
    if (timer_ < 0) throw std::system_error(errno, std::generic_category(), "timerfd_create");
    start(command);
  } catch (...) {
    if (terminal_ >= 0) close(terminal_);
    if (timer_ >= 0) close(timer_);
    throw;
  }
  loop_.watch(timer_, EventLoop::readable, [this](std::uint32_t) {
    std::uint64_t ignored = 0;
    if (read(timer_, &ignored, sizeof ignored) > 0) check_group();
  });
}

Child::~Child() {
  if (!is_over_) {
    kill(-pid_, SIGKILL);
    if (!has_ended_) waitpid(pid_, nullptr, 0);
    give_terminal_to(getpgrp());
  }
  loop_.unwatch(timer_);
  close(timer_);
  if (terminal_ >= 0) close(terminal_);
}

void Child::start(const ChildCommand& command) {
  // All memory is allocated before the fork, because another thread may hold the allocator's lock.
  const std::vector<std::string> environment = environment_with(command.environment);
  const std::vector<char*> words = pointers_to(command.words);
  const std::vector<char*> entries = pointers_to(environment);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe2");
  const Descriptor diagnostics(ends[0]);
  Descriptor complaining(ends[1]);
  pid_ = fork();
  if (pid_ == 0) become(words.data(), entries.data(), complaining.get(), command.output);
  if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  setpgid(pid_, pid_);  // both processes call this, because either one may run first
  give_terminal_to(pid_);
  complaining.close();
  int why = 0;
  ssize_t size = 0;
  do {
    size = read(diagnostics.get(), &why, sizeof why);
  } while (size < 0 && errno == EINTR);
  if (size != static_cast<ssize_t>(sizeof why)) return;  // the child has become the command
  waitpid(pid_, nullptr, 0);
  give_terminal_to(getpgrp());
  throw ChildError(command.words[0] + ": cannot be started: " + std::generic_category().message(why) +
                   "; expected a program");
}

/// Runs in the child, between fork and exec.
void Child::become(char* const* words, char* const* environment, int diagnostics, int output) {
  setpgid(0, 0);
  if (output >= 0) {
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(output, STDOUT_FILENO) < 0 ||
        dup2(output, STDERR_FILENO) < 0)
      _exit(127);
  }
  give_terminal_to(getpid());
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // its ports disappear with this process, however it ends
  if (getppid() != parent_) _exit(127);
  signals_.restore();
  execvpe(words[0], words, environment);
  const int why = errno;
  [[maybe_unused]] const ssize_t reported = write(diagnostics, &why, sizeof why);
  _exit(127);
}

void Child::look_after_children() {
  siginfo_t reported{};
  while (reported.si_pid = 0,
         waitid(P_ALL, 0, &reported, WEXITED | WSTOPPED | WNOHANG) == 0 && reported.si_pid != 0) {
    if (reported.si_pid != pid_) continue;  // an inherited orphan
    if (reported.si_code == CLD_STOPPED) {
      on_stop();
    } else {
      on_end(reported);
    }
  }
  if (has_ended_) check_group();
}

void Child::on_end(const siginfo_t& how) {
  has_ended_ = true;
  by_signal_ = how.si_code != CLD_EXITED;
  exit_code_ = by_signal_ ? 128 + how.si_status : how.si_status;
  was_asked_ = deadline_ > WallTime{0};
}

/// Handles Ctrl-Z, which the command received. This process also stops, as if it had received the signal, so
/// that the shell shows its prompt.
void Child::on_stop() {
  if (terminal_ < 0) return;
  give_terminal_to(getpgrp());
  kill(0, SIGTSTP);
  // This process has been continued, in the foreground or in the background.
  if (tcgetpgrp(terminal_) == getpgrp()) give_terminal_to(pid_);
  kill(-pid_, SIGCONT);
}

void Child::end_with(int signal_number) {
  if (is_over_) return;
  kill(-pid_, signal_number);
  kill(-pid_, SIGCONT);  // a stopped process would not receive the signal
  if (deadline_ > WallTime{0}) return;
  deadline_ = wall_now() + kGrace;
  set_timer(kLook);
}

void Child::check_group() {
  if (is_over_) return;
  if (has_ended_ && kill(-pid_, 0) != 0 && errno == ESRCH) return be_over();
  if (deadline_ == WallTime{0}) return end_with(SIGTERM);  // ends processes that the command has left running
  if (wall_now() >= deadline_) kill(-pid_, SIGKILL);
  if (has_ended_ && wall_now() >= deadline_ + kAfterKilling) be_over();
}

void Child::be_over() {
  is_over_ = true;
  set_timer(WallTime{0});
  give_terminal_to(getpgrp());
  over_();
}

void Child::give_terminal_to(pid_t group) const {
  if (terminal_ >= 0) tcsetpgrp(terminal_, group);
}

/// Sets the timer; 0 stops it.
void Child::set_timer(WallTime interval) const {
  itimerspec setting{};
  setting.it_value.tv_nsec = setting.it_interval.tv_nsec = interval.count();
  timerfd_settime(timer_, 0, &setting, nullptr);
}

}  // namespace understudy::emulator::serve
