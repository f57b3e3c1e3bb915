// A process to measure: started on a chosen processor, and observed from outside.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace understudy::benchmarks {

using Nanoseconds = std::chrono::nanoseconds;

/// The benchmark cannot be run here; says why.
struct CannotRun : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Nanoseconds now();

/// Runs the calling process on this processor only.
void pin_to(int processor);
/// Two processors this process may run on: the client's and the servers'. Throws CannotRun.
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
  /// Forks and executes; its standard output can be read from here.
  static Process of_command(const std::vector<std::string>& command, int processor = kAnyProcessor);

  ~Process();
  Process(Process&& other) noexcept;
  Process& operator=(Process&&) = delete;

  /// Processor time of all its threads so far.
  Nanoseconds processor_time() const;
  /// Returns one line of its standard output, without the line end. Throws CannotRun if it ends before.
  std::string read_line();

  void stop() const;       // it takes no processor time until
  void carry_on() const;   // it continues
  void terminate() const;  // SIGTERM
  /// Waits for its end: the exit code, or 128 and the signal.
  int wait();

 private:
  Process(pid_t pid, int output) : pid_(pid), output_(output) {}
  pid_t pid_ = -1;
  int output_ = -1;
};

}  // namespace understudy::benchmarks
