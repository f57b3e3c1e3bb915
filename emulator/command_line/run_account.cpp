#include "emulator/command_line/run_account.h"

#include <algorithm>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/failure_story.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/on_box.h"
#include "emulator/command_line/result_file.h"
#include "emulator/command_line/run_files.h"
#include "emulator/command_line/terminal.h"
#include "emulator/play/report/page.h"
#include "emulator/play/results/failure_kinds.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"
#include "emulator/play/results/results_file.h"

namespace understudy::emulator::command_line {

namespace {

constexpr std::size_t kMaxShown = 1000;         // cases on a page, besides the first failures of each kind
constexpr std::size_t kMaxSkipped = 100;        // lines
constexpr std::size_t kMaxLintFindings = 1000;  // lines

using RunVerdict = play::ScenarioResult::Verdict;

void print(const play::ScenarioResult& result, bool with_hash, std::FILE* to) {
  std::fprintf(to, "%s\n", coloured_verdict(play::verdict_line(result), wants_colour(fileno(to))).c_str());
  if (with_hash && result.verdict != RunVerdict::not_reached && result.verdict != RunVerdict::not_tellable) {
    std::fprintf(to, "hash %s %016" PRIx64 "\n", one_line(result.name).c_str(), result.outcome_hash);
  }
  for (const std::string& line : play::skipped_lines(result)) std::fprintf(to, "      %s\n", line.c_str());
  for (const std::string& line : play::failure_lines(result)) std::fprintf(to, "      %s\n", line.c_str());
}

std::unique_ptr<play::ResultsFile> open_results(const std::string& path, bool continues) {
  if (path.ends_with(play::kJsonLinesEnding)) return play::open_json_lines(path, continues);
  if (path.ends_with(play::kSqliteEnding)) return play::open_sqlite(path, continues);
  throw UsageError("--results: " + path + ": has an unknown format; expected FILE.jsonl or FILE.sqlite");
}

}  // namespace

RunAccount::RunAccount(ModelList models, const RunArguments& arguments)
    : models_(models),
      arguments_(arguments),
      // If results are printed to standard output, text for people is printed to standard error.
      out_(arguments.junit == kStandardOutput ? stderr : stdout) {
  for (const std::string& path : arguments.results) rows_.push_back(open_results(path, arguments.resume));
  if (!arguments.junit.empty()) junit_.emplace();
}

bool RunAccount::was_played(const play::CaseKey& key) {
  if (!arguments_.resume || rows_.empty()) return false;
  bool has_failed = false;
  for (const auto& rows : rows_) {
    const auto before = rows->has_failed(key);
    if (!before) return false;
    has_failed = has_failed || *before;
  }
  ++left_out_;
  if (has_failed) ++left_out_failed_;
  return true;
}

void RunAccount::begin() {
  if (arguments_.resume) return;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i]->has_rows()) {
      log_line("--results: " + arguments_.results[i] +
               ": replacing the rows of an earlier run; --resume continues it");
    }
    rows_[i]->begin();
  }
}

void RunAccount::add(std::vector<play::ScenarioResult> results, std::uint64_t made_of, RunFiles& files,
                     ProgressLine& progress,
                     const std::function<std::vector<play::ScenarioResult>()>& again) {
  bool has_failed = false;
  std::vector<play::ResultRow> rows;
  const bool has_hash = !arguments_.real_time && !is_on_box(arguments_);
  for (play::ScenarioResult& result : results) {
    const bool is_new = add_one(result, files, progress, again);
    has_failed = has_failed || result.failure;
    if (!rows_.empty()) rows.push_back(play::row_of(result, made_of, has_hash));
    const bool is_shown = is_new || (!result.which.is_varied && shown_.size() < kMaxShown);
    if (!arguments_.report.empty() && is_shown) shown_.push_back(std::move(result));
  }
  for (const auto& file : rows_) file->add(rows);
  progress.one_done(has_failed);
}

