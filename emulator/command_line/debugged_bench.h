// Starts programs for a debug adapter.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "base/files/descriptor.h"

namespace understudy::emulator::command_line {

/// Runs this program in another process that ends with this one and logs to a file in memory.
class QuietProgram {
 public:
  explicit QuietProgram(std::vector<std::string> words);
  ~QuietProgram() { end(); }
  QuietProgram(const QuietProgram&) = delete;
  QuietProgram& operator=(const QuietProgram&) = delete;

  void end();
  /// Returns the exit code, or nothing while the program is running.
  std::optional<int> ended();
  /// Returns the complete lines that the program has logged since the last call.
  std::string news();

 private:
  Descriptor messages_;
  off_t returned_bytes_ = 0;  // how many bytes news() has returned
  pid_t pid_ = -1;
};

/// Runs a scenario until it ends or fails, and keeps the recording.
class RecordedScenario {
 public:
  /// Throws dap::RequestError if the scenario cannot be run, or has several cases.
  explicit RecordedScenario(const std::string& scenario);
  ~RecordedScenario();
  RecordedScenario(const RecordedScenario&) = delete;
  RecordedScenario& operator=(const RecordedScenario&) = delete;

  const std::string& recording() const { return recording_; }

 private:
  void find_recording();

  std::string folder_;  // removed at the end
  std::string recording_;
};

class DebuggedBench {
 public:
  /// Runs `understudy WORDS --control SOCKET`, and returns when the program answers on that socket. If it
  /// ends before that, throws dap::RequestError with its message.
  DebuggedBench(std::vector<std::string> words, const std::string& socket);

  void end() { program_.end(); }
  std::string news() { return program_.news(); }

 private:
  QuietProgram program_;
};

}  // namespace understudy::emulator::command_line
