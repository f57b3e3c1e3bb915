// A daemon that a debug adapter has started: this program, run again.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "base/files/descriptor.h"

namespace understudy::emulator::command_line {

class DebuggedBench {
 public:
  /// Runs `understudy WORDS --control SOCKET`, and returns when it answers there. Throws dap::RequestError
  /// with what it said if it ends before.
  DebuggedBench(std::vector<std::string> words, const std::string& socket);
  ~DebuggedBench() { end(); }
  DebuggedBench(const DebuggedBench&) = delete;
  DebuggedBench& operator=(const DebuggedBench&) = delete;

  void end();
  /// Returns the whole lines that it has logged since the last call.
  std::string news();

 private:
  void start(std::vector<std::string>& words);

  Descriptor said_;  // a file in memory
  off_t told_ = 0;   // of its bytes
  pid_t pid_ = -1;
};

}  // namespace understudy::emulator::command_line
