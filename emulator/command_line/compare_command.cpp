// Implements `compare`: plays captures against a bench, and judges each reply.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/choices.h"
#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/text/one_line.h"
#include "emulator/box/calibrate/calibration.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/box/compare/drift.h"
#include "emulator/box/compare/judge.h"
#include "emulator/box/compare/replay_bench.h"
#include "emulator/command_line/box_bench.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/compare_report.h"
#include "emulator/command_line/findings.h"
#include "emulator/command_line/interruption.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/result_file.h"
#include "emulator/command_line/terminal.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_bank.h"

namespace understudy::emulator::command_line {

namespace {

using Report = nlohmann::ordered_json;

/// The number of exchanges that are kept from the beginning of a capture, to search for drift and options.
constexpr std::size_t kHeld = 100'000;
/// With few samples, late replies in a growing capture are detected soon.
constexpr std::size_t kFollowedSamples = 20;

/// Judges exchanges while they are read. Keeps one exchange, because its reply may arrive at any time before
/// the next request.
class StreamedComparison {
 public:
  StreamedComparison(const BoxBench& box, const box::CompareSettings& settings, std::size_t delay_samples,
                     box::ReplyTimes::Sink sink)
      : bench_(box.bench), settings_(settings), times_(settings.tolerance, delay_samples, std::move(sink)) {}

  void add(box::Exchange exchange, const box::CaptureNotes& notes,
           const std::vector<box::InputChange>& inputs) {
    if (!comparer_) comparer_.emplace(bench_, settings_, notes, inputs, exchange.at, box::Extent::whole);
    if (waiting_) judge(exchange.at, false);
    waiting_ = std::move(exchange);
  }
  void finish() {
    if (waiting_) judge(std::nullopt, true);
    times_.finish();
  }
  SimTime usual_delay() const { return times_.usual_delay(); }
  std::set<std::string> taken_inputs() const {
    return comparer_ ? comparer_->taken_inputs() : std::set<std::string>();
  }

 private:
  void judge(std::optional<SimTime> next, bool is_last) {
    box::Judgement judgement = comparer_->judge(*waiting_, next, is_last);
    times_.add(*std::exchange(waiting_, std::nullopt), std::move(judgement));
  }

