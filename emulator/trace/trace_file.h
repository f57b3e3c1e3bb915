// A trace as a file that grows while a world runs, in the format that its name says.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "emulator/growing_file.h"
#include "emulator/trace/trace.h"

namespace understudy::emulator {

/// Whether a path is that of a trace: FILE.csv or FILE.vcd.
bool is_trace_name(const std::string& path);

class TraceFile {
 public:
  /// What trace_signals() has. The world must outlive it. `log` gets a word if the trace ends early. Throws
  /// NameError (nothing is opened then) and GrowingFileError.
  TraceFile(World& world, const std::string& path, const std::vector<std::string>& also,
            std::function<void(const std::string&)> log);

 private:
  TraceFile(World& world, const std::string& path, std::vector<TraceSignal> signals,
            std::function<void(const std::string&)> log);

  GrowingFile file_;
  Trace trace_;  // last: it ends before its file does
};

}  // namespace understudy::emulator
