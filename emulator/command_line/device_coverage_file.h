// The file of `--device-coverage`: the parts of devices that were used in any run, by hosts, programs or
// faults.
#pragma once

#include <cstdio>
#include <mutex>
#include <string>

#include "base/files/file_claims.h"
#include "emulator/command_line/result_file.h"
#include "emulator/play/performing/observer.h"
#include "emulator/world/coverage/touched.h"

namespace understudy::emulator::command_line {

/// Claims the file. Throws UsageError if the path does not end like a coverage file.
void require_device_coverage(FileClaims& claims, const std::string& path);

class DeviceCoverageFile {
 public:
  /// Opens the file. Throws GrowingFileError.
  DeviceCoverageFile(const std::string& path, std::string version);

  bool is_wanted() const { return file_.is_wanted(); }
  /// Empties the file, so that its old content is not mistaken for the result of an interrupted run.
  void empty() { file_.empty(); }
  /// Adds the counts of a run. May be called on any thread.
  void add(const world::TouchedReport& report);
  /// Returns an observer that adds the counts of a scenario's run.
  play::ObserverMaker observer();
  /// Writes the file, if one was requested, and prints the largest gaps.
  void write(std::FILE* out);

 private:
  const std::string path_;
  const std::string version_;
  ResultFile file_;
  std::mutex mutex_;
  world::TouchedReport report_;
};

}  // namespace understudy::emulator::command_line
