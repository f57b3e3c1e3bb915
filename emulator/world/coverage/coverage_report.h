// Reports how often lines of programs have run, by file, summed over any number of runs.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace understudy::emulator::world {

struct CoveredLine {
  std::int64_t runs = 0;
  bool decides = false;
  std::int64_t yes = 0;  // jumps taken, conditions and contacts that held, waits that did not wait
  std::int64_t no = 0;

  void add(const CoveredLine& other);
  bool operator==(const CoveredLine&) const = default;
};

/// Lines by their number, from 1. Those without an instruction are missing.
using CoveredLines = std::map<int, CoveredLine>;

/// Counts lines, and both outcomes of those that decide.
struct CoverageTotals {
  std::int64_t lines = 0;
  std::int64_t lines_run = 0;
  std::int64_t branches = 0;
  std::int64_t branches_taken = 0;

  void add(const CoveredLine& line);
  void add(const CoverageTotals& other);
  /// Returns the percentage of lines that have run, or 100 if there are no lines.
  double line_percent() const;
  bool operator==(const CoverageTotals&) const = default;
};

struct CoveredFile {
  CoveredLines lines;
  std::string listing = {};  // the program as read back from the device, if no file has it; then the path
                             // is only a name

  CoverageTotals totals() const;
  bool operator==(const CoveredFile&) const = default;
};

struct CoverageReport {
  std::map<std::string, CoveredFile> files;  // by path

  void add(const CoverageReport& other);
  CoverageTotals totals() const;
  bool operator==(const CoverageReport&) const = default;
};

/// Returns the report as lcov's tracefile, or as Cobertura's XML.
std::string lcov_text(const CoverageReport& report);
std::string cobertura_text(const CoverageReport& report);

}  // namespace understudy::emulator::world
