// Reports how often each program line has run, by file, added up over any number of runs.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace understudy::emulator::world {

struct CoveredLine {
  std::int64_t runs = 0;
  bool decides = false;
  std::int64_t yes = 0;  // jumps taken, conditions and contacts that were true, waits that ended at once
  std::int64_t no = 0;

  void add(const CoveredLine& other);
  bool operator==(const CoveredLine&) const = default;
};

/// Lines by number, counted from 1. Lines without an instruction are missing.
using CoveredLines = std::map<int, CoveredLine>;

/// Counts lines, and for each decision both outcomes.
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
  std::string listing = {};  // if no file contains the program, the program as read from the device; the path
                             // is then only a name

  CoverageTotals totals() const;
  bool operator==(const CoveredFile&) const = default;
};

struct CoverageReport {
  std::map<std::string, CoveredFile> files;  // by path

  void add(const CoverageReport& other);
  CoverageTotals totals() const;
  bool operator==(const CoverageReport&) const = default;
};

/// Return the report as an lcov tracefile, or as Cobertura XML.
std::string lcov_text(const CoverageReport& report);
std::string cobertura_text(const CoverageReport& report);

}  // namespace understudy::emulator::world