bool RunAccount::add_one(play::ScenarioResult& result, RunFiles& files, ProgressLine& progress,
                         const std::function<std::vector<play::ScenarioResult>()>& again) {
  if (arguments_.on.plan) {  // nothing was judged
    for (const std::string& line : play::skipped_lines(result)) std::fprintf(out_, "  %s\n", line.c_str());
    return false;
  }
  const play::FailureKinds::Kind* const kind = result.failure ? kinds_.add(result) : nullptr;
  const bool is_new = kind != nullptr && kind->count == 1;
  const bool may_play_again = arguments_.on.on.empty();  // a real machine must not move just for a recording
  if (is_new && may_play_again && result.recording.empty() && !result.is_unreadable) {
    for (play::ScenarioResult& other : again()) {
      if (other.branch == result.branch) {
        result.recording = std::exchange(other.recording, {});
        result.run_log = other.run_log;
      } else if (!other.recording.empty()) {
        files.settle(other, false);
      }
    }
  }
  files.settle(result, is_new);
  if (kind != nullptr && !is_new && result.recording.empty()) result.like = kind->first;
  if (is_new && !result.recording.empty())
    result.failure->led_to = events_before_failure(models_, result.recording);
  const bool is_one_of_many = result.which.is_varied && !is_new && !arguments_.hash;
  if (!is_one_of_many) {
    progress.above([&] {
      print(result, arguments_.hash, out_);
      std::fflush(out_);
    });
  }
  tally_.add(result);
  if (junit_) junit_->add(result);
  note_lint_findings(result);
  if (is_one_of_many) note_skipped(result);
  return is_new;
}

/// Counts the skipped steps of cases that have no line of their own. The first case's reason stands for all.
void RunAccount::note_skipped(const play::ScenarioResult& result) {
  for (const play::StepResult& step : result.steps) {
    if (step.skipped.empty()) continue;
    const std::string place = step.file + ":" + std::to_string(step.line);
    const auto known = std::ranges::find(skipped_, place, &SkippedStep::place);
    if (known != skipped_.end()) {
      ++known->count;
    } else if (skipped_.size() < kMaxSkipped) {
      skipped_.push_back({.place = place, .why = step.skipped});
    }
  }
}

void RunAccount::note_lint_findings(const play::ScenarioResult& result) {
  for (const std::string& finding : result.lint_findings) {
    if (result.which.is_varied && !known_lint_findings_.insert(result.file + ": " + finding).second) continue;
    if (lint_findings_.size() < kMaxLintFindings)
      lint_findings_.push_back(one_line(result.file + ": " + result.name + ": " + finding));
  }
}

void RunAccount::finish() {
  if (arguments_.on.plan) return;
  for (const auto& file : rows_) file->finish();
  for (const play::FailureKinds::Kind& kind : kinds_.all()) {
    if (kind.varied < 2) continue;
    std::fprintf(out_, "%" PRIu64 " failed in the same way: %s; the first was %s\n", kind.count,
                 one_line(kind.text).c_str(), one_line(kind.first).c_str());
  }
  if (kinds_.others() > 0) {
    std::fprintf(out_, "%" PRIu64 " more failed in other ways than the first %zu kinds\n", kinds_.others(),
                 play::FailureKinds::kMax);
  }
  for (const SkippedStep& step : skipped_) {
    std::fprintf(out_, "skipped in %" PRIu64 " of the cases: %s\n", step.count,
                 one_line(step.place + ": " + step.why).c_str());
  }
  if (left_out_ > 0) {
    std::fprintf(out_, "%" PRIu64 " skipped, because they ran earlier; %" PRIu64 " of them failed\n",
                 left_out_, left_out_failed_);
  }
  std::fprintf(out_, "%s\n", play::summary_line(tally_).c_str());
  for (const std::string& line : lint_findings_) std::fprintf(stderr, "lint: %s\n", line.c_str());
}

std::string RunAccount::report(std::string_view programs) const {
  return play::report_page(shown_, arguments_.version, &tally_, programs);
}

int RunAccount::exit_code() const {
  if (tally_.unreadable > 0) return kExitBadInput;
  return tally_.failed + left_out_failed_ > 0 ? kExitFailed : kExitWell;
}

}  // namespace understudy::emulator::command_line
