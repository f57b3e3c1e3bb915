#include "emulator/play/executors/host_time_executor.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/device/register_map/row.h"
#include "emulator/play/executors/condition_watch.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/executors/turns.h"
#include "emulator/play/executors/write_clock.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

[[noreturn]] void refuse() {
  throw std::logic_error("a host program uses the lines; expected only steps that do not use a line");
}

}  // namespace

HostTimeExecutor::HostTimeExecutor(world::World& world, Turns& turns) : world_(world), turns_(turns) {
  turns_.begin();
  writes_ = std::make_unique<WriteClock>(world_);
}

HostTimeExecutor::~HostTimeExecutor() = default;

bool HostTimeExecutor::run_until(const Awaited& awaited, SimTime deadline) {
  if (awaited.is_met(world_)) return true;
  ConditionWatch watch(world_, awaited);
  turns_.wait_until(deadline, &watch);
  if (turns_.is_given_up()) throw ExecutionAborted();
  return watch.is_met();
}

void HostTimeExecutor::advance(SimTime by) {
  turns_.wait_until(world_.now() + by);
  if (turns_.is_given_up()) throw ExecutionAborted();
}

HostReply HostTimeExecutor::read(std::size_t, int, Table, std::uint16_t, int) { refuse(); }
HostReply HostTimeExecutor::write(std::size_t, int, Table, std::uint16_t, std::span<const std::uint16_t>) {
  refuse();
}
HostReply HostTimeExecutor::write_message(std::size_t, int, std::uint16_t, std::span<const std::uint16_t>) {
  refuse();
}
std::vector<std::uint8_t> HostTimeExecutor::exchange(std::size_t, std::span<const std::uint8_t>, std::size_t,
                                                     SimTime) {
  refuse();
}
void HostTimeExecutor::send_text(std::size_t, const std::string&) { refuse(); }
std::vector<std::string> HostTimeExecutor::exchange_text(std::size_t, const std::optional<std::string>&,
                                                         const world::LinesWanted&, SimTime) {
  refuse();
}

}  // namespace understudy::emulator::play
