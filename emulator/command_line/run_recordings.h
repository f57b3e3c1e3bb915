// The recordings that `run` makes of everything it plays: spooled below /tmp, and kept where they are wanted.
#pragma once

#include <atomic>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "emulator/edge/private_folder.h"
#include "emulator/scenario/onlooker.h"
#include "emulator/scenario/scenario.h"
#include "pty/descriptor.h"

namespace understudy::emulator {

class RunRecordings {
 public:
  /// All are kept in `folder`, which is made; without one those of failures, below /tmp. Throws
  /// pty::PortError and std::system_error.
  RunRecordings(std::string folder, bool real_time, std::string version);
  ~RunRecordings();
  RunRecordings(const RunRecordings&) = delete;
  RunRecordings& operator=(const RunRecordings&) = delete;

  /// Of a scenario's play or of one of its branches. From any thread.
  std::unique_ptr<Onlooker> record(World& world, const Scenario& scenario);
  /// Keeps the recording, under the result's name, or removes it; ScenarioResult::recording says where it is.
  /// To be called in the order of the results, which decides between equal names.
  void settle(ScenarioResult& result);
  /// What the names of the files in the folder end in.
  static std::vector<std::string> file_endings();

 private:
  std::string free_name(const std::string& name);

  std::string folder_;
  bool real_time_;
  std::string version_;
  PrivateFolder private_folder_;
  pty::Descriptor lock_;  // on the spool: it has an owner who lives
  std::string spool_;     // a folder in that one
  std::atomic<int> count_ = 0;
  std::set<std::string> names_;  // that are taken
};

}  // namespace understudy::emulator
