// An executor in virtual time: simulated time passes as fast as it can, and the host is directly on the line.
// The host is a correct Modbus RTU master: it leaves a silence of t3.5 (plus the scenario's gap) before each
// frame, and no gap within a frame. A reply ends when it is complete, or when a silence of t3.5 follows its
// last byte.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/play/executors/executor.h"

namespace understudy::emulator::play {

struct FreeExecutorOptions {
  SimTime gap{0};                                    // in addition to t3.5
  SimTime timeout = std::chrono::milliseconds(500);  // request end to first reply byte
  std::function<void(const std::string&)> log = {};  // receives messages from devices and lines
};

/// Returns t3.5, rounded up to a nanosecond: 3.5 characters, or 1.75 ms above 19200 baud (MODBUS over Serial
/// Line V1.02, 2.5.1.1).
SimTime silence_between_frames(const pty::LineSettings& settings);

class FreeExecutor final : public Executor {
 public:
  /// Creates a world at power-up. Throws the exceptions of World.
  FreeExecutor(const world::Bench& bench, FreeExecutorOptions options);
  ~FreeExecutor() override;

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
  void advance(SimTime by) override { world_.advance_to(world_.now() + by); }
  SimTime now() override { return world_.now(); }
  Tick tick_of_last_write() override { return tick_of_last_write_; }
  std::vector<SimTime> quiet_since() override;
  void set_quiet_since(const std::vector<SimTime>& since) override;

 private:
  class Host;

  HostReply ask(Host& host, const std::vector<std::uint8_t>& request);
  void send(Host& host, std::span<const std::uint8_t> bytes);
  void put_text(Host& host, const std::string& text);
  void advance_to_next(SimTime limit);

  world::World world_;
  FreeExecutorOptions options_;
  std::vector<std::unique_ptr<Host>> hosts_;  // one per line
  const Host* writing_ = nullptr;             // the host whose write is being executed
  std::uint64_t requests_before_ = 0;         // how many requests its stations had received before the write
  Tick tick_of_last_write_ = 0;
};

}  // namespace understudy::emulator::play
