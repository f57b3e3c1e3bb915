// Counts the reports that an observer of a program receives.
#pragma once

#include <cstdint>
#include <map>
#include <ostream>
#include <utility>

#include "base/program_watch.h"

namespace understudy {

struct LineCount {
  std::int64_t runs = 0;
  std::int64_t yes = 0;
  std::int64_t no = 0;

  void decide(bool outcome) { ++(outcome ? yes : no); }
  bool operator==(const LineCount&) const = default;
  friend std::ostream& operator<<(std::ostream& out, const LineCount& count) {
    return out << count.runs << " runs, " << count.yes << " yes, " << count.no << " no";
  }
};

/// Counts by part and line.
using LineTally = std::map<std::pair<int, int>, LineCount>;

class ProgramCounts final : public ProgramWatch {
 public:
  void program_loaded(std::uint64_t /*mark*/) override {}
  void runs(int part, int line, std::int64_t times) override { lines[{part, line}].runs += times; }
  void decides(int part, int line, bool outcome, std::int64_t times) override {
    LineCount& count = lines[{part, line}];
    (outcome ? count.yes : count.no) += times;
  }

  LineTally lines;
};

}  // namespace understudy
