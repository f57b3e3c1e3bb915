#include "benchmarks/process.h"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace understudy::benchmarks {

namespace {

CannotRun failed(const std::string& what) {
  return CannotRun(what + ": " + std::generic_category().message(errno));
}

Nanoseconds duration(const timespec& time) {
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// Prepares the child after the fork.
void settle(int processor) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (processor != Process::kAnyProcessor) pin_to(processor);
}

}  // namespace

Nanoseconds now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return duration(time);
}

void pin_to(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(processor), &set);
  if (sched_setaffinity(0, sizeof set, &set) != 0) throw failed("sched_setaffinity");
}

Processors two_processors() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) throw failed("sched_getaffinity");
  std::vector<int> allowed;
  for (int i = 0; i < CPU_SETSIZE && allowed.size() < 2; ++i) {
    if (CPU_ISSET(static_cast<std::size_t>(i), &set)) allowed.push_back(i);
  }
  if (allowed.size() < 2) throw CannotRun("one processor only; expected two, for the client and the server");
  return {.client = allowed[0], .server = allowed[1]};
}

Process Process::of_function(const std::function<void()>& body, int processor) {
  const pid_t pid = fork();
  if (pid < 0) throw failed("fork");
  if (pid == 0) {
    try {
      settle(processor);
      body();
    } catch (...) {
      _exit(1);
    }
    _exit(0);
  }
  return {pid, -1};
}

Process Process::of_command(const std::vector<std::string>& command, int processor) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) throw failed("pipe");
  const pid_t pid = fork();
  if (pid < 0) throw failed("fork");
  if (pid == 0) {
    try {
      settle(processor);
    } catch (...) {
      _exit(127);
    }
    dup2(pipe_ends[1], STDOUT_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  close(pipe_ends[1]);
  return {pid, pipe_ends[0]};
}

Process::Process(Process&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), output_(std::exchange(other.output_, -1)) {}

Process::~Process() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (output_ >= 0) close(output_);
}

Nanoseconds Process::processor_time() const {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(pid_, &clock) != 0 || clock_gettime(clock, &time) != 0) {
    throw CannotRun("a process under measurement has ended");
  }
  return duration(time);
}

std::string Process::read_line() {
  std::string line;
  for (char character = 0; read(output_, &character, 1) == 1;) {
    if (character == '\n') return line;
    line += character;
  }
  throw CannotRun("a process under measurement has ended before it was ready");
}

void Process::stop() const { kill(pid_, SIGSTOP); }

void Process::carry_on() const { kill(pid_, SIGCONT); }

void Process::terminate() const { kill(pid_, SIGTERM); }

int Process::wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace understudy::benchmarks
