// Implements `compare`: plays captures against a bench, and judges each reply.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/calibrate/calibration.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/box/compare/judge.h"
#include "emulator/command_line/box_bench.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/findings.h"
#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

namespace {

using box::Verdict;
using Report = nlohmann::ordered_json;

using VerdictCounts = std::array<std::size_t, box::kVerdictNames.size()>;

VerdictCounts verdict_counts(const box::Comparison& comparison) {
  VerdictCounts counts{};
  for (const box::Judgement& judgement : comparison.judgements)
    ++counts[static_cast<std::size_t>(judgement.verdict)];
  return counts;
}

std::string delay_text(SimTime time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f ms", std::chrono::duration<double, std::milli>(time).count());
  return text;
}

/// Returns "118 same, 1 different".
std::string verdicts_text(const VerdictCounts& counts) {
  std::string text;
  for (const auto& [verdict, name] : box::kVerdictNames) {
    const std::size_t count = counts[static_cast<std::size_t>(verdict)];
    if (count == 0) continue;
    std::string words(name);
    std::ranges::replace(words, '_', ' ');
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + words;
  }
  return text;
}

/// Returns a request in words without the values that it writes: the same for all similar requests.
std::string request_kind(const std::string& request) { return request.substr(0, request.find(" = ")); }

struct Compared {
  box::Comparison comparison;
  double drift_ppm = 0;
  std::vector<std::string> remedies{};  // "feeder.exceptions: no_answer"
};

Compared compare_one(const BoxBench& box, const box::Capture& capture) {
  box::CompareSettings settings = box.settings;
  Compared compared{.comparison = box::compare(box.bench, capture, settings, box::Extent::whole)};
  if (!compared.comparison.first_difference) return compared;
  settings.drift_ppm = compared.drift_ppm = box::fit_drift(box.bench, capture, settings);
  if (compared.drift_ppm != 0)
    compared.comparison = box::compare(box.bench, capture, settings, box::Extent::whole);
  if (!compared.comparison.first_difference) return compared;
  const auto remedies =
      box::remedies(box.bench, capture, *compared.comparison.first_difference, {.compare = settings});
  for (const box::Hypothesis& remedy : remedies) {
    const auto& [key, option] = *remedy.begin();
    compared.remedies.push_back(choice_text(box.bench, key.device, box::choice_id(box.bench, key)) + ": " +
                                box::option_name(box.bench, key, option));
  }
  return compared;
}

/// Counts verdicts by what was asked: function and registers.
std::map<std::string, VerdictCounts> counts_by_kind(const box::Comparison& comparison) {
  std::map<std::string, VerdictCounts> by_kind;
  for (const box::Judgement& judgement : comparison.judgements)
    ++by_kind[request_kind(judgement.request)][static_cast<std::size_t>(judgement.verdict)];
  return by_kind;
}

void print_difference(const box::Capture& capture, const Compared& compared) {
  const std::size_t number = *compared.comparison.first_difference;
  const box::Exchange& exchange = capture.exchanges[number];
  const box::Judgement& judgement = compared.comparison.judgements[number];
  std::printf("  first difference: %s:%zu, at %s\n", capture.path.c_str(), exchange.place,
              format_duration(exchange.at).c_str());
  std::size_t agreed = number;
  while (agreed > 0 && compared.comparison.judgements[agreed - 1].verdict == Verdict::undecidable) --agreed;
  if (agreed > 0)
    std::printf("    last agreement: %s\n",
                one_line(compared.comparison.judgements[agreed - 1].request).c_str());
  std::printf("    request:        %s\n", one_line(judgement.request).c_str());
  std::printf("    controller:     %s\n", one_line(judgement.box).c_str());
  std::printf("    bench:          %s\n", one_line(judgement.bench).c_str());
  for (const std::string& remedy : compared.remedies) std::printf("    it agrees with  %s\n", remedy.c_str());
  if (compared.remedies.empty()) std::printf("    no other option of a single choice agrees with it\n");
}

void print_comparison(const box::Capture& capture, const Compared& compared) {
  const box::Comparison& comparison = compared.comparison;
  std::printf("%s: %zu exchanges: %s\n", capture.path.c_str(), capture.exchanges.size(),
              verdicts_text(verdict_counts(comparison)).c_str());
  for (const std::string& note : notes_text(capture.notes)) std::printf("  %s\n", note.c_str());
  if (compared.drift_ppm != 0)
    std::printf("  the controller's clock is %.0f ppm %s\n", std::abs(compared.drift_ppm),
                compared.drift_ppm > 0 ? "faster than the capture's" : "slower than the capture's");
  if (comparison.usual_delay.count() != 0)
    std::printf("  replies usually come %s after the bench's\n", delay_text(comparison.usual_delay).c_str());
  if (!comparison.first_difference) return;
  print_difference(capture, compared);
  for (const auto& [kind, counts] : counts_by_kind(comparison)) {
    const std::size_t different = counts[static_cast<std::size_t>(Verdict::different)];
    const std::size_t all = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    if (different > 0) std::printf("  %zu of %zu differ: %s\n", different, all, one_line(kind).c_str());
  }
}

Report report_of(const box::Capture& capture, const Compared& compared) {
  const box::Comparison& comparison = compared.comparison;
  Report report{{"capture", capture.path}, {"line", capture.line}, {"exchanges", capture.exchanges.size()}};
  const VerdictCounts counts = verdict_counts(comparison);
  for (const auto& [verdict, name] : box::kVerdictNames)
    report[std::string(name)] = counts[static_cast<std::size_t>(verdict)];
  report["format"] = capture.notes.format;
  report["notes"] = notes_text(capture.notes);
  report["drift_ppm"] = compared.drift_ppm;
  report["usual_delay_ns"] = comparison.usual_delay.count();
  report["first_difference"] = nullptr;
  if (comparison.first_difference) {
    report["first_difference"] = capture.exchanges[*comparison.first_difference].place;
    report["agrees_with"] = compared.remedies;
  }
  report["by_request"] = Report::array();
  for (const auto& [kind, of_kind] : counts_by_kind(comparison)) {
    Report row{{"request", one_line(kind)}};
    for (const auto& [verdict, name] : box::kVerdictNames)
      if (const std::size_t count = of_kind[static_cast<std::size_t>(verdict)]; count != 0)
        row[std::string(name)] = count;
    report["by_request"].push_back(std::move(row));
  }
  report["not_same"] = Report::array();
  for (std::size_t i = 0; i < comparison.judgements.size(); ++i) {
    const box::Judgement& judgement = comparison.judgements[i];
    if (judgement.verdict == Verdict::same) continue;
    report["not_same"].push_back({{"place", capture.exchanges[i].place},
                                  {"at_ns", capture.exchanges[i].at.count()},
                                  {"verdict", box::name_of(judgement.verdict)},
                                  {"request", one_line(judgement.request)},
                                  {"controller", one_line(judgement.box)},
                                  {"bench", one_line(judgement.bench)},
                                  {"later_ns", judgement.later.count()}});
  }
  return report;
}

/// Differences as findings in the capture, for editors and CI services.
CheckedFile findings_in(const box::Capture& capture, const Compared& compared) {
  CheckedFile checked{.file = capture.path, .kind = "capture"};
  const auto& judgements = compared.comparison.judgements;
  for (std::size_t i = 0; i < judgements.size(); ++i) {
    const box::Judgement& judgement = judgements[i];
    const bool is_different = judgement.verdict == Verdict::different;
    if (!is_different && judgement.verdict != Verdict::late && judgement.verdict != Verdict::early) continue;
    std::string text = one_line(judgement.request) + ": controller: " + one_line(judgement.box) +
                       "; bench: " + one_line(judgement.bench);
    if (!is_different)
      text = one_line(judgement.request) + ": the reply is " + std::string(box::name_of(judgement.verdict));
    checked.findings.push_back({.place = {capture.path, static_cast<int>(capture.exchanges[i].place), 0},
                                .text = std::move(text),
                                .is_warning = !is_different});
  }
  if (!compared.comparison.first_difference) checked.is = "a capture that agrees";
  return checked;
}

}  // namespace

int compare_captures(ModelList models, const CompareArguments& arguments) {
  const auto format = finding_format_called(arguments.format);
  if (!format)
    throw UsageError("--format: " + quoted(arguments.format) +
                     " is not a format; expected text, json, sarif or github");
  const BoxBench box = read_box_bench(models, "compare", arguments);
  bool is_different = false;
  Report all = Report::array();
  std::vector<CheckedFile> findings;
  for (const box::Capture& capture : box.captures) {
    const Compared compared = compare_one(box, capture);
    is_different = is_different || compared.comparison.first_difference.has_value();
    switch (*format) {
      case FindingFormat::text: print_comparison(capture, compared); break;
      case FindingFormat::json: all.push_back(report_of(capture, compared)); break;
      case FindingFormat::sarif:
      case FindingFormat::github: findings.push_back(findings_in(capture, compared)); break;
    }
  }
  if (*format == FindingFormat::json) {
    std::printf("%s\n", all.dump(1, ' ', false, Report::error_handler_t::replace).c_str());
  } else if (*format != FindingFormat::text) {
    std::fputs(findings_as(*format, findings).c_str(), stdout);
  }
  return is_different ? kExitFailed : kExitWell;
}

}  // namespace understudy::emulator::command_line
