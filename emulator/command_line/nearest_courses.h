// Finds the nearest course to each line, and to each outcome of a decision in the controllers' programs, that
// no course of a hunt has reached.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::command_line {

/// A line that never ran, or a decision that never had one of its outcomes.
struct Gap {
  std::string text;  // "feeder.lst:3: Counter_Increase 1: never ran"
  std::string
      nearest;  // "line 2 ran with inject: { stuck: feeder.DIN_10, level: on, nth: 1 }"; empty: no course
};

/// The nearest course to a decision is a course that ran the decision's line. The nearest course to a line is
/// a course that ran the closest preceding line. If there are several, the course with the fewest
/// disturbances is chosen.
class NearestCourses {
 public:
  /// Records which lines a course has run. `size` is the number of its disturbances; `text` describes them.
  void add(const world::CoverageReport& report, std::size_t size, const std::string& text);
  /// Returns the gaps in `all`, sorted by file and line.
  std::vector<Gap> gaps(const world::CoverageReport& all) const;

 private:
  struct Nearest {
    std::size_t size = 0;
    std::size_t number = 0;  // an index in courses_
  };
  std::string nearest_to(const std::string& path, int line) const;

  std::vector<std::string> courses_;
  std::map<std::string, std::map<int, Nearest>> by_line_;  // for each path, the lines of the file
};

}  // namespace understudy::emulator::command_line
