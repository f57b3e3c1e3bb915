// A trace as a file that grows while a world runs, in the format that its name says.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/files/growing_file.h"
#include "emulator/world/trace/trace.h"

namespace understudy::emulator::world {

/// Whether a path is that of a trace: FILE.csv or FILE.vcd.
bool is_trace_name(const std::string& path);

class TraceFile {
 public:
  /// Opens it; what is there stays until begin(). It will hold what trace_signals() returns; `log` gets a
  /// line if it ends early. The world must outlive it. Throws NameError (nothing is opened then) and
  /// GrowingFileError.
  TraceFile(World& world, const std::string& path, const std::vector<std::string>& also,
            std::function<void(const std::string&)> log);

  /// From this moment on. Throws GrowingFileError.
  void begin();
  /// Writes its end and waits until all is written. Returns why it has ended early, or nothing.
  std::string finish();

 private:
  World& world_;
  std::vector<TraceSignal> signals_;
  bool is_vcd_;
  GrowingFile file_;
  std::unique_ptr<Trace> trace_;  // last: it ends before its file does
};

}  // namespace understudy::emulator::world
