// An executor that runs alongside a host in simulated time (docs/host-time.md). The host is another program,
// so the executor itself has no host. It acts on the world while the host sleeps and time is stopped, so
// it acts at the same moments in each run.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/turns.h"
#include "emulator/play/executors/write_clock.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

class HostTimeExecutor final : public Executor {
 public:
  /// Waits for the scenario's first turn. The world and the turns must outlive this object.
  HostTimeExecutor(world::World& world, Turns& turns);
  ~HostTimeExecutor() override;
  HostTimeExecutor(const HostTimeExecutor&) = delete;
  HostTimeExecutor& operator=(const HostTimeExecutor&) = delete;

  // The executor has no host, so these functions throw std::logic_error.
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

  void with_world(const std::function<void(world::World&)>& act) override { act(world_); }
  /// These functions throw ExecutionAborted if the scenario has been given up.
  bool run_until(const Awaited& awaited, SimTime deadline) override;
  void advance(SimTime by) override;
  SimTime now() override { return world_.now(); }
  Tick tick_of_last_write() override { return writes_->tick_of_last_write(); }

 private:
  world::World& world_;
  Turns& turns_;
  std::unique_ptr<WriteClock> writes_;
};

}  // namespace understudy::emulator::play
