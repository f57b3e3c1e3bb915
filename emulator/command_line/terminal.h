// Output that is only for people at a terminal: colours, and the progress of a long run.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace understudy::emulator::command_line {

/// Returns "850 played of 100000, ..." without control characters. `seconds` is the time since the start.
std::string progress_text(std::uint64_t done, std::uint64_t total, std::uint64_t failed, double seconds);

/// Returns true for a terminal, unless NO_COLOR or TERM=dumb turns colours off.
bool wants_colour(int descriptor);

/// Colours the verdict at the beginning of a line ("ok", "FAIL", "-") if `with_colour` is true.
std::string coloured_verdict(const std::string& line, bool with_colour);

/// Shows a progress line at the bottom of a terminal: the number of finished and failed cases, the rate, and
/// the remaining time. It appears after the run has taken a while. It is not shown if standard error is not a
/// terminal, or if the variable CI is set.
class ProgressLine {
 public:
  /// `is_wanted` is false for a run that asks questions at the terminal, because the progress line would
  /// erase them.
  explicit ProgressLine(std::uint64_t total, bool is_wanted = true);
  /// `text_of` returns the text to show; its argument is the number of seconds since the start. It is called
  /// on another thread.
  explicit ProgressLine(std::function<std::string(double)> text_of, bool is_wanted = true);
  ~ProgressLine();  // clears the line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Counts a finished case.
  void one_done(bool has_failed) {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (has_failed) ++failed_;
  }
  /// Counts a case that another run has finished.
  void one_left_out() {
    const std::lock_guard lock(mutex_);
    --total_;
  }
  /// Calls `print`, and shows its output above the progress line.
  template <typename Print>
  void above(const Print& print) {
    const std::lock_guard lock(mutex_);
    wipe();
    print();
  }

 private:
  void run();
  void wipe();

  std::function<std::string(double)> text_of_;
  std::uint64_t total_ = 0;
  std::mutex mutex_;
  std::condition_variable over_;
  std::uint64_t done_ = 0;
  std::uint64_t failed_ = 0;
  bool is_shown_ = false;
  bool is_over_ = false;
  std::thread thread_;  // declared last, because the thread uses all other members
};

}  // namespace understudy::emulator::command_line
