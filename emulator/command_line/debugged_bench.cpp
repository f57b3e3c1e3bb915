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
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
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

constexpr std::chrono::seconds kStarting{60};  // a recording is replayed before it is served
constexpr std::chrono::milliseconds kAgain{5};

/// Returns the last line of a program's output, without the program's name.
std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  const std::size_t before = text.rfind('\n');
  if (before != std::string::npos) text.erase(0, before + 1);
  constexpr std::string_view kName = "understudy: ";
  if (text.starts_with(kName)) text.erase(0, kName.size());
  return one_line(text);
}

std::vector<std::string> with_socket(std::vector<std::string> words, const std::string& socket) {
  words.insert(words.end(), {"--control", socket});
  return words;
}

}  // namespace

QuietProgram::QuietProgram(std::vector<std::string> words)
    : messages_(memfd_create("understudy-dap", MFD_CLOEXEC)) {
  words.insert(words.begin(), "understudy");
  const pid_t parent = getpid();
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  // The program ends with this process, however that ends. Its output must not reach the client.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kExitWell);
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(messages_.get(), STDERR_FILENO);
  execv("/proc/self/exe", pointers.data());
  _exit(kExitNoResource);
}

void QuietProgram::end() {
  if (pid_ < 0) return;
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

std::optional<int> QuietProgram::ended() {
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kExitInternal;
}

std::string QuietProgram::news() {
  std::array<char, 4096> some{};
  std::string text;
  for (ssize_t got = 0; (got = pread(messages_.get(), some.data(), some.size(), returned_bytes_)) > 0;
       returned_bytes_ += got)
    text.append(some.data(), static_cast<std::size_t>(got));
  const std::size_t whole = text.rfind('\n') + 1;  // 0 if there is no complete line
  returned_bytes_ -= static_cast<off_t>(text.size() - whole);
  text.resize(whole);
  return text;
}

DebuggedBench::DebuggedBench(std::vector<std::string> words, const std::string& socket)
    : program_(with_socket(std::move(words), socket)) {
  const auto end_of_patience = std::chrono::steady_clock::now() + kStarting;
  while (!serve::is_answered(socket)) {
    if (program_.ended()) {
      const std::string why = last_line(program_.news());
      throw dap::RequestError(why.empty() ? "the bench ended before it was ready" : why);
    }
    if (is_interrupted() || std::chrono::steady_clock::now() > end_of_patience)
      throw dap::RequestError("the bench did not start within 60 s");
    std::this_thread::sleep_for(kAgain);
  }
}

RecordedScenario::RecordedScenario(const std::string& scenario)
    : folder_((std::filesystem::temp_directory_path() / "understudy-dap-XXXXXX").string()) {
  if (mkdtemp(folder_.data()) == nullptr)
    throw dap::RequestError(folder_ + ": cannot be created; expected a folder for recordings");
  try {
    QuietProgram run({"run", scenario, "--record", folder_});
    std::optional<int> code;
    while (!(code = run.ended())) {
      if (is_interrupted()) throw dap::RequestError("scenario: interrupted");
      std::this_thread::sleep_for(kAgain);
    }
    if (*code != kExitWell && *code != kExitFailed) throw dap::RequestError(last_line(run.news()));
    find_recording();
  } catch (...) {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
    throw;
  }
}

RecordedScenario::~RecordedScenario() {
  std::error_code error;
  std::filesystem::remove_all(folder_, error);
}

void RecordedScenario::find_recording() {
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() != ".jsonl") continue;
    if (!recording_.empty())
      throw dap::RequestError(
          "scenario: the file has several cases; expected one case, or a recording of a case from `run "
          "--record`");
    recording_ = entry.path().string();
  }
  if (recording_.empty())
    throw dap::RequestError("scenario: the run made no recording; expected a recording");
}

}  // namespace understudy::emulator::command_line
