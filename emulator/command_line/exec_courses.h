// Compares the recordings of several runs of the same command (`exec --host-time --repeat`).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace understudy::emulator::command_line {

class Courses {
 public:
  /// Adds the recording of the next run. If this run's course is new, returns the first difference from the
  /// first run, in one line; otherwise an empty text. The waits of the host's threads do not count, because
  /// they do not affect the devices.
  std::string add(const std::string& recording);
  std::size_t count() const { return courses_.size(); }
  /// Returns a line about all runs, such as "20 runs, all the same".
  std::string summary() const;

 private:
  struct Course {
    std::string text;
    std::size_t runs = 0;
  };
  std::vector<Course> courses_;  // in the order of their first occurrence
  std::size_t runs_ = 0;
};

}  // namespace understudy::emulator::command_line