  const world::Bench& bench_;
  const box::CompareSettings& settings_;
  box::ReplyTimes times_;
  std::optional<box::Comparer> comparer_;
  std::optional<box::Exchange> waiting_;
};

/// Returns the manual's section about the first register of a request.
std::string section_of(const BoxBench& box, const box::Exchange& exchange) {
  const auto asked = box::addressed_by(exchange.request);
  const box::ReplayBench replay(box.bench, box.settings.line);
  const RegisterBank* const bank = asked ? replay.bank_of(exchange.request) : nullptr;
  if (bank == nullptr) return "";
  const Place place = bank->at(asked->table, asked->first);
  return place ? std::string(place.row->section) : "";
}

Remedy remedy_of(const BoxBench& box, const box::Hypothesis& hypothesis) {
  const auto& [key, option] = *hypothesis.begin();
  Remedy remedy{.text = choice_text(box.bench, key.device, box::choice_id(box.bench, key)) + ": " +
                        box::option_name(box.bench, key, option),
                .section = {},
                .question = {}};
  if (key.row == box::ChoiceKey::kFirmware) return remedy;
  const ChoiceRow& row = box.bench.devices[key.device].model->choices[key.row];
  remedy.section = std::string(row.section);
  remedy.question = std::string(row.question);
  return remedy;
}

/// How far a comparison is. The line of progress reads it on another thread.
struct CompareTally {
  enum class Phase : std::uint8_t { comparing, fitting_the_clock, trying_options };
  std::atomic<Phase> phase = Phase::comparing;
  std::atomic<std::size_t> compared = 0;  // exchanges of all captures
  box::CalibrateTally options{};
};

/// Returns the line of progress, which should fit into 80 columns.
std::string progress_of(const CompareTally& tally, double seconds) {
  char rate[32];
  std::snprintf(rate, sizeof rate, ", %.0f/s",
                seconds > 0 ? static_cast<double>(tally.compared) / seconds : 0);
  switch (tally.phase) {
    case CompareTally::Phase::comparing: break;
    case CompareTally::Phase::fitting_the_clock: return "they differ; trying another speed of the clock";
    case CompareTally::Phase::trying_options:
      return "they differ; trying other options: " + std::to_string(tally.options.tried.load()) + " of " +
             std::to_string(tally.options.planned.load());
  }
  return std::to_string(tally.compared.load()) + " exchanges" + rate;
}

/// Reads the capture once, and once more if the controller's clock turns out to be off. If the user
/// interrupts it, it returns what was compared by then.
CaptureComparison compare_one(ModelList models, const BoxBench& box, const std::string& path,
                              CompareTally& tally) {
  box::CompareSettings settings = box.settings;
  box::Capture head{.path = path, .line = {}, .exchanges = {}};
  const auto read = [&] {
    CaptureComparison compared(path);
    StreamedComparison streamed(box, settings, box::kDelaySamples,
                                [&](const box::Exchange& exchange, const box::Judgement& judgement) {
                                  compared.add(exchange, judgement);
                                });
    const bool is_first = head.exchanges.empty();
    tally.phase = CompareTally::Phase::comparing;
    compared.notes = take_exchanges(models, box, path,
                                    [&](box::Exchange exchange, const box::CaptureNotes& notes,
                                        const std::vector<box::InputChange>& inputs) {
                                      if (is_first && head.exchanges.empty()) head.inputs = inputs;
                                      if (is_first && head.exchanges.size() < kHeld)
                                        head.exchanges.push_back(exchange);
                                      head.is_cut = head.is_cut || head.exchanges.size() == kHeld;
                                      streamed.add(std::move(exchange), notes, inputs);
                                      ++tally.compared;
                                    });
    streamed.finish();
    compared.is_interrupted = is_interrupted();
    compared.usual_delay = streamed.usual_delay();
    compared.taken_inputs = streamed.taken_inputs();
    compared.drift_ppm = settings.drift_ppm;
    return compared;
  };
  CaptureComparison compared = read();
  if (!compared.is_different() || compared.is_interrupted) return compared;
  head.notes = compared.notes;
  tally.phase = CompareTally::Phase::fitting_the_clock;
  settings.drift_ppm = box::fit_drift(box.bench, head, settings, is_interrupted);
  if (settings.drift_ppm != 0) compared = read();
  if (!compared.is_different() || compared.is_interrupted) return compared;
  compared.has_searched = compared.first_number() < head.exchanges.size();
  if (!compared.has_searched) return compared;
  compared.first_section = section_of(box, head.exchanges[compared.first_number()]);
  tally.options.tried = tally.options.planned = 0;
  tally.phase = CompareTally::Phase::trying_options;
  for (const box::Hypothesis& one :
       box::remedies(box.bench, head, compared.first_number(), {.compare = settings},
                     {.is_over = is_interrupted, .tally = &tally.options}))
    compared.remedies.push_back(remedy_of(box, one));
  compared.is_interrupted = is_interrupted();
  return compared;
}

/// Reports each reply that is neither identical nor undecidable, as soon as the next request arrives.
int follow_capture(const BoxBench& box, const CompareArguments& arguments) {
  if (arguments.captures.size() != 1)
    throw UsageError("compare: --follow follows one capture; expected one CAPTURE");
  watch_for_interruption();
  const std::string& path = arguments.captures.front();
  CaptureComparison compared(path);
  StreamedComparison streamed(
      box, box.settings, kFollowedSamples,
      [&](const box::Exchange& exchange, const box::Judgement& judgement) {
        compared.add(exchange, judgement);
        using enum box::Verdict;
        if (judgement.verdict == same || judgement.verdict == within || judgement.verdict == undecidable)
          return;
        std::printf("%s\n", CaptureComparison::line_of(
                                path, {.place = exchange.place, .at = exchange.at, .judgement = judgement})
                                .c_str());
        std::fflush(stdout);
      });
  compared.notes = follow_exchanges(
      box, path,
      [&](box::Exchange exchange, const box::CaptureNotes& notes,
          const std::vector<box::InputChange>& inputs) { streamed.add(std::move(exchange), notes, inputs); });
  streamed.finish();
  compared.usual_delay = streamed.usual_delay();
  compared.taken_inputs = streamed.taken_inputs();
  compared.has_searched = false;
  std::fputs(compared.text().c_str(), stdout);
  return compared.is_different() ? kExitFailed : kExitWell;
}

}  // namespace

int compare_captures(ModelList models, const CompareArguments& arguments) {
  const auto format = finding_format_called(arguments.format);
  if (!format)
    throw UsageError("--format: " + quoted(arguments.format) +
                     " is not a format; expected text, json, sarif or github");
  const BoxBench box = read_box_bench(models, "compare", arguments);
  if (arguments.follow) return follow_capture(box, arguments);
  FileClaims claims;
  claims.add({arguments.bench, "the bench itself"});
  for (const std::string& path : arguments.captures) claims.add({path, "an input capture"});
  ResultFile page("--report", require_output(claims, "--report", arguments.report), ContentKind::page);
  // Reading a pipe ends only when its writer does, so Ctrl-C must end the program.
  const auto is_file = [](const std::string& path) { return std::filesystem::is_regular_file(path); };
  if (std::ranges::all_of(arguments.captures, is_file)) watch_for_interruption();
  std::vector<CaptureComparison> all;
  bool is_different = false;
  for (const std::string& path : arguments.captures) {
    if (is_interrupted()) break;
    {
      CompareTally tally;
      const ProgressLine progress([&](double seconds) { return progress_of(tally, seconds); });
      all.push_back(compare_one(models, box, path, tally));
    }
    is_different = is_different || all.back().is_different() || all.back().is_interrupted;
    if (*format == FindingFormat::text) std::fputs(all.back().text().c_str(), stdout);
  }
  if (*format == FindingFormat::json) {
    Report report = Report::array();
    for (const CaptureComparison& one : all) report.push_back(one.json());
    std::printf("%s\n", report.dump(1, ' ', false, Report::error_handler_t::replace).c_str());
  } else if (*format != FindingFormat::text) {
    std::vector<CheckedFile> findings;
    for (const CaptureComparison& one : all) findings.push_back(one.findings());
    std::fputs(findings_as(*format, findings).c_str(), stdout);
  }
  if (page.is_wanted()) page.replace(compare_page(all, arguments.bench, arguments.version));
  return is_different ? kExitFailed : kExitWell;
}

}  // namespace understudy::emulator::command_line
