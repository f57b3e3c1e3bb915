#include "emulator/play/report/coverage_page.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/text_file.h"
#include "base/text/lines.h"
#include "emulator/play/report/axis_scale.h"
#include "emulator/play/report/page_parts.h"
#include "emulator/play/results/junit.h"
#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::play {

namespace {

using world::CoverageTotals;
using world::CoveredFile;
using world::CoveredLine;

struct ShownFile {
  std::string path;
  const CoveredFile* file = nullptr;
  CoverageTotals totals;
  std::string id;
};

double percent(std::int64_t part, std::int64_t all) {
  return all == 0 ? 100.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
}

std::string share_text(std::int64_t part, std::int64_t all, const char* what) {
  return std::to_string(part) + " of " + std::to_string(all) + " " + what + " (" +
         fixed_number(percent(part, all), 1) + " %)";
}

std::string share_cells(std::int64_t part, std::int64_t all) {
  if (all == 0) return "<td></td><td class=\"time dim\">none</td>";
  return "<td class=\"time" + std::string(part < all ? " bad" : "") + "\">" +
         fixed_number(percent(part, all), 1) + " %</td><td class=\"time dim\">" + std::to_string(part) + "/" +
         std::to_string(all) + "</td>";
}

/// Returns the programs. Those with the most lines that have not run come first.
std::vector<ShownFile> shown(const world::CoverageReport& report) {
  std::vector<ShownFile> files;
  for (const auto& [path, file] : report.files) {
    files.push_back({path, &file, file.totals(), "p" + std::to_string(files.size() + 1)});
  }
  const auto left = [](const ShownFile& file) { return file.totals.lines - file.totals.lines_run; };
  const auto branches_left = [](const ShownFile& file) {
    return file.totals.branches - file.totals.branches_taken;
  };
  std::stable_sort(files.begin(), files.end(), [&](const ShownFile& a, const ShownFile& b) {
    if (left(a) != left(b)) return left(a) > left(b);
    return branches_left(a) > branches_left(b);
  });
  return files;
}

std::string outcome(const char* word, std::int64_t count) {
  return "<span" + std::string(count == 0 ? " class=\"bad\"" : "") + ">" + word + " " +
         std::to_string(count) + "</span>";
}

std::string row_of(int number, std::string_view text, const CoveredLine* line) {
  const bool is_missed = line != nullptr && line->runs == 0;
  std::string row = "<tr" + std::string(is_missed ? " class=\"missed\"" : "") + "><td class=\"time dim\">" +
                    std::to_string(number) + "</td><td class=\"time\">" +
                    (line == nullptr ? "" : std::to_string(line->runs)) + "</td><td class=\"outcomes\">";
  if (line != nullptr && line->decides && !is_missed) {
    row += outcome("yes", line->yes) + ", " + outcome("no", line->no);
  }
  return row + "</td><td><code>" + xml_escaped(text) + "</code></td></tr>\n";
}

std::string text_of(const ShownFile& shown) {
  if (!shown.file->listing.empty()) return shown.file->listing;
  return read_text_file(shown.path).value_or("");
}

std::string listing_of(const ShownFile& shown) {
  std::string rows;
  int number = 0;
  const std::string text = text_of(shown);
  const auto& lines = shown.file->lines;
  const auto line_at = [&](int at) {
    const auto found = lines.find(at);
    return found == lines.end() ? nullptr : &found->second;
  };
  for (const TextLine line : TextLines(text)) {
    number = line.number;
    rows += row_of(number, line.text, line_at(number));
  }
  // The text may no longer exist, or may have become shorter.
  for (auto rest = lines.upper_bound(number); rest != lines.end(); ++rest) {
    rows += row_of(rest->first, "", &rest->second);
  }
  return "<details class=\"scenario\" id=\"" + shown.id + "\"><summary><h2>" + xml_escaped(shown.path) +
         "</h2><span class=\"dim\">" + coverage_text(shown.totals) +
         "</span></summary>\n<div class=\"scroll\"><table class=\"covered\">\n"
         "<tr><th scope=\"col\" class=\"time\">line</th><th scope=\"col\" class=\"time\">runs</th>"
         "<th scope=\"col\">outcomes</th><th scope=\"col\">program</th></tr>\n" +
         rows + "</table></div></details>\n";
}

}  // namespace

std::string coverage_text(const CoverageTotals& totals) {
  return share_text(totals.lines_run, totals.lines, "lines") + ", " +
         share_text(totals.branches_taken, totals.branches, "branches");
}

std::string coverage_section(const world::CoverageReport& report) {
  const std::vector<ShownFile> files = shown(report);
  std::string text =
      "<section aria-label=\"programs\">\n<h2>Programs: " + coverage_text(report.totals()) + "</h2>\n";
  if (files.empty()) return text + "<p class=\"dim\">No device has a program.</p>\n</section>\n";
  text +=
      "<div class=\"scroll\"><table class=\"programs\">\n<tr><th scope=\"col\">program</th>"
      "<th scope=\"col\" class=\"time\" colspan=\"2\">lines</th>"
      "<th scope=\"col\" class=\"time\" colspan=\"2\">branches</th></tr>\n";
  for (const ShownFile& file : files) {
    text += "<tr><td><a href=\"#" + file.id + "\">" + xml_escaped(file.path) + "</a></td>" +
            share_cells(file.totals.lines_run, file.totals.lines) +
            share_cells(file.totals.branches_taken, file.totals.branches) + "</tr>\n";
  }
  text += "</table></div>\n";
  for (const ShownFile& file : files) text += listing_of(file);
  return text + "</section>\n";
}

std::string coverage_page(const world::CoverageReport& report, std::string_view version) {
  const std::string summary = coverage_text(report.totals());
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Understudy: " +
         summary + "</title>\n<style>" + std::string(kPageStyle) +
         "</style>\n</head>\n<body>\n<header>\n<h1>Understudy</h1>\n<p>Coverage of programs</p>\n"
         "</header>\n<main>\n" +
         coverage_section(report) + "</main>\n<footer>understudy " + xml_escaped(version) +
         "</footer>\n<script>" + std::string(kPageScript) + "</script>\n</body>\n</html>\n";
}

}  // namespace understudy::emulator::play
