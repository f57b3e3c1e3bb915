#include "tests/acceptance/running_understudy.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace understudy::acceptance {

namespace {

constexpr Wait kGrace{2'000};  // between SIGTERM and SIGKILL

/// A file without a name: a process can print any amount and never waits for a reader.
Descriptor nameless_file() {
  Descriptor file(memfd_create("printed", MFD_CLOEXEC));
  if (!file) throw std::runtime_error("memfd_create failed");
  return file;
}

std::string text_of(const Descriptor& file) {
  struct stat status {};
  fstat(file.get(), &status);
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  const ssize_t size = pread(file.get(), text.data(), text.size(), 0);
  text.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
  return text;
}

/// In the child, between fork and exec.
[[noreturn]] void become(const Words& command, const Environment& environment, int output, int errors) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(output, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  close_range(STDERR_FILENO + 1, ~0U, 0);  // the child does not inherit a port that the test holds open
  for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execvp(words[0], words.data());
  _exit(127);
}

}  // namespace

bool eventually(const std::function<bool()>& holds, Wait patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(Wait(2));
  }
  return true;
}

PrivateFolder::PrivateFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "understudy-acceptance-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be created");
  path_ = name;
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string PrivateFolder::write(const std::string& name, const std::string& text) const {
  const std::string path = *this / name;
  std::ofstream(path) << text;
  return path;
}

Process::Process(const Words& command, const Environment& environment)
    : output_(nameless_file()), errors_(nameless_file()) {
  pid_ = fork();
  if (pid_ == 0) become(command, environment, output_.get(), errors_.get());
  if (pid_ < 0) throw std::runtime_error("fork failed");
}

Process::~Process() {
  if (exit_code_) return;
  send(SIGTERM);  // so that it can clean up
  if (wait(kGrace)) return;
  send(SIGKILL);
  wait(kPatience);
}

void Process::send(int signal_number) const {
  if (!exit_code_) kill(pid_, signal_number);
}

std::optional<int> Process::wait(Wait patience) {
  eventually(
      [this] {
        int status = 0;
        if (!exit_code_ && waitpid(pid_, &status, WNOHANG) == pid_)
          exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return exit_code_.has_value();
      },
      patience);
  return exit_code_;
}

std::string Process::output() const { return text_of(output_); }
std::string Process::errors() const { return text_of(errors_); }

Finished run(const Words& command, const Environment& environment, Wait patience) {
  Process process(command, environment);
  const int exit_code = process.wait(patience).value_or(-1);
  return {exit_code, process.output(), process.errors()};
}

Finished understudy(Words arguments, const Environment& environment) {
  arguments.insert(arguments.begin(), UNDERSTUDY_BINARY);
  return run(arguments, environment);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

RunningUnderstudy::RunningUnderstudy(const Words& flags, const Environment& environment) {
  start({UNDERSTUDY_BINARY, "serve", "--model", "simple2-r3", "--link", folder_ / "port"}, flags,
        environment);
}

RunningUnderstudy::RunningUnderstudy(FromModel, const std::string& model, const Words& flags) {
  start({UNDERSTUDY_BINARY, "serve", "--model", model, "--link", folder_ / "port"}, flags, {});
}

std::unique_ptr<RunningUnderstudy> RunningUnderstudy::of_model(const std::string& model, const Words& flags) {
  return std::unique_ptr<RunningUnderstudy>(new RunningUnderstudy(FromModel{}, model, flags));
}

RunningUnderstudy::RunningUnderstudy(FromBench, const std::string& yaml, const Words& flags) {
  start({UNDERSTUDY_BINARY, "serve", folder_.write("bench.yaml", yaml)}, flags, {});
}

std::unique_ptr<RunningUnderstudy> RunningUnderstudy::of_bench(const std::string& yaml, const Words& flags) {
  return std::unique_ptr<RunningUnderstudy>(new RunningUnderstudy(FromBench{}, yaml, flags));
}

void RunningUnderstudy::start(Words command, const Words& flags, const Environment& environment) {
  command.insert(command.end(), {"--control", control()});
  command.insert(command.end(), flags.begin(), flags.end());
  process_ = std::make_unique<Process>(command, environment);
  const bool ready = eventually([this] {
    const std::string printed = process_->output();
    return printed.ends_with('\n') || process_->wait(Wait(0)).has_value();
  });
  for (const std::string& line : lines_of(process_->output())) {
    std::istringstream words(line);
    std::string word;
    Port port;
    if (words >> word >> port.line >> port.pty >> port.link && word == "ready") ports_.push_back(port);
  }
  if (!ready || ports_.empty())
    throw std::runtime_error("not ready: " + process_->output() + process_->errors());
}

RunningUnderstudy::~RunningUnderstudy() {
  if (stopped_) return;
  EXPECT_EQ(stop(SIGTERM), 0) << errors();
}

std::optional<int> RunningUnderstudy::stop(int signal_number) {
  stopped_ = true;
  process_->send(signal_number);
  return process_->wait(kPatience);
}

Finished RunningUnderstudy::ctl(const Words& words) const {
  Words arguments{"ctl", "--control", control()};
  arguments.insert(arguments.end(), words.begin(), words.end());
  return understudy(arguments);
}

int RunningUnderstudy::requests() const {
  const std::string status = ctl({"status"}).output;
  std::smatch found;
  return std::regex_search(status, found, std::regex("(\\d+) requests")) ? std::stoi(found[1]) : -1;
}

}  // namespace understudy::acceptance
