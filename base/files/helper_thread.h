// Work that may take long (files of a user's, up to any size) beside a thread that must not wait.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace understudy {

class HelperThread {
 public:
  HelperThread() = default;
  /// Waits for the work in hand; what has not begun is dropped.
  ~HelperThread();
  HelperThread(const HelperThread&) = delete;
  HelperThread& operator=(const HelperThread&) = delete;

  /// One piece after the other, in their order. It must not throw.
  void give(std::function<void()> work);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool is_ending_ = false;
  std::thread thread_;  // there is none before there is work
};

}  // namespace understudy
