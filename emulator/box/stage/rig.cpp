#include "emulator/box/stage/rig.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <string>
#include <vector>

#include "base/text/one_line.h"

namespace understudy::emulator::box {

namespace {

/// Becomes the shell that runs the command. Nothing is allocated between fork and exec.
[[noreturn]] void become_rig(char* const* words, int output) {
  dup2(output, STDOUT_FILENO);
  execvp("sh", words);
  _exit(127);
}

std::string request_to_person(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

CommandAnswer run_command(const std::string& command, const std::vector<std::string>& words) {
  std::array<int, 2> pipe_ends{};
  if (pipe(pipe_ends.data()) != 0) return {.exit_code = 127, .output = {}};
  std::vector<std::string> all{"sh", "-c", command + " \"$@\"", "rig"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> raw;
  for (std::string& word : all) raw.push_back(word.data());
  raw.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    close(pipe_ends[0]);
    become_rig(raw.data(), pipe_ends[1]);
  }
  close(pipe_ends[1]);
  CommandAnswer answer;
  std::array<char, 512> part{};
  while (child > 0) {
    const ssize_t size = read(pipe_ends[0], part.data(), part.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) break;
    answer.output.append(part.data(), static_cast<std::size_t>(size));
  }
  close(pipe_ends[0]);
  int status = 127 << 8;
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  while (!answer.output.empty() && (answer.output.back() == '\n' || answer.output.back() == '\r'))
    answer.output.pop_back();
  return answer;
}

bool ask_person(const std::vector<std::string>& words) {
  std::fprintf(stderr, "please do this: %s; then press Enter (s and Enter skips it): ",
               one_line(request_to_person(words)).c_str());
  std::fflush(stderr);
  std::array<char, 80> line{};
  if (std::fgets(line.data(), static_cast<int>(line.size()), stdin) == nullptr) return false;
  return line[0] != 's';
}

}  // namespace understudy::emulator::box
