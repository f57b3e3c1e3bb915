// A thread for work that may take long, such as reading a user's files. The thread that requests the work
// does not wait.
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
  /// Waits for the running job. Jobs that have not begun are dropped.
  ~HelperThread();
  HelperThread(const HelperThread&) = delete;
  HelperThread& operator=(const HelperThread&) = delete;

  /// Queues a job. Jobs run one after another, in order. They must not throw.
  void give(std::function<void()> work);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool is_ending_ = false;
  std::thread thread_;  // started by the first job
};

}  // namespace understudy
