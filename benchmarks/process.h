// A process to measure, which is started on a chosen processor and observed from outside.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace understudy::benchmarks {

using Nanoseconds = std::chrono::nanoseconds;

/// Thrown if the benchmark cannot run on this machine. The message has the reason.
struct CannotRun : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Nanoseconds now();

/// Restricts the calling process to this processor.
void pin_to(int processor);
/// Two processors that this process may use: one for the client, one for the servers. Throws CannotRun.
struct Processors {
  int client = 0;
  int server = 0;
};
Processors two_processors();

/// A child that is killed with this object, or with its parent.
class Process {
 public:
  static constexpr int kAnyProcessor = -1;

  /// Forks; `body` runs in the child, which ends with it.
  static Process of_function(const std::function<void()>& body, int processor = kAnyProcessor);
  /// Forks and executes a command, whose standard output this process can read.
  static Process of_command(const std::vector<std::string>& command, int processor = kAnyProcessor);

  ~Process();
  Process(Process&& other) noexcept;
  Process& operator=(Process&&) = delete;

  /// Returns the processor time of all its threads so far.
  Nanoseconds processor_time() const;
  /// Returns one line of its standard output, without the line end. Throws CannotRun if the process ends
  /// first.
  std::string read_line();

  void stop() const;       // it uses no processor time until carry_on()
  void carry_on() const;   // it continues
  void terminate() const;  // SIGTERM
  /// Waits for the process to end. Returns the exit code, or 128 + the signal.
  int wait();

 private:
  Process(pid_t pid, int output) : pid_(pid), output_(output) {}
  pid_t pid_ = -1;
  int output_ = -1;
};

}  // namespace understudy::benchmarks
