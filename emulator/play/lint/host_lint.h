// Checks how the host on a line behaves. It only observes, and does not affect the line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/play/lint/finding.h"
#include "emulator/world/protocol/modbus_request.h"
#include "emulator/world/world.h"
#include "pty/line_observer.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::play {

class HostLint final : public pty::LineObserver {
 public:
  HostLint(world::World& world, std::size_t line);
  ~HostLint() override;
  HostLint(const HostLint&) = delete;
  HostLint& operator=(const HostLint&) = delete;

  /// Forgets the traffic so far, after the line was put into another state.
  void restart();
  const Findings& findings() const { return findings_; }
  /// Return the minimum silence before a request, and the maximum silence within a request. Neither is
  /// checked if bytes take no time.
  SimTime silence() const { return silence_; }
  SimTime longest_gap() const { return longest_gap_; }

  void on_start_bit(SimTime at) override {
    framer_.start_bit(at);
    under_way_ = at;
  }
  void on_character(const pty::TimedByte& character, bool is_received) override;
  void on_nothing_more() override { framer_.give_up_waiting(); }
  void on_transmission(const pty::Transmission& transmission) override;
  std::optional<SimTime> due() const override { return framer_.due(); }
  void run(SimTime now) override;

 private:
  struct Character {
    std::uint64_t number = 0;
    SimTime start{0};
    SimTime idle{0};  // the silence before it; negative if the line was still busy
  };
  /// The last request, until its answer arrives.
  struct Asked {
    std::uint8_t station = 0;
    std::uint8_t function = 0;
    SimTime at{0};
    std::uint64_t last_character = 0;
    std::string command{};          // the name of its command; empty: it is not a command
    std::vector<std::string> worn;  // registers in EEPROM that it changes if it is executed
  };

  bool has_time() const { return options_.timing == pty::Timing::wire; }
  Finding& find(LintRule rule, std::string subject = {}) { return findings_[{rule, std::move(subject)}]; }
  /// `command` is the name of the frame's command, if any.
  void judge_times(std::span<const Character> frame, const std::string& command);
  void judge_request(std::span<const std::uint8_t> frame, const Character& last, SimTime at,
                     const std::string& command);
  void judge_write(const Device& device, const world::ModbusRequest& request, SimTime at);
  void carried_out(const Asked& asked);

  world::World& world_;
  std::size_t number_;
  pty::LineOptions options_;
  SimTime silence_{0};
  SimTime longest_gap_{0};
  pty::RtuFramer framer_;
  std::vector<Character> waiting_;    // characters that are not part of a frame yet
  std::optional<SimTime> under_way_;  // the start of a character that has not ended yet
  std::optional<SimTime> busy_until_;
  std::uint64_t last_number_ = 0;
  std::optional<Asked> asked_;
  Findings findings_;
};

}  // namespace understudy::emulator::play
