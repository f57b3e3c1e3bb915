// A bench that receives the requests that a host sent to a real controller, at the same times.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/compare/input_log.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/world.h"

namespace understudy::emulator::box {

using Frame = std::vector<std::uint8_t>;

/// The registers that a request reads or writes.
struct Addressed {
  Table table = Table::holding;
  std::uint16_t first = 0;
  int count = 0;
  bool is_write = false;
};
/// Returns nothing for frames of other functions, and for lines of text.
std::optional<Addressed> addressed_by(std::span<const std::uint8_t> request);

struct BenchReply {
  Frame bytes;                  // empty: there was no reply
  std::optional<SimTime> at{};  // when the first character began
  /// For a read of registers: their values a tolerance before the request and after the reply.
  std::vector<std::uint16_t> before{};
  std::vector<std::uint16_t> after{};
  /// The same for a query of a text controller whose reply is a number.
  std::optional<double> number_before{};
  std::optional<double> number_after{};
};

class ReplayBench {
 public:
  /// `line` is the number of the line.
  ReplayBench(const world::Bench& bench, std::size_t line);
  ~ReplayBench();
  ReplayBench(const ReplayBench&) = delete;
  ReplayBench& operator=(const ReplayBench&) = delete;

  /// Sends the request at `at`, and advances time until `until`, or until the reply is complete and the line
  /// is quiet.
  BenchReply ask(std::span<const std::uint8_t> request, SimTime at, SimTime until, SimTime tolerance);

  /// The changes happen at their times as time passes.
  void set_inputs(std::vector<InputChange> changes) { inputs_ = std::move(changes); }

  const world::WorldLine& line() const { return world_.line(line_); }
  /// Returns the registers of the station that the request is for, or null.
  const RegisterBank* bank_of(std::span<const std::uint8_t> request) const;

  /// Returns the present state of the devices that the request is for: registers, axes, terminals, in lines.
  std::vector<std::string> state_text(std::span<const std::uint8_t> request) const;

 private:
  class ReplyRecorder;
  std::vector<std::uint16_t> registers_now(std::span<const std::uint8_t> request) const;
  std::optional<double> number_now(std::span<const std::uint8_t> request) const;

  void advance_to(SimTime time);

  world::World world_;
  std::vector<InputChange> inputs_;
  std::size_t next_input_ = 0;
  std::size_t line_;
  std::unique_ptr<ReplyRecorder> recorder_;
};

}  // namespace understudy::emulator::box
