#include "emulator/play/report/page.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/report/axis_scale.h"
#include "emulator/play/report/page_parts.h"
#include "emulator/play/report/picture.h"
#include "emulator/play/report/run_log.h"
#include "emulator/play/results/junit.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"

namespace understudy::emulator::play {

namespace {

using Verdict = ScenarioResult::Verdict;

std::string verdict_text(const ScenarioResult& result) {
  switch (result.verdict) {
    case Verdict::passed: return "<span class=\"good\">passed</span>";
    case Verdict::failed: return "<span class=\"bad\">FAILED</span>";
    case Verdict::not_reached: return "<span class=\"dim\">not reached</span>";
    case Verdict::not_tellable: return "<span class=\"dim\">not tellable</span>";
  }
  return {};
}

std::string id_of(std::size_t number) { return "s" + std::to_string(number + 1); }

/// Writes seconds with microsecond resolution, and the exact time in the title.
std::string time_cell(SimTime time) {
  constexpr double kSecond = 1e9;
  return "<td class=\"time\" title=\"" + seconds_text(time) + " s\">" +
         fixed_number(static_cast<double>(time.count()) / kSecond, 6) + "</td>";
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string in(const char* tag, const std::string& text) {
  return "<" + std::string(tag) + ">" + text + "</" + tag + ">";
}

/// Returns a link to a result. A branch that did not run has no section.
std::string linked(const ScenarioResult& result, const std::string& id) {
  const std::string name = xml_escaped(result.name);
  return result.verdict == Verdict::not_reached ? name : "<a href=\"#" + id + "\">" + name + "</a>";
}

std::string list_of(std::span<const ScenarioResult> results) {
  std::string text =
      "<div class=\"scroll\"><table class=\"scenarios\">\n<tr><th scope=\"col\">verdict</th>"
      "<th scope=\"col\">scenario</th><th scope=\"col\">file</th>"
      "<th scope=\"col\" class=\"time\">simulated [s]</th></tr>\n";
  for (std::size_t i = 0; i < results.size(); ++i) {
    const ScenarioResult& result = results[i];
    text += "<tr><td>" + verdict_text(result) + "</td><td>" + linked(result, id_of(i));
    if (result.failure) text += "<br><span class=\"bad\">" + xml_escaped(result.failure->what) + "</span>";
    text += "</td><td class=\"dim\">" + xml_escaped(result.file) + "</td>" + time_cell(result.simulated) +
            "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string failure_text(const Failure& failure) {
  std::string text = "<h3 class=\"unseen\">why it failed</h3>\n<div class=\"failure\"><b>" +
                     xml_escaped(failure.what) + "</b> <span class=\"dim\">at " +
                     format_duration(failure.at) + "</span>\n<table>";
  const auto row = [&](const char* title, const std::string& what) {
    if (!what.empty())
      text += "<tr><th scope=\"row\">" + std::string(title) + "</th><td>" + in("code", xml_escaped(what)) +
              "</td></tr>\n";
  };
  row("expected", failure.expected);
  row("got", failure.came);
  for (const std::string& detail : failure.details) row("also", detail);
  text += "</table>\n";
  const auto fold = [&](const char* title, const std::vector<std::string>& lines, bool is_open = false) {
    if (lines.empty()) return;
    text += std::string(is_open ? "<details open>" : "<details>") + "<summary>" + std::string(title) +
            "</summary><pre>";
    for (const std::string& line : lines) text += xml_escaped(line) + "\n";
    text += "</pre></details>\n";
  };
  fold("what led to it", failure.led_to, true);
  fold("the last frames before the failure", failure.frames);
  fold("the state at that time", failure.state);
  return text + "</div>\n";
}

std::string arrow(const char* sign, const char* meaning) {
  return std::string("<span role=\"img\" aria-label=\"") + meaning + "\">" + sign + "</span>";
}

/// Returns the frames of a stretch that began in [from, to).
std::string frames_text(const Stretch& stretch, SimTime from, SimTime to, bool is_open) {
  const auto begins_before = [](const SeenFrame& frame, SimTime time) { return frame.time < time; };
  const auto& all = stretch.frames;
  const auto first = std::lower_bound(all.begin(), all.end(), from, begins_before);
  const auto last = std::lower_bound(first, all.end(), to, begins_before);
  if (first == last) return "";
  std::string rows;
  std::size_t left_out = 0;
  for (auto frame = first; frame != last; ++frame) {
    const auto number = static_cast<std::size_t>(frame - all.begin());
    if (number == stretch.left_out_at && stretch.frames_left_out > 0) {
      left_out = stretch.frames_left_out;
      rows += "<tr><td></td><td colspan=\"3\" class=\"dim\">" + counted(left_out, "frame") +
              " omitted here</td></tr>\n";
    }
    rows += "<tr>" + time_cell(frame->time) + "<td class=\"dim\">" + xml_escaped(frame->line) + "</td><td>" +
            (frame->is_from_host ? arrow("&rarr;", "from the host") : arrow("&larr;", "to the host")) +
            "</td><td>";
    if (!frame->text.empty()) rows += in("code", xml_escaped(frame->text));
    if (frame->text != frame->bytes) rows += " <code class=\"dim\">" + xml_escaped(frame->bytes) + "</code>";
    if (!frame->remark.empty()) rows += " <span class=\"bad\">" + xml_escaped(frame->remark) + "</span>";
    rows += "</td></tr>\n";
  }
  const std::size_t count = static_cast<std::size_t>(last - first) + left_out;
  return std::string("<details") + (is_open ? " open" : "") + "><summary>" + counted(count, "frame") +
         "</summary><table class=\"frames\">\n" + rows + "</table></details>";
}

std::string steps_text(std::span<const StepResult> steps, std::size_t first_number, const Stretch* stretch) {
  if (steps.empty()) return "";
  std::string text =
      "<h3 class=\"unseen\">steps</h3>\n<div class=\"scroll\"><table class=\"steps\">\n"
      "<tr><th scope=\"col\" class=\"time\">step</th><th scope=\"col\" class=\"time\">begins [s]</th>"
      "<th scope=\"col\" class=\"time\">takes [s]</th><th scope=\"col\">what</th>"
      "<th scope=\"col\" class=\"place\">where</th></tr>\n";
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const StepResult& step = steps[i];
    // When time goes back, the jump is counted in the next stretch.
    const SimTime takes = std::max(step.end - step.begin, SimTime{0});
    text += std::string("<tr") + (step.has_failed ? " class=\"failed\"" : "") + "><td class=\"time\">" +
            std::to_string(first_number + i) + "</td>" + time_cell(step.begin) + time_cell(takes) + "<td>" +
            in("code", xml_escaped(step.text));
    if (step.has_failed) text += " <b class=\"bad\">failed</b>";
    if (stretch != nullptr) {
      const SimTime from = i == 0 ? stretch->begin : step.begin;
      const SimTime to = i + 1 < steps.size() ? steps[i + 1].begin : kForever;
      text += frames_text(*stretch, from, to, step.has_failed);
    }
    text += "</td><td class=\"place dim\">" + xml_escaped(step.file) + ":" + std::to_string(step.line) +
            "</td></tr>\n";
  }
  return text + "</table></div>\n";
}

/// Returns the names of signals that were always on, because pictures do not show them.
std::string always_on(const Stretch& stretch) {
  std::string names;
  for (const SeenSignal& signal : stretch.signals) {
    const bool is_on = signal.kind == SeenSignal::Kind::bit && !signal.varies() && signal.min != 0;
    if (is_on) names += (names.empty() ? "" : ", ") + signal.name;
  }
  return names.empty() ? "" : "<p class=\"dim\">on throughout: <code>" + xml_escaped(names) + "</code></p>\n";
}

std::string stretch_text(const ScenarioResult& result, const Stretch& stretch, std::size_t first,
                         std::size_t end, bool is_last) {
  const auto steps = std::span(result.steps).subspan(first, end - first);
  PictureMarks marks{.steps = steps, .first_number = first + 1, .failed_at = {}, .of = result.name};
  if (result.failure && is_last) marks.failed_at = result.failure->at;
  const std::string drawn = picture(stretch, marks);
  const std::string text =
      drawn.empty() ? "<p class=\"dim\">Nothing moved or switched.</p>\n"
                    : "<div class=\"scene\"><div class=\"scroll\" role=\"group\" aria-label=\"picture\" "
                      "tabindex=\"0\">" +
                          drawn + "</div><pre class=\"values\" aria-hidden=\"true\"></pre></div>\n";
  return text + always_on(stretch) + steps_text(steps, first + 1, &stretch);
}

std::string body_of(const ScenarioResult& result) {
  std::string text;
  if (result.failure) text += failure_text(*result.failure);
  if (!result.recording.empty()) {
    const std::string again = xml_escaped("understudy replay " + result.recording);
    text += "<p>to run this again: " + in("code", again) +
            "</p>\n<p>to see it in a browser: " + in("code", again + " --page") + "</p>\n";
  }
  if (!result.run_log || result.run_log->stretches.empty()) {
    text += steps_text(result.steps, 1, nullptr);
  } else {
    const std::vector<Stretch>& stretches = result.run_log->stretches;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      if (i > 0) text += "<h3>after step " + std::to_string(stretches[i].first_step) + "</h3>\n";
      const bool is_last = i + 1 == stretches.size();
      const std::size_t first =
          i == 0 ? 0 : stretches[i].first_step;  // stretches that take no time are omitted
      const std::size_t end = is_last ? result.steps.size() : stretches[i + 1].first_step;
      text += stretch_text(result, stretches[i], first, end, is_last);
    }
  }
  if (!result.lint_findings.empty()) {
    text += "<h3>protocol violations by the host</h3>\n<ul>\n";
    for (const std::string& line : result.lint_findings)
      text += in("li", in("code", xml_escaped(line))) + "\n";
    text += "</ul>\n";
  }
  return text;
}

}  // namespace

std::string report_page(std::span<const ScenarioResult> results, std::string_view version, const Tally* all,
                        std::string_view programs) {
  const std::string summary = xml_escaped(all != nullptr ? summary_line(*all) : summary_line(results));
  const std::uint64_t count =
      all != nullptr ? all->passed + all->failed + all->not_reached + all->not_tellable : results.size();
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Understudy: " +
      summary + "</title>\n<style>" + std::string(kPageStyle) +
      "</style>\n</head>\n<body>\n<header>\n<h1>Understudy</h1>\n<p>" + summary + "</p>\n" +
      (count > results.size()
           ? "<p class=\"dim\">" + std::to_string(count - results.size()) +
                 " of these are not shown: they passed, or failed in the same way as one that is shown.</p>\n"
           : "") +
      "</header>\n<main>\n<nav aria-label=\"scenarios\">\n<h2 class=\"unseen\">Scenarios</h2>\n" +
      list_of(results) + "</nav>\n";
  // Failed scenarios are expanded, and so is a single scenario.
  for (std::size_t i = 0; i < results.size(); ++i) {
    const ScenarioResult& result = results[i];
    if (result.verdict == Verdict::not_reached) continue;
    const bool is_open = result.verdict == Verdict::failed || results.size() == 1;
    page += "<details class=\"scenario\" id=\"" + id_of(i) + "\"" + (is_open ? " open" : "") + "><summary>" +
            verdict_text(result) + "<h2>" + xml_escaped(result.name) + "</h2><span class=\"dim\">" +
            xml_escaped(result.file) + ", " + format_duration(result.simulated) + "</span></summary>\n" +
            body_of(result) + "</details>\n";
  }
  return page + std::string(programs) + "</main>\n<footer>understudy " + xml_escaped(version) +
         "; times are simulated</footer>\n<script>" + std::string(kPageScript) +
         "</script>\n</body>\n</html>\n";
}

}  // namespace understudy::emulator::play
