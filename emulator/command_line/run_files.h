// The files that `run` makes of everything it plays: recordings, traces, captures. Spooled below /tmp, and
// kept where they are wanted.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "emulator/edge/private_folder.h"
#include "emulator/file_claims.h"
#include "emulator/scenario/onlooker.h"
#include "emulator/scenario/scenario.h"
#include "pty/descriptor.h"

namespace understudy::emulator {

/// What is wanted of each play. Folders are made; an empty one: nothing.
struct RunFolders {
  std::string recordings;  // without one those of failures are kept, below /tmp
  std::string traces;
  std::string captures;
  std::vector<std::string> trace_also;
};

/// Folders whose files would be others that a command reads or writes, or that are no names of folders:
/// UsageError.
void demand_folders(const FileClaims& claims, const RunFolders& folders);

class RunFiles {
 public:
  /// Nothing that is claimed is written over, wherever a link in a folder leads. Throws pty::PortError and
  /// std::system_error.
  RunFiles(RunFolders folders, FileClaims claims, bool real_time, std::string version);
  ~RunFiles();
  RunFiles(const RunFiles&) = delete;
  RunFiles& operator=(const RunFiles&) = delete;

  /// Who makes them of a scenario's play, or of one of its branches. From any thread.
  std::vector<OnlookerMaker> onlookers(const Scenario& scenario);
  /// Keeps the files, under the result's name, or removes them; the result says where they are. To be called
  /// in the order of the results, which decides between equal names.
  void settle(ScenarioResult& result);

 private:
  std::string next_spool(const std::string& ending);
  std::string free_name(const std::string& name);

  RunFolders folders_;
  FileClaims claims_;
  bool real_time_;
  std::string version_;
  PrivateFolder private_folder_;
  pty::Descriptor lock_;  // on the spool: it has an owner who lives
  std::string spool_;     // a folder in that one
  std::atomic<int> count_ = 0;
  std::set<std::string> names_;  // that are taken
};

}  // namespace understudy::emulator
