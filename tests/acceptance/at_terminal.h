// A program at a terminal, with a user who types and reads.
#pragma once

#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {

/// The size of a terminal's window.
struct WindowSize {
  unsigned short rows = 24;
  unsigned short columns = 80;
};

/// A program at its own terminal, with a user.
class AtTerminal {
 public:
  explicit AtTerminal(const Words& command, const Environment& environment = {}, WindowSize size = {}) {
    int master = -1;
    const winsize window{size.rows, size.columns, 0, 0};
    pid_ = forkpty(&master, nullptr, nullptr, &window);
    if (pid_ == 0) {
      for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
      std::vector<char*> words;
      for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
      words.push_back(nullptr);
      execvp(words[0], words.data());
      _exit(127);
    }
    master_ = Descriptor(master);
  }
  ~AtTerminal() {
    master_.close();  // the terminal hangs up
    if (!wait(Wait(2000))) kill(pid_, SIGKILL), wait(kPatience);
  }
  AtTerminal(const AtTerminal&) = delete;
  AtTerminal& operator=(const AtTerminal&) = delete;

  void type(const std::string& keys) const {
    ASSERT_EQ(write(master_.get(), keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  void resize(WindowSize size) const {
    const winsize window{size.rows, size.columns, 0, 0};
    ASSERT_EQ(ioctl(master_.get(), TIOCSWINSZ, &window), 0);
  }
  /// Returns true if this text has appeared on the screen since the last call, or appears within kPatience.
  bool shows(const std::string& text) {
    return eventually([&] {
      char part[512];
      fd_set readable;
      FD_ZERO(&readable);
      FD_SET(master_.get(), &readable);
      timeval no_time{};
      if (select(master_.get() + 1, &readable, nullptr, nullptr, &no_time) > 0) {
        const ssize_t size = read(master_.get(), part, sizeof part);
        if (size > 0) screen_.append(part, static_cast<std::size_t>(size));
      }
      const auto at = screen_.find(text);
      if (at == std::string::npos) return false;
      screen_.erase(0, at + text.size());
      return true;
    });
  }
  std::optional<int> wait(Wait patience) {
    eventually(
        [this] {
          int status = 0;
          if (!code_ && waitpid(pid_, &status, WNOHANG) == pid_)
            code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
          return code_.has_value();
        },
        patience);
    return code_;
  }
  const std::string& screen() const { return screen_; }

 private:
  pid_t pid_ = -1;
  Descriptor master_;
  std::string screen_;
  std::optional<int> code_;
};

}  // namespace understudy::acceptance
