// Compares the recordings of several runs of the same command (`exec --host-time --repeat`).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace understudy::emulator::command_line {

class Courses {
 public:
  /// Adds the recording of the next run. If the course of this run is new, returns its first difference from
  /// the first run as one line; otherwise returns an empty text. Waits of the host's threads are ignored,
  /// because they do not affect the devices.
  std::string add(const std::string& recording);
  std::size_t count() const { return courses_.size(); }
  /// Returns a summary of all runs, such as "20 runs, all the same".
  std::string summary() const;

 private:
  struct Course {
    std::string text;
    std::size_t runs = 0;
  };
  std::vector<Course> courses_;  // ordered by first occurrence
  std::size_t runs_ = 0;
};

}  // namespace understudy::emulator::command_line
