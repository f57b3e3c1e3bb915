#include "emulator/world/coverage/coverage_report.h"

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace understudy::emulator::world {

void CoveredLine::add(const CoveredLine& other) {
  runs += other.runs;
  decides |= other.decides;
  yes += other.yes;
  no += other.no;
}

void CoverageTotals::add(const CoveredLine& line) {
  ++lines;
  if (line.runs > 0) ++lines_run;
  if (!line.decides) return;
  branches += 2;
  branches_taken += (line.yes > 0 ? 1 : 0) + (line.no > 0 ? 1 : 0);
}

void CoverageTotals::add(const CoverageTotals& other) {
  lines += other.lines;
  lines_run += other.lines_run;
  branches += other.branches;
  branches_taken += other.branches_taken;
}

namespace {

double share(std::int64_t part, std::int64_t all) {
  return all == 0 ? 1 : static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

double CoverageTotals::line_percent() const { return 100 * share(lines_run, lines); }

CoverageTotals CoveredFile::totals() const {
  CoverageTotals totals;
  for (const auto& [number, line] : lines) totals.add(line);
  return totals;
}

void CoverageReport::add(const CoverageReport& other) {
  for (const auto& [path, file] : other.files) {
    CoveredFile& own = files[path];
    own.listing = file.listing;
    for (const auto& [number, line] : file.lines) own.lines[number].add(line);
  }
}

CoverageTotals CoverageReport::totals() const {
  CoverageTotals totals;
  for (const auto& [path, file] : files) totals.add(file.totals());
  return totals;
}

// --- lcov ------------------------------------------------------------------------------------------

namespace {

/// In lcov, "-" stands for the outcomes of a decision that was never made.
std::string taken_text(const CoveredLine& line, std::int64_t count) {
  return line.yes + line.no == 0 ? "-" : std::to_string(count);
}

}  // namespace

std::string lcov_text(const CoverageReport& report) {
  std::string text;
  for (const auto& [path, file] : report.files) {
    text += "TN:\nSF:" + path + "\n";
    const CoverageTotals totals = file.totals();
    for (const auto& [number, line] : file.lines) {
      if (!line.decides) continue;
      const std::string head = "BRDA:" + std::to_string(number);
      text += head + ",0,0," + taken_text(line, line.yes) + "\n" + head + ",0,1," +
              taken_text(line, line.no) + "\n";
    }
    if (totals.branches > 0) {
      text +=
          "BRF:" + std::to_string(totals.branches) + "\nBRH:" + std::to_string(totals.branches_taken) + "\n";
    }
    for (const auto& [number, line] : file.lines) {
      text += "DA:" + std::to_string(number) + "," + std::to_string(line.runs) + "\n";
    }
    text += "LF:" + std::to_string(totals.lines) + "\nLH:" + std::to_string(totals.lines_run) +
            "\nend_of_record\n";
  }
  return text;
}

// --- Cobertura -------------------------------------------------------------------------------------

namespace {

std::string in_xml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&': escaped += "&amp;"; break;
      case '<': escaped += "&lt;"; break;
      case '>': escaped += "&gt;"; break;
      case '"': escaped += "&quot;"; break;
      default: escaped += c;
    }
  }
  return escaped;
}

std::string rates(const CoverageTotals& totals) {
  char text[96];
  std::snprintf(text, sizeof text, " line-rate=\"%.4f\" branch-rate=\"%.4f\" complexity=\"0\"",
                share(totals.lines_run, totals.lines), share(totals.branches_taken, totals.branches));
  return text;
}

std::string xml_of(int number, const CoveredLine& line) {
  std::string text = "            <line number=\"" + std::to_string(number) + "\" hits=\"" +
                     std::to_string(line.runs) + "\" branch=\"" + (line.decides ? "true" : "false") + "\"";
  if (line.decides) {
    const int taken = (line.yes > 0 ? 1 : 0) + (line.no > 0 ? 1 : 0);
    text += " condition-coverage=\"" + std::to_string(50 * taken) + "% (" + std::to_string(taken) + "/2)\"";
  }
  return text + "/>\n";
}

}  // namespace

/// The time is constant, so that equal runs result in equal reports.
std::string cobertura_text(const CoverageReport& report) {
  const CoverageTotals all = report.totals();
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<!DOCTYPE coverage SYSTEM \"http://cobertura.sourceforge.net/xml/coverage-04.dtd\">\n"
      "<coverage" +
      rates(all) + " lines-covered=\"" + std::to_string(all.lines_run) + "\" lines-valid=\"" +
      std::to_string(all.lines) + "\" branches-covered=\"" + std::to_string(all.branches_taken) +
      "\" branches-valid=\"" + std::to_string(all.branches) +
      "\" version=\"1\" timestamp=\"0\">\n"
      "  <sources>\n    <source>.</source>\n  </sources>\n"
      "  <packages>\n    <package name=\"programs\"" +
      rates(all) + ">\n      <classes>\n";
  for (const auto& [path, file] : report.files) {
    const std::string name = in_xml(path);
    text += "        <class name=\"" + name + "\" filename=\"" + name + "\"" + rates(file.totals()) +
            ">\n          <methods/>\n          <lines>\n";
    for (const auto& [number, line] : file.lines) text += xml_of(number, line);
    text += "          </lines>\n        </class>\n";
  }
  return text + "      </classes>\n    </package>\n  </packages>\n</coverage>\n";
}

}  // namespace understudy::emulator::world
