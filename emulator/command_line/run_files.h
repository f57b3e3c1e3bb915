// Manages the files that `run` writes for each scenario: recordings, traces, captures. They are spooled below
// /tmp, then kept in the user's folders.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/files/descriptor.h"
#include "base/files/file_claims.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/ports/private_folder.h"

namespace understudy::emulator::command_line {

/// The folders for the files of each scenario. `run` creates them if necessary. An empty path means no files.
struct RunFolders {
  std::string recordings;  // the folder for all recordings; empty: only first failures are recorded
  std::string failures;    // the folder for recordings of first failures; empty: below /tmp
  std::string traces;
  std::string captures;
  std::vector<std::string> trace_also;
};

/// Throws UsageError for folders with files that would overwrite files that the command reads or writes, and
/// for paths that cannot be folders.
void require_folders(const FileClaims& claims, const RunFolders& folders);

/// How failures are recorded.
enum class Recorded : std::uint8_t {
  again,   // a varied case runs once more to be recorded
  always,  // every case is recorded, because a case cannot run again
  apart,   // the run creates its own recording
};

class RunFiles {
 public:
  /// No claimed file is overwritten, even through a link in a folder. Throws pty::PortError and
  /// std::system_error.
  RunFiles(RunFolders folders, FileClaims claims, Recorded recorded, std::string version);
  ~RunFiles();
  RunFiles(const RunFiles&) = delete;
  RunFiles& operator=(const RunFiles&) = delete;

  /// Returns observers that write the files for a scenario's run, or for one of its branches. May be called
  /// on any thread.
  std::vector<play::ObserverMaker> observers(const play::Scenario& scenario);
  play::ObserverMaker recorder(const play::Scenario& scenario);
  /// Returns the path for a new file, which settle() keeps or removes.
  std::string next_spool(const std::string& ending);
  /// Keeps the files under the result's name, or removes them, and stores their paths in the result. Call
  /// this in the order of the results, which determines the names of results with the same name. `is_new`
  /// marks the first failure of its kind.
  void settle(play::ScenarioResult& result, bool is_new);

 private:
  std::string free_name(const play::ScenarioResult& result);

  RunFolders folders_;
  FileClaims claims_;
  Recorded recorded_;
  std::string version_;
  serve::PrivateFolder private_folder_;
  Descriptor lock_;    // locks the spool during the owner's lifetime
  std::string spool_;  // a folder in the private folder
  std::atomic<int> count_ = 0;
  std::set<std::string> names_;  // the used names
};

}  // namespace understudy::emulator::command_line
