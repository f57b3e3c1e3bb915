#include "emulator/play/performing/suite.h"

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "emulator/play/results/result.h"

namespace understudy::emulator::play {

namespace {

// The threads may be this many cases ahead of the first unfinished case. So a slow case does not immediately
// hold up the others, and the number of waiting results is limited.
constexpr std::size_t kAhead = 256;

/// The state that the threads share.
class CaseQueue {
 public:
  explicit CaseQueue(const NextCase& next) : next_(next) {}

  void work(const std::function<Play()>& make_play) {
    const Play play = make_play();
    while (Entry* const entry = take()) {
      std::vector<ScenarioResult> results;
      std::exception_ptr error = entry->error;
      try {
        if (!error) results = play(entry->which_case);
      } catch (...) {
        error = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      entry->results = std::move(results);
      entry->error = error;
      entry->is_over = true;
      if (entry == &entries_.front()) is_first_over_.notify_one();
    }
  }

  /// Waits for the next case in order and reports it. Returns false after the last case.
  bool report_next(const std::function<void(const CaseId&, std::vector<ScenarioResult>)>& report) {
    std::unique_lock lock(mutex_);
    is_first_over_.wait(lock, [&] { return entries_.empty() ? is_last_taken_ : entries_.front().is_over; });
    if (entries_.empty()) return false;
    Entry entry = std::move(entries_.front());
    entries_.pop_front();
    has_room_.notify_one();
    lock.unlock();
    if (entry.error) std::rethrow_exception(entry.error);
    report(entry.which_case, std::move(entry.results));
    return true;
  }

  /// Prevents the threads from beginning another case.
  void stop() {
    const std::lock_guard lock(mutex_);
    is_last_taken_ = true;
    has_room_.notify_all();
  }

 private:
  struct Entry {
    CaseId which_case;
    bool is_over = false;
    std::vector<ScenarioResult> results{};
    std::exception_ptr error{};
  };

  /// Returns the next case. Its entry does not move in memory until the case is reported.
  Entry* take() {
    std::unique_lock lock(mutex_);
    has_room_.wait(lock, [&] { return is_last_taken_ || entries_.size() < kAhead; });
    if (is_last_taken_) return nullptr;
    Entry entry;
    try {
      const auto which_case = next_();
      if (!which_case) {
        is_last_taken_ = true;
        has_room_.notify_all();
        is_first_over_.notify_one();
        return nullptr;
      }
      entry.which_case = *which_case;
    } catch (...) {
      entry.error = std::current_exception();
      is_last_taken_ = true;
      has_room_.notify_all();
    }
    return &entries_.emplace_back(std::move(entry));
  }

  const NextCase& next_;
  std::mutex mutex_;
  std::condition_variable has_room_;
  std::condition_variable is_first_over_;
  std::deque<Entry> entries_;  // taken but not reported, in order
  bool is_last_taken_ = false;
};

/// Starts `count` threads, or as many as the system allows, but at least one.
void add_threads(std::vector<std::jthread>& threads, int count, const std::function<void()>& work) {
  for (int i = 0; i < count; ++i) {
    try {
      threads.emplace_back(work);
    } catch (const std::system_error&) {
      if (threads.empty()) throw;
      return;
    }
  }
}

}  // namespace

void run_suite(const NextCase& next, const std::function<Play()>& make_play, int jobs,
               const std::function<void(const CaseId&, std::vector<ScenarioResult>)>& report) {
  CaseQueue queue(next);
  std::vector<std::jthread> threads;
  const auto stop_at_end = [&queue](void*) { queue.stop(); };
  // If anything throws, the threads must also stop.
  const std::unique_ptr<void, decltype(stop_at_end)> guard(&queue, stop_at_end);
  add_threads(threads, std::max(jobs, 1), [&] { queue.work(make_play); });
  while (queue.report_next(report)) {
  }
}

}  // namespace understudy::emulator::play
