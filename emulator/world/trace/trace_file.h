// Writes a trace to a file while a world runs. The name of the file determines the format.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/files/growing_file.h"
#include "emulator/world/trace/trace.h"

namespace understudy::emulator::world {

/// Returns true if a path is that of a trace file: FILE.csv or FILE.vcd.
bool is_trace_name(const std::string& path);

class TraceFile {
 public:
  /// Opens the file; its old content stays until begin(). The trace has the signals of trace_signals(). `log`
  /// receives a line if the trace ends early. The world must outlive this object. Throws NameError (before
  /// anything is opened) or GrowingFileError.
  TraceFile(World& world, const std::string& path, const std::vector<std::string>& also,
            std::function<void(const std::string&)> log);

  /// Starts at this moment. Throws GrowingFileError.
  void begin();
  /// Writes the end and waits until everything is written. Returns why the file ended early, or an empty
  /// string if it did not.
  std::string finish();

 private:
  World& world_;
  std::vector<TraceSignal> signals_;
  bool is_vcd_;
  GrowingFile file_;
  std::unique_ptr<Trace> trace_;  // the last member, because the trace must end before its file
};

}  // namespace understudy::emulator::world
