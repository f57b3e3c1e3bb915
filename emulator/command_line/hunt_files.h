// Writes the findings of `hunt`.
#pragma once

#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "emulator/command_line/commands.h"
#include "emulator/device/model.h"
#include "emulator/hunt/hunt.h"
#include "emulator/play/results/result.h"

namespace understudy::emulator::command_line {

class HuntHosts;  // hunt_hosts.h

/// Plays a scenario that was written about a finding, as `run` or `exec` does, and writes its recording and
/// its page beside it. `path` has no ending. Throws GrowingFileError.
std::vector<play::ScenarioResult> show_finding(ModelList models, const HuntArguments& arguments,
                                               const std::string& path,
                                               const std::vector<std::string>& command);

/// Keeps what is found in a folder, and tells people about it.
class FoundFiles {
 public:
  /// Makes the folder, to learn whether it can be written. Throws UsageError and GrowingFileError.
  FoundFiles(ModelList models, const HuntArguments& arguments, FileClaims claims);
  /// Removes the folder if it was made for nothing.
  ~FoundFiles();
  FoundFiles(const FoundFiles&) = delete;
  FoundFiles& operator=(const FoundFiles&) = delete;

  /// Courses are played beside a command by these processes, which must outlive this object.
  void show_with(HuntHosts& hosts) { hosts_ = &hosts; }
  /// Writes and prints a finding. A file that somebody has edited stays. Throws GrowingFileError.
  void add(const hunt::Finding& finding);

 private:
  std::string path_of(const hunt::Finding& finding) const;
  void require_writable(const std::string& path) const;
  std::string again_with(const hunt::Finding& finding, const std::string& path) const;
  void print(const hunt::Finding& finding, const std::string& path) const;
  void play(const hunt::Finding& finding, const std::string& path);

  ModelList models_;
  const HuntArguments& arguments_;
  FileClaims claims_;
  HuntHosts* hosts_ = nullptr;       // null: no command runs beside courses
  std::vector<std::string> made_{};  // the folders that did not exist, the innermost first
};

}  // namespace understudy::emulator::command_line
