// Finds, for each line and each outcome of the controllers' programs that no course of a hunt has reached,
// the course that came nearest.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::command_line {

/// Describes a line that never ran, or a decision that never had one of its outcomes.
struct Gap {
  std::string text;  // "feeder.lst:3: Counter_Increase 1: never ran"
  std::string
      nearest;  // "line 2 ran with inject: { stuck: feeder.DIN_10, level: on, nth: 1 }"; empty: no course
};

/// The course nearest to a decision is one that ran the decision's line; the course nearest to a line is one
/// that ran the closest line before it. If there are several, it is the one with the fewest disturbances.
class NearestCourses {
 public:
  /// Records which lines a course has run. `size` is the number of its disturbances; `text` describes them.
  void add(const world::CoverageReport& report, std::size_t size, const std::string& text);
  /// Returns the gaps in `all`, in the order of files and lines.
  std::vector<Gap> gaps(const world::CoverageReport& all) const;

 private:
  struct Nearest {
    std::size_t size = 0;
    std::size_t number = 0;  // the course's index in courses_
  };
  std::string nearest_to(const std::string& path, int line) const;

  std::vector<std::string> courses_;
  std::map<std::string, std::map<int, Nearest>> by_line_;  // the lines of a course's files, by path
};

}  // namespace understudy::emulator::command_line
