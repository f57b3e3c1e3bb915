// Reports the results of a run case by case: verdicts for the user, JUnit, result rows, a page. Keeps only
// counts and the first failure of each kind, however many cases there are.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/run_files.h"
#include "emulator/command_line/terminal.h"
#include "emulator/device/model.h"
#include "emulator/play/results/failure_kinds.h"
#include "emulator/play/results/junit.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"
#include "emulator/play/results/results_file.h"

namespace understudy::emulator::command_line {

class RunAccount {
 public:
  /// Opens the result files. Throws UsageError and GrowingFileError.
  RunAccount(ModelList models, const RunArguments& arguments);

  /// Returns true if the result files already contain this case. It need not run again, and counts as left
  /// out. May be called on any thread, but not concurrently.
  bool was_played(const play::CaseKey& key);
  /// Empties the files, unless the run appends to them.
  void begin();
  /// Adds the results of one case. Call this in the order of the cases. `again` runs the case once more with
  /// a recorder; `files` keeps its files.
  void add(std::vector<play::ScenarioResult> results, std::uint64_t made_of, RunFiles& files,
           ProgressLine& progress, const std::function<std::vector<play::ScenarioResult>()>& again);
  /// Prints and writes the final reports.
  void finish();

  play::Junit* junit() { return junit_ ? &*junit_ : nullptr; }
  /// Returns the page. `programs` is the section about programs; it may be empty.
  std::string report(std::string_view programs) const;
  int exit_code() const;

 private:
  /// Returns true if the result is the first failure of its kind.
  bool add_one(play::ScenarioResult& result, RunFiles& files, ProgressLine& progress,
               const std::function<std::vector<play::ScenarioResult>()>& again);
  void note_skipped(const play::ScenarioResult& result);
  void note_lint_findings(const play::ScenarioResult& result);

  ModelList models_;
  const RunArguments& arguments_;
  std::FILE* out_;
  std::vector<std::unique_ptr<play::ResultsFile>> rows_;
  std::uint64_t left_out_ = 0;  // cases that were played before
  std::uint64_t left_out_failed_ = 0;
  play::Tally tally_;
  play::FailureKinds kinds_;
  std::optional<play::Junit> junit_;
  std::vector<play::ScenarioResult> shown_;  // the results on the page
  std::vector<std::string> lint_findings_;   // lines
  struct SkippedStep {
    std::string place;  // "grid.yaml:17"
    std::string why;
    std::uint64_t count = 1;
  };
  std::vector<SkippedStep> skipped_;           // steps of cases that `vary` made
  std::set<std::string> known_lint_findings_;  // lint findings of cases that `vary` made
};

}  // namespace understudy::emulator::command_line
