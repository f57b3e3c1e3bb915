#include "emulator/box/stage/rig.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "base/files/descriptor.h"
#include "base/text/one_line.h"

namespace understudy::emulator::box {

namespace {

/// Becomes the shell that runs the command. Nothing is allocated between fork and exec. Ctrl-Z does not stop
/// it, since nobody would let it go on.
[[noreturn]] void become_rig(char* const* words, int output) {
  signal(SIGTSTP, SIG_IGN);
  dup2(output, STDOUT_FILENO);
  execvp("sh", words);
  _exit(127);
}

std::string request_to_person(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

constexpr std::chrono::milliseconds kRigSlice{50};

/// Waits until there is something to read, or the other end is closed.
void await_readable(int descriptor, const WhileWaiting& meanwhile) {
  pollfd waited{.fd = descriptor, .events = POLLIN, .revents = 0};
  do {
    if (meanwhile) meanwhile();
  } while (::poll(&waited, 1, static_cast<int>(kRigSlice.count())) <= 0);  // a signal ends it early
}

/// A shell that runs a rig. If nobody has waited for its end, it is asked to end.
class RigShell {
 public:
  explicit RigShell(pid_t pid) : pid_(pid) {}
  ~RigShell() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, WNOHANG);
  }
  RigShell(const RigShell&) = delete;
  RigShell& operator=(const RigShell&) = delete;

  /// Returns its status.
  int wait(const WhileWaiting& meanwhile) {
    int status = 127 << 8;
    while (pid_ > 0 && ::waitpid(pid_, &status, WNOHANG) != pid_) {
      if (meanwhile) meanwhile();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    pid_ = 0;
    return status;
  }

 private:
  pid_t pid_;
};

}  // namespace

CommandAnswer run_command(const std::string& command, const std::vector<std::string>& words,
                          const WhileWaiting& meanwhile) {
  std::array<int, 2> pipe_ends{};
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return {.exit_code = 127, .output = {}};
  const Descriptor output(pipe_ends[0]);
  Descriptor input(pipe_ends[1]);
  std::vector<std::string> all{"sh", "-c", command + " \"$@\"", "rig"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> raw;
  for (std::string& word : all) raw.push_back(word.data());
  raw.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) become_rig(raw.data(), input.get());
  input.close();
  RigShell shell(child);
  CommandAnswer answer;
  std::array<char, 512> part{};
  while (child > 0) {
    await_readable(output.get(), meanwhile);
    const ssize_t size = ::read(output.get(), part.data(), part.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) break;
    answer.output.append(part.data(), static_cast<std::size_t>(size));
  }
  const int status = shell.wait(meanwhile);
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  while (!answer.output.empty() && (answer.output.back() == '\n' || answer.output.back() == '\r'))
    answer.output.pop_back();
  return answer;
}

bool ask_person(const std::vector<std::string>& words, const WhileWaiting& meanwhile) {
  std::fprintf(stderr, "please do this: %s; then press Enter (s and Enter skips it): ",
               one_line(request_to_person(words)).c_str());
  std::fflush(stderr);
  // One byte at a time: what follows the line belongs to the next question.
  std::string line;
  while (true) {
    await_readable(STDIN_FILENO, meanwhile);
    char byte = 0;
    const ssize_t size = ::read(STDIN_FILENO, &byte, 1);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return !line.empty() && !line.starts_with('s');
    if (byte == '\n') return !line.starts_with('s');
    line += byte;
  }
}

}  // namespace understudy::emulator::box
