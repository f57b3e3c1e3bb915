// What a run tells of its results, case by case: verdicts for whoever reads along, JUnit, rows of results, a
// page. Of any number of cases it holds only what is counted, and the first failure of each kind.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/run_files.h"
#include "emulator/command_line/terminal.h"
#include "emulator/play/results/failure_kinds.h"
#include "emulator/play/results/junit.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"
#include "emulator/play/results/results_file.h"

namespace understudy::emulator::command_line {

class RunAccount {
 public:
  /// Opens the files of results. Throws UsageError and GrowingFileError.
  explicit RunAccount(const RunArguments& arguments);

  /// Whether a case is in the files of results already, and nobody needs to play it again: it is counted as
  /// left out. One call at a time, on any thread.
  bool was_played(const play::CaseKey& key);
  /// Empties what a run begins anew.
  void begin();
  /// The results of one case, in the order of the cases. `again` plays it once more, with a recorder; `files`
  /// keeps what is to be kept.
  void add(std::vector<play::ScenarioResult> results, std::uint64_t made_of, RunFiles& files,
           ProgressLine& progress, const std::function<std::vector<play::ScenarioResult>()>& again);
  /// What is told when all is over.
  void finish();

  play::Junit* junit() { return junit_ ? &*junit_ : nullptr; }
  std::string report() const;
  int exit_code() const;

 private:
  /// Whether it is the first failure of its kind.
  bool add_one(play::ScenarioResult& result, RunFiles& files, ProgressLine& progress,
               const std::function<std::vector<play::ScenarioResult>()>& again);
  void note_manners(const play::ScenarioResult& result);

  const RunArguments& arguments_;
  std::FILE* told_;
  std::vector<std::unique_ptr<play::ResultsFile>> rows_;
  std::uint64_t left_out_ = 0;  // cases that were played before
  std::uint64_t left_out_failed_ = 0;
  play::Tally tally_;
  play::FailureKinds kinds_;
  std::optional<play::Junit> junit_;
  std::vector<play::ScenarioResult> shown_;  // on the page
  std::vector<std::string> manners_;         // lines
  std::set<std::string> known_manners_;      // of cases that `vary` made
};

}  // namespace understudy::emulator::command_line
