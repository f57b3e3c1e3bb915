// The files of `hunt`: the findings and the corpus.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "emulator/command_line/commands.h"
#include "emulator/device/model.h"
#include "emulator/hunt/corpus.h"
#include "emulator/hunt/course.h"
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
  /// Throws UsageError if the folder cannot be one. `hosts` is null if no command runs beside courses.
  FoundFiles(ModelList models, const HuntArguments& arguments, FileClaims claims, HuntHosts* hosts);

  /// Writes and prints a finding. Throws GrowingFileError.
  void add(const hunt::Finding& finding);

 private:
  void require_writable(const std::string& path) const;
  std::string again_with(const hunt::Finding& finding, const std::string& path) const;
  void print(const hunt::Finding& finding, const std::string& path) const;
  void play(const hunt::Finding& finding, const std::string& path);

  ModelList models_;
  const HuntArguments& arguments_;
  FileClaims claims_;
  HuntHosts* hosts_;
};

/// The file of `--corpus`: courses that reached something new, and how far each seed has come.
class CorpusFile {
 public:
  /// Reads the file. Throws FileError if it is not a corpus. An empty path: there is none.
  explicit CorpusFile(const std::string& path);

  bool is_wanted() const { return !path_.empty(); }
  std::uint64_t next_course(std::uint64_t seed) const;
  const std::vector<hunt::Course>& courses() const { return courses_; }
  /// Replaces the file. Throws GrowingFileError.
  void write(const hunt::Hunt& hunt, std::uint64_t seed);

 private:
  std::string path_;
  std::map<std::uint64_t, std::uint64_t> next_;  // by seed
  std::vector<hunt::Course> courses_;
};

}  // namespace understudy::emulator::command_line
