// The files that `run` makes of everything it plays: recordings, traces, captures. Spooled below /tmp, and
// kept where they are wanted.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/files/descriptor.h"
#include "base/files/file_claims.h"
#include "emulator/play/performing/onlooker.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/ports/private_folder.h"

namespace understudy::emulator::command_line {

/// What is wanted of each play. Folders are made; an empty path means none.
struct RunFolders {
  std::string recordings;  // of all; if empty, those of failures are kept, the first of each kind:
  std::string failures;    // here, or, if empty, below /tmp
  std::string traces;
  std::string captures;
  std::vector<std::string> trace_also;
};

/// Throws UsageError for folders whose files would overwrite what the command reads or writes, and for paths
/// that cannot be folders.
void demand_folders(const FileClaims& claims, const RunFolders& folders);

class RunFiles {
 public:
  /// Nothing that is claimed is overwritten, wherever a link in a folder leads. Throws pty::PortError and
  /// std::system_error.
  RunFiles(RunFolders folders, FileClaims claims, bool real_time, std::string version);
  ~RunFiles();
  RunFiles(const RunFiles&) = delete;
  RunFiles& operator=(const RunFiles&) = delete;

  /// Onlookers that make them of a scenario's play, or of one of its branches. May be called from any thread.
  std::vector<play::OnlookerMaker> onlookers(const play::Scenario& scenario);
  play::OnlookerMaker recorder(const play::Scenario& scenario);
  /// Keeps the files, under the result's name, or removes them; the result says where they are. To be called
  /// in the order of the results, which decides between equal names. `is_new`: it is the first failure of its
  /// kind.
  void settle(play::ScenarioResult& result, bool is_new);

 private:
  std::string next_spool(const std::string& ending);
  std::string free_name(const play::ScenarioResult& result);

  RunFolders folders_;
  FileClaims claims_;
  bool real_time_;
  std::string version_;
  serve::PrivateFolder private_folder_;
  Descriptor lock_;    // on the spool: locked: its owner is alive
  std::string spool_;  // a folder in that one
  std::atomic<int> count_ = 0;
  std::set<std::string> names_;  // that are taken
};

}  // namespace understudy::emulator::command_line
