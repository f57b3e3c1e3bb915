#include "emulator/command_line/compare_report.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/box/compare/judge.h"
#include "emulator/command_line/box_bench.h"
#include "emulator/command_line/findings.h"
#include "emulator/play/report/page_parts.h"

namespace understudy::emulator::command_line {

namespace {

using box::Verdict;
using Json = nlohmann::ordered_json;

/// More differing replies would provide no new information, and a large capture may contain any number of
/// them.
constexpr std::size_t kMaxListedReplies = 10'000;
/// The number of kinds of requests is limited, because all text lines can be different.
constexpr std::size_t kMaxRequestKinds = 4096;

constexpr std::string_view kInterrupted =
    "interrupted: the rest was not compared, and not all options were tried";

std::size_t index_of(Verdict verdict) { return static_cast<std::size_t>(verdict); }

std::string delay_text(SimTime time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f ms", std::chrono::duration<double, std::milli>(time).count());
  return text;
}

std::string spaced_name(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

/// Returns a text such as "118 same, 1 different".
std::string verdicts_text(const VerdictCounts& counts) {
  std::string text;
  for (const auto& [verdict, name] : box::kVerdictNames) {
    const std::size_t count = counts[index_of(verdict)];
    if (count != 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + spaced_name(name);
  }
  return text;
}

/// Returns the text of a request without the written values. It is the same for all similar requests.
std::string kind_of(const std::string& request) { return request.substr(0, request.find(" = ")); }

/// When the question of a choice arose.
enum class Asked : std::uint8_t { since_agreement, before, at_start };

Asked when_asked(const box::AskedChoice& one) {
  if (one.is_since_agreement) return Asked::since_agreement;
  return one.place != 0 ? Asked::before : Asked::at_start;
}

/// Returns lines with the choices whose question arose at that time. Of the choices before the last
/// agreement, only the most recent are included.
std::vector<std::string> asked_lines(const std::vector<box::AskedChoice>& asked, Asked when) {
  constexpr std::size_t kWidth = 96;
  constexpr std::size_t kLatest = 8;
  std::vector<std::string> lines;
  std::size_t count = 0;
  const auto add = [&](const std::string& text) {
    const bool fits = !lines.empty() && lines.back().size() + text.size() + 2 <= kWidth;
    if (!lines.empty()) lines.back() += fits ? ", " : ",";
    if (!fits) lines.emplace_back();
    lines.back() += text;
  };
  for (const box::AskedChoice& one : asked) {
    if (when_asked(one) != when) continue;
    if (++count > kLatest && when == Asked::before) continue;
    add(one.choice + ": " + one.option +
        (when == Asked::before ? " (at " + std::to_string(one.place) + ")" : ""));
  }
  if (count > kLatest && when == Asked::before) add(std::to_string(count - kLatest) + " more");
  if (lines.empty()) lines.emplace_back("nothing");
  return lines;
}

Json asked_json(const std::vector<box::AskedChoice>& asked) {
  Json rows = Json::array();
  for (const box::AskedChoice& one : asked)
    rows.push_back({{"choice", one.choice},
                    {"option", one.option},
                    {"section", one.section},
                    {"place", one.place},
                    {"since_agreement", one.is_since_agreement}});
  return rows;
}

std::string inputs_text(const std::set<std::string>& taken) {
  std::string text;
  for (const std::string& name : taken) text += (text.empty() ? "" : ", ") + name;
  return "the levels of inputs were taken from replies: " + text;
}

std::string clock_text(double drift_ppm) {
  char text[80];
  std::snprintf(text, sizeof text, "the controller's clock is %.0f ppm %s than the capture's",
                std::abs(drift_ppm), drift_ppm > 0 ? "faster" : "slower");
  return text;
}

}  // namespace

void CaptureComparison::add(const box::Exchange& exchange, const box::Judgement& judgement) {
  ++counts_[index_of(judgement.verdict)];
  std::string kind = kind_of(judgement.request);
  if (by_kind_.size() >= kMaxRequestKinds && !by_kind_.contains(kind)) kind = "other requests";
  ++by_kind_[std::move(kind)][index_of(judgement.verdict)];
  if (!first_ && judgement.verdict != Verdict::undecidable && judgement.verdict != Verdict::different)
    last_agreement_ = judgement.request;
  const std::size_t number = exchanges_++;
  if (judgement.verdict == Verdict::same) return;
  const JudgedReply reply{.place = exchange.place, .at = exchange.at, .judgement = judgement};
  if (judgement.verdict == Verdict::different && !first_) {
    first_ = reply;
    first_number_ = number;
  }
  if (not_same_.size() < kMaxListedReplies) {
    not_same_.push_back(reply);
  } else {
    ++left_out_;
  }
}

std::string CaptureComparison::line_of(const std::string& path, const JudgedReply& reply) {
  const box::Judgement& judgement = reply.judgement;
  return path + ":" + std::to_string(reply.place) + ": " + format_duration(reply.at) + ": " +
         spaced_name(box::name_of(judgement.verdict)) + ": " + one_line(judgement.request) +
         ": controller: " + one_line(judgement.box) + "; bench: " + one_line(judgement.bench);
}

std::string CaptureComparison::text() const {
  std::string text =
      path_ + ": " + std::to_string(exchanges_) + " exchanges: " + verdicts_text(counts_) + "\n";
  if (is_interrupted) text += "  " + std::string(kInterrupted) + "\n";
  for (const std::string& note : notes_text(notes)) text += "  " + note + "\n";
  if (!taken_inputs.empty()) text += "  " + inputs_text(taken_inputs) + "\n";
  if (drift_ppm != 0) text += "  " + clock_text(drift_ppm) + "\n";
  if (usual_delay.count() != 0)
    text += "  replies usually come " + delay_text(usual_delay) + " after the bench's\n";
  if (!first_) return text;
  text += "  first difference: " + path_ + ":" + std::to_string(first_->place) + ", at " +
          format_duration(first_->at) + "\n";
  const auto row = [&](const char* name, const std::string& what) {
    if (!what.empty()) text += "    " + std::string(name) + one_line(what) + "\n";
  };
  row("last agreement: ", last_agreement_);
  row("request:        ", first_->judgement.request);
  row("controller:     ", first_->judgement.box);
  row("bench:          ", first_->judgement.bench);
  const auto rows = [&](const char* name, const std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) row(i == 0 ? name : "                ", lines[i]);
  };
  rows("its state:      ", first_->judgement.around->state);
  row("manual:         ", first_section);
  rows("asked since:    ", asked_lines(first_->judgement.around->asked, Asked::since_agreement));
  rows("asked before:   ", asked_lines(first_->judgement.around->asked, Asked::before));
  rows("asked at start: ", asked_lines(first_->judgement.around->asked, Asked::at_start));
  for (const Remedy& remedy : remedies)
    text += "    it agrees with  " + remedy.text +
            (remedy.section.empty() ? "" : "  (" + one_line(remedy.section) + ")") + "\n";
  if (remedies.empty() && !is_interrupted)
    text += has_searched ? "    no other option of a single choice agrees with it\n"
                         : "    it is so late in the capture that no other options were tried\n";
  for (const auto& [kind, counts] : by_kind_) {
    const std::size_t different = counts[index_of(Verdict::different)];
    const std::size_t all = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    if (different > 0)
      text += "  " + std::to_string(different) + " of " + std::to_string(all) + " differ: " + one_line(kind) +
              "\n";
  }
  return text;
}

Json CaptureComparison::json() const {
  Json report{{"capture", path_}, {"line", notes.line}, {"exchanges", exchanges_}};
  for (const auto& [verdict, name] : box::kVerdictNames)
    report[std::string(name)] = counts_[index_of(verdict)];
  if (is_interrupted) report["interrupted"] = true;
  report["format"] = notes.format;
  report["notes"] = notes_text(notes);
  report["inputs_from_replies"] = taken_inputs;
  report["drift_ppm"] = drift_ppm;
  report["usual_delay_ns"] = usual_delay.count();
  report["first_difference"] = nullptr;
  if (first_) {
    report["first_difference"] = first_->place;
    if (!first_section.empty()) report["section"] = first_section;
    report["last_agreement"] = last_agreement_;
    report["state"] = first_->judgement.around->state;
    report["asked"] = asked_json(first_->judgement.around->asked);
    report["agrees_with"] = Json::array();
    for (const Remedy& remedy : remedies) report["agrees_with"].push_back(remedy.text);
  }
  report["by_request"] = Json::array();
  for (const auto& [kind, counts] : by_kind_) {
    Json row{{"request", one_line(kind)}};
    for (const auto& [verdict, name] : box::kVerdictNames)
      if (const std::size_t count = counts[index_of(verdict)]; count != 0) row[std::string(name)] = count;
    report["by_request"].push_back(std::move(row));
  }
  report["not_same"] = Json::array();
  for (const JudgedReply& reply : not_same_) {
    report["not_same"].push_back({{"place", reply.place},
                                  {"at_ns", reply.at.count()},
                                  {"verdict", box::name_of(reply.judgement.verdict)},
                                  {"request", one_line(reply.judgement.request)},
                                  {"controller", one_line(reply.judgement.box)},
                                  {"bench", one_line(reply.judgement.bench)},
                                  {"later_ns", reply.judgement.later.count()}});
  }
  if (left_out_ != 0) report["left_out"] = left_out_;
  return report;
}

CheckedFile CaptureComparison::findings() const {
  CheckedFile checked{.file = path_, .kind = "capture"};
  for (const JudgedReply& reply : not_same_) {
    const box::Judgement& judgement = reply.judgement;
    const bool is_different = judgement.verdict == Verdict::different;
    if (!is_different && judgement.verdict != Verdict::late && judgement.verdict != Verdict::early) continue;
    std::string text = one_line(judgement.request) + ": controller: " + one_line(judgement.box) +
                       "; bench: " + one_line(judgement.bench);
    if (!is_different)
      text = one_line(judgement.request) + ": the reply is " + std::string(box::name_of(judgement.verdict));
    checked.findings.push_back({.place = {path_, static_cast<int>(reply.place), 0},
                                .text = std::move(text),
                                .is_warning = !is_different});
  }
  if (!first_) checked.is = "a capture that agrees";
  return checked;
}

std::string CaptureComparison::page_sections() const {
  using Rows = std::vector<std::vector<std::string>>;
  Rows summary{{"exchanges", std::to_string(exchanges_)}, {"verdicts", verdicts_text(counts_)}};
  if (is_interrupted) summary.push_back({"note", std::string(kInterrupted)});
  for (const std::string& note : notes_text(notes)) summary.push_back({"note", note});
  if (!taken_inputs.empty()) summary.push_back({"inputs", inputs_text(taken_inputs)});
  if (drift_ppm != 0) summary.push_back({"clock", clock_text(drift_ppm)});
  if (usual_delay.count() != 0)
    summary.push_back({"replies", "usually come " + delay_text(usual_delay) + " after the bench's"});
  Rows first;
  if (first_) {
    first = {{"place", path_ + ":" + std::to_string(first_->place) + ", at " + format_duration(first_->at)},
             {"last agreement", last_agreement_},
             {"request", first_->judgement.request},
             {"controller", first_->judgement.box},
             {"bench", first_->judgement.bench}};
    for (const std::string& line : first_->judgement.around->state) first.push_back({"its state", line});
    if (!first_section.empty()) first.push_back({"manual", first_section});
    for (const std::string& line : asked_lines(first_->judgement.around->asked, Asked::since_agreement))
      first.push_back({"choices asked since", line});
    for (const std::string& line : asked_lines(first_->judgement.around->asked, Asked::before))
      first.push_back({"choices asked before", line});
    for (const std::string& line : asked_lines(first_->judgement.around->asked, Asked::at_start))
      first.push_back({"choices asked at the start", line});
    for (const Remedy& remedy : remedies)
      first.push_back({"agrees with", remedy.text + (remedy.section.empty() ? ""
                                                                            : " (" + remedy.section + ": " +
                                                                                  remedy.question + ")")});
  }
  Rows kinds;
  for (const auto& [kind, counts] : by_kind_) kinds.push_back({one_line(kind), verdicts_text(counts)});
  Rows replies;
  for (const JudgedReply& reply : not_same_)
    replies.push_back({std::to_string(reply.place), format_duration(reply.at),
                       spaced_name(box::name_of(reply.judgement.verdict)), one_line(reply.judgement.request),
                       one_line(reply.judgement.box), one_line(reply.judgement.bench)});
  if (left_out_ != 0) replies.push_back({"", "", std::to_string(left_out_) + " more", "", "", ""});
  constexpr std::array<std::string_view, 2> kPair{"", ""};
  constexpr std::array<std::string_view, 2> kKindColumns{"request", "replies"};
  constexpr std::array<std::string_view, 6> kReplyColumns{"place",   "time",       "verdict",
                                                          "request", "controller", "bench"};
  return play::table_section(path_, kPair, summary) + play::table_section("First difference", kPair, first) +
         play::table_section("By request", kKindColumns, kinds) +
         play::table_section("Replies that are not the same", kReplyColumns, replies);
}

std::string compare_page(const std::vector<CaptureComparison>& comparisons, const std::string& bench,
                         std::string_view version) {
  std::string main;
  for (const CaptureComparison& one : comparisons) main += one.page_sections();
  const auto different = std::ranges::count_if(comparisons, &CaptureComparison::is_different);
  const std::string title = different == 0 ? "All captures agree"
                                           : std::to_string(different) + " of " +
                                                 std::to_string(comparisons.size()) + " captures differ";
  return play::plain_page(title, "compared with " + bench, main, version);
}

}  // namespace understudy::emulator::command_line
