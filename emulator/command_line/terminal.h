// For people at a terminal only: colours, and the progress of a long run.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace understudy::emulator::command_line {

/// Whether it is a terminal, and colours are not unwanted (NO_COLOR, TERM=dumb).
bool wants_colour(int descriptor);

/// A line that begins with a verdict ("ok", "FAIL", "-"); that word is coloured if colours are wanted.
std::string coloured_verdict(const std::string& line, bool with_colour);

/// A last line on standard output that says how many are done, rewritten now and then once the run has taken
/// a while. There is none if standard output is not a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(std::size_t total);
  ~ProgressLine();  // wipes it away
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// One more is done; what `print` prints stands above the line.
  template <typename Print>
  void one_done(const Print& print) {
    const std::lock_guard lock(mutex_);
    wipe();
    ++done_;
    print();
  }

 private:
  void run();
  void wipe();

  const std::size_t total_;
  std::mutex mutex_;
  std::condition_variable over_;
  std::size_t done_ = 0;
  bool is_shown_ = false;
  bool is_over_ = false;
  std::thread thread_;  // last: it uses all the others
};

}  // namespace understudy::emulator::command_line
