// Writes the findings of `hunt` to files.
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

/// Plays the scenario of a finding like `run` or `exec`, and writes its recording and page next to it. `path`
/// has no extension. Throws GrowingFileError.
std::vector<play::ScenarioResult> show_finding(ModelList models, const HuntArguments& arguments,
                                               const std::string& path,
                                               const std::vector<std::string>& command);

/// Stores findings in a folder, and reports them to the user.
class FoundFiles {
 public:
  /// Creates the folder, to check that it can be written. Throws UsageError and GrowingFileError.
  FoundFiles(ModelList models, const HuntArguments& arguments, FileClaims claims);
  /// Removes the folder if it was created but not used.
  ~FoundFiles();
  FoundFiles(const FoundFiles&) = delete;
  FoundFiles& operator=(const FoundFiles&) = delete;

  /// Plays courses with `hosts` beside a command from now on. `hosts` must outlive this object.
  void show_with(HuntHosts& hosts) { hosts_ = &hosts; }
  /// Writes and prints a finding. Does not overwrite an edited file. Throws GrowingFileError.
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
  HuntHosts* hosts_ = nullptr;       // null: courses are played without a command
  std::vector<std::string> made_{};  // the folders that were created, innermost first
};

}  // namespace understudy::emulator::command_line
