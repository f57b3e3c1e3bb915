#include "emulator/command_line/debugged_bench.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/interruption.h"
#include "emulator/dap/bench_link.h"
#include "emulator/serve/control/server.h"

namespace understudy::emulator::command_line {

namespace {

constexpr std::chrono::seconds kStarting{60};  // a recording is played before it is served
constexpr std::chrono::milliseconds kAgain{5};

/// Returns the last line of what a program said, without its name.
std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  const std::size_t before = text.rfind('\n');
  if (before != std::string::npos) text.erase(0, before + 1);
  constexpr std::string_view kName = "understudy: ";
  if (text.starts_with(kName)) text.erase(0, kName.size());
  return one_line(text);
}

}  // namespace

DebuggedBench::DebuggedBench(std::vector<std::string> words, const std::string& socket)
    : said_(memfd_create("understudy-dap", MFD_CLOEXEC)) {
  words.insert(words.begin(), "understudy");
  words.insert(words.end(), {"--control", socket});
  start(words);
  const auto end_of_patience = std::chrono::steady_clock::now() + kStarting;
  while (!serve::is_answered(socket)) {
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      pid_ = -1;
      const std::string why = last_line(news());
      throw dap::RequestError(why.empty() ? "the bench has ended before it was served" : why);
    }
    if (is_interrupted() || std::chrono::steady_clock::now() > end_of_patience) {
      end();
      throw dap::RequestError("the bench has not started within 60 s");
    }
    std::this_thread::sleep_for(kAgain);
  }
}

void DebuggedBench::start(std::vector<std::string>& words) {
  const pid_t parent = getpid();
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  // It ends with this process, however that ends, and says nothing to the client.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kExitWell);
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(said_.get(), STDERR_FILENO);
  execv("/proc/self/exe", pointers.data());
  _exit(kExitNoResource);
}

void DebuggedBench::end() {
  if (pid_ < 0) return;
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

std::string DebuggedBench::news() {
  std::array<char, 4096> some{};
  std::string text;
  for (ssize_t got = 0; (got = pread(said_.get(), some.data(), some.size(), told_)) > 0; told_ += got)
    text.append(some.data(), static_cast<std::size_t>(got));
  const std::size_t whole = text.rfind('\n') + 1;  // 0 if there is none
  told_ -= static_cast<off_t>(text.size() - whole);
  text.resize(whole);
  return text;
}

}  // namespace understudy::emulator::command_line
