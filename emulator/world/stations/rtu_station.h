// A Modbus RTU station: the presence of a device on a line. It receives frames from its own framer, asks the
// device whether the address is its own, and answers.
#pragma once

#include "emulator/world/stations/line_station.h"
#include "pty/rtu_framer.h"
#include "pty/station.h"

namespace understudy::emulator::world {

class RtuStation final : public LineStation {
 public:
  RtuStation(Device& device, std::size_t port, pty::RtuFraming framing)
      : LineStation(device, port, state_.counters, state_.late),
        state_{.framer = pty::RtuFramer(framing), .counters = {}} {}

  // Without power, a station receives nothing.
  void on_start_bit(pty::SimTime at) override {
    if (!device_.powered()) return;
    state_.framer.start_bit(at);
    report_errors(state_.framer);
  }
  void receive(const pty::TimedByte& byte) override {
    if (!device_.powered()) return;
    state_.framer.push(byte);
    report_errors(state_.framer);
    if (wire_.is_broken()) check_completed(byte.number, byte.end);
  }
  void on_other_station() override {
    state_.framer.reset();
    wire_.forget_early_frame();
  }
  void on_idle() override {
    state_.framer.give_up_waiting();
    report_errors(state_.framer);
  }
  std::optional<pty::SimTime> due() const override;
  std::size_t quiet_characters() const override {
    return wire_.is_broken() ? 0 : state_.framer.quiet_characters();
  }
  void run(pty::SimTime now, pty::Transmitter& out) override;

  void reset() override;
  std::uint64_t dropped_bytes() const override { return state_.framer.dropped_bytes(); }
  void write_state(StateWriter& writer) const override;
  std::function<void()> read_state(StateReader& reader) override;
  std::string difference(StateReader& a, StateReader& b, const std::string& path) const override;

  /// What the station has received and counted. The state of the device is separate.
  struct State {
    pty::RtuFramer framer;
    StationCounters counters;
    std::vector<FaultyWire::Late> late{};
  };
  const State& save() const { return state_; }

 private:
  /// Call this after each call of the framer. It reports errors to the device.
  void report_errors(pty::RtuFramer& framer) {
    if (framer.has_errors()) report_each_error(framer);
  }
  void report_each_error(pty::RtuFramer& framer);
  ReceivedFrame received_frame(const pty::RtuFrame& frame, pty::SimTime now) const;
  void check_completed(std::uint64_t last_character, pty::SimTime now);
  void take_frame(const pty::RtuFrame& frame, pty::SimTime now, pty::Transmitter& out);
  void serve_frame(const pty::RtuFrame& frame, pty::SimTime now, pty::Transmitter& out);
  void serve_piece(std::span<const std::uint8_t> bytes, std::uint64_t last_character, pty::SimTime now,
                   pty::Transmitter& out) override;
  void transmit(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                pty::Transmitter& out) override;

  State state_;
};

}  // namespace understudy::emulator::world
