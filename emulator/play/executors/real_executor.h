// An executor in real time: the world of a daemon, which runs on another thread, and libmodbus as the host on
// its ports.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/libmodbus_host.h"
#include "emulator/play/executors/write_clock.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/daemon_thread.h"

namespace understudy::emulator::play {

/// Thrown when the scenario was given up.
struct ExecutionAborted : std::runtime_error {
  ExecutionAborted() : std::runtime_error("the run was aborted") {}
};

struct RealExecutorOptions {
  SimTime gap{0};                                    // in addition to t3.5
  SimTime timeout = std::chrono::milliseconds(500);  // request end to first reply byte
  /// If false, other programs are the hosts on the lines, and the executor has no host.
  bool has_hosts = true;
  /// When this becomes true, all waits throw ExecutionAborted. They also throw it after the daemon has ended,
  /// because time then stops. Null: the scenario is never given up.
  const std::atomic<bool>* given_up = nullptr;
};

class RealExecutor final : public Executor {
 public:
  /// Another thread runs the daemon. After the daemon has ended, that thread must not access the world during
  /// the lifetime of this executor. Throws pty::PortError.
  RealExecutor(serve::Daemon& daemon, RealExecutorOptions options);
  /// The same, but with a separate daemon, which is already running.
  RealExecutor(std::unique_ptr<serve::DaemonThread> thread, RealExecutorOptions options);
  ~RealExecutor() override;
  RealExecutor(const RealExecutor&) = delete;
  RealExecutor& operator=(const RealExecutor&) = delete;

  HostReply read(std::size_t line, int station, Table table, std::uint16_t first, int count) override;
  HostReply write(std::size_t line, int station, Table table, std::uint16_t first,
                  std::span<const std::uint16_t> words) override;
  HostReply write_message(std::size_t line, int station, std::uint16_t first,
                          std::span<const std::uint16_t> words) override;
  std::vector<std::uint8_t> exchange(std::size_t line, std::span<const std::uint8_t> bytes,
                                     std::size_t wanted, SimTime within) override;
  void send_text(std::size_t line, const std::string& text) override;
  std::vector<std::string> exchange_text(std::size_t line, const std::optional<std::string>& text,
                                         const world::LinesWanted& wanted, SimTime within) override;

  void with_world(const std::function<void(world::World&)>& act) override;
  bool run_until(const Awaited& awaited, SimTime deadline) override;
  void advance(SimTime by) override;
  /// After run_until(), returns the time of the tick in which its condition was true, until time passes
  /// again.
  SimTime now() override;
  Tick tick_of_last_write() override;

 private:
  class DeadlineWatch;

  LibmodbusHost& host(std::size_t line);
  /// Adds the bytes of a reply that libmodbus refused, because libmodbus does not return them.
  HostReply with_bytes(std::size_t line, HostReply reply);
  HostReply ask_ascii(std::size_t line, const std::vector<std::uint8_t>& request);
  SimTime time_to_send(std::size_t line, const std::string& text) const;
  void throw_if_given_up() const;
  /// Returns how long simulated time needs to reach `time`, measured with the wall clock, or nothing while
  /// the clock is stopped.
  std::optional<serve::WallTime> wall_time_until(SimTime time);

  std::unique_ptr<serve::DaemonThread> own_;
  serve::Daemon& daemon_;
  RealExecutorOptions options_;
  std::unique_ptr<WriteClock> writes_;
  std::vector<pty::LineOptions> lines_;  // the initial settings, because hosts do not follow a DIP switch
  std::vector<std::unique_ptr<LibmodbusHost>> hosts_;  // one per line
  std::vector<bool> are_ascii_;                        // Modbus ASCII lines
  std::optional<SimTime> found_at_;                    // set by run_until(), if no time has passed since
};

/// Creates an executor in real time with the scenario's bench and gap, and with separate ports. The
/// devices' memories initially have the contents of their files, but those files are never written.
std::unique_ptr<Executor> make_real_executor(const Scenario& scenario);

}  // namespace understudy::emulator::play
