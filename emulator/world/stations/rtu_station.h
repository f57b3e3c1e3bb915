// A Modbus RTU station: a device's presence on a line. Takes frames from its own framer, asks the device
// whether the address is meant for it, and answers.
#pragma once

#include "emulator/world/stations/line_station.h"
#include "pty/rtu_framer.h"
#include "pty/station.h"

namespace understudy::emulator::world {

class RtuStation final : public LineStation {
 public:
  /// The most requests and replies that can be late; any more are lost.
  static constexpr std::size_t kMostLate = 256;

  RtuStation(Device& device, pty::RtuFraming framing) : LineStation(device), framer_(framing) {}

  // Without power it hears nothing.
  void hear_start_bit(pty::SimTime at) override {
    if (device_.powered()) framer_.start_bit(at);
  }
  void hear(const pty::TimedByte& byte) override {
    if (!device_.powered()) return;
    framer_.push(byte);
    if (faults_ != nullptr) look_for_early_frame(byte);
  }
  void hear_other_station() override {
    framer_.reset();
    is_early_ = false;
  }
  void hear_nothing_more() override { framer_.give_up_waiting(); }
  std::optional<pty::SimTime> due() const override;
  void run(pty::SimTime now, pty::Transmitter& out) override;

  void reset() override;
  std::uint64_t dropped_bytes() const override { return framer_.dropped_bytes(); }
  void write_state(StateWriter& writer) const override;
  std::function<void()> read_state(StateReader& reader) override;

  /// A message that a fault has made late.
  struct Late {
    pty::SimTime at{0};
    bool is_reply = false;  // else a request
    std::uint64_t last_character = 0;
    std::vector<std::uint8_t> bytes{};
  };
  /// What it hears and has counted; the device's state is separate.
  struct State {
    pty::RtuFramer::State framer;
    StationCounters counters;
    std::vector<Late> late{};  // in the order of time
  };
  State save() const;
  /// Throws std::invalid_argument for what this station cannot be.
  void check(const State& state) const;
  /// Like check(); if it throws, nothing has changed.
  void restore(const State& state);

 private:
  HeardFrame heard(std::span<const std::uint8_t> bytes, std::uint64_t last_character, pty::SimTime now) const;
  void look_for_early_frame(const pty::TimedByte& byte);
  void take_frame(const pty::RtuFrame& frame, pty::SimTime now, pty::Transmitter& out);
  void serve_frame(const pty::RtuFrame& frame, pty::SimTime now, pty::Transmitter& out);
  void serve_garbled(const std::vector<std::uint8_t>& bytes, std::uint64_t last_character, pty::SimTime now,
                     pty::Transmitter& out);
  void keep_late(Late message);
  void run_late(pty::SimTime now, pty::Transmitter& out);

  pty::RtuFramer framer_;
  std::vector<Late> late_;
  bool is_early_ = false;  // what the framer holds is served at once: within the event that brought it
};

}  // namespace understudy::emulator::world
