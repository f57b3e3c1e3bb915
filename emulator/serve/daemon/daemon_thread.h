// Runs a daemon on its own thread.
#pragma once

#include <functional>
#include <string>
#include <thread>

#include "emulator/serve/daemon/daemon.h"

namespace understudy::emulator::serve {

class DaemonThread {
 public:
  /// Opens everything, but does not run yet. `options` must not watch signals, which are sent to the whole
  /// process.
  DaemonThread(const world::Bench& bench, const DaemonOptions& options,
               std::function<void(const std::string&)> log)
      : daemon_(bench, options, std::move(log)) {}
  ~DaemonThread() { stop(); }
  DaemonThread(const DaemonThread&) = delete;
  DaemonThread& operator=(const DaemonThread&) = delete;

  Daemon& daemon() { return daemon_; }
  void start() {
    thread_ = std::thread([this] { daemon_.run(); });
  }
  /// Ends the thread after the calls posted so far.
  void stop() {
    if (!thread_.joinable()) return;
    daemon_.post([this] { daemon_.stop(); });
    thread_.join();
  }

 private:
  Daemon daemon_;
  std::thread thread_;
};

}  // namespace understudy::emulator::serve
