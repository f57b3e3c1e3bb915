// A bench that receives the requests that a host sent to a real controller, at the same times.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
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
/// Returns the words, or bits, of a good reply to a read; nothing for any other.
std::vector<std::uint16_t> words_in(const Addressed& asked, std::span<const std::uint8_t> request,
                                    std::span<const std::uint8_t> reply);

struct BenchReply {
  Frame bytes;                  // empty: there was no reply
  std::optional<SimTime> at{};  // when the first character began
  /// For a read of registers: their values a tolerance before the request and after the reply.
  std::vector<std::uint16_t> before{};
  std::vector<std::uint16_t> after{};
  /// The same for a query of a text controller whose reply is a number.
  std::optional<double> number_before{};
  std::optional<double> number_after{};
  /// The words of the controller's reply from which levels of inputs were taken.
  std::vector<std::size_t> taken{};
};

class ReplayBench {
 public:
  /// `line` is the number of the line.
  ReplayBench(const world::Bench& bench, std::size_t line);
  ~ReplayBench();
  ReplayBench(const ReplayBench&) = delete;
  ReplayBench& operator=(const ReplayBench&) = delete;

  /// Sends the request at `at`, and advances time until `until`, or until the reply is complete and the line
  /// is quiet. `shown` has the words of the controller's reply if inputs shall follow them.
  BenchReply ask(std::span<const std::uint8_t> request, SimTime at, SimTime until, SimTime tolerance,
                 std::span<const std::uint16_t> shown = {});

  /// The changes happen at their times as time passes.
  void set_inputs(std::vector<InputChange> changes) { inputs_ = std::move(changes); }

  const world::WorldLine& line() const { return world_.line(line_); }
  /// Returns the registers of the station that the request is for, or null.
  const RegisterBank* bank_of(std::span<const std::uint8_t> request) const;
  /// Returns the inputs whose levels were taken from replies: "feeder.DIN_2".
  const std::set<std::string>& taken_inputs() const { return taken_inputs_; }

  /// Returns the present state of the devices that the request is for: registers, axes, terminals, in lines.
  std::vector<std::string> state_text(std::span<const std::uint8_t> request) const;

 private:
  class ReplyRecorder;
  std::optional<std::size_t> device_of(std::span<const std::uint8_t> request) const;
  std::vector<std::size_t> take_inputs(std::span<const std::uint8_t> request,
                                       std::span<const std::uint16_t> shown,
                                       std::span<const std::uint16_t> bench);
  /// Returns true if a machine or a wire decides the level of an input.
  bool is_driven(std::size_t device, int terminal) const;
  bool takes_input(std::size_t device, int terminal, std::int32_t shown, std::int32_t bench);
  std::vector<std::uint16_t> registers_now(std::span<const std::uint8_t> request) const;
  std::optional<double> number_now(std::span<const std::uint8_t> request) const;

  void advance_to(SimTime time);

  world::World world_;
  std::vector<InputChange> inputs_;
  std::size_t next_input_ = 0;
  std::set<std::string> taken_inputs_;
  std::size_t line_;
  std::unique_ptr<ReplyRecorder> recorder_;
};

}  // namespace understudy::emulator::box
