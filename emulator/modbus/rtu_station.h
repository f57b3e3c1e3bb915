// A Modbus RTU station: a device's presence on a line. Takes frames from its own framer, asks the device
// whether the address is meant for it, and answers.
#pragma once

#include "emulator/device.h"
#include "pty/rtu_framer.h"
#include "pty/station.h"

namespace understudy::emulator {

struct StationCounters {
  std::uint64_t requests = 0;  // frames for this station, broadcasts included
  std::uint64_t replies = 0;
  std::uint64_t exceptions = 0;  // of the replies
};

class RtuStation final : public pty::Station {
 public:
  RtuStation(Device& device, pty::RtuFraming framing) : device_(device), framer_(framing) {}

  pty::LineSettings settings() const override { return device_.line_settings(); }
  // Without power it hears nothing.
  void hear_start_bit(pty::SimTime at) override {
    if (device_.powered()) framer_.start_bit(at);
  }
  void hear(const pty::TimedByte& byte) override {
    if (device_.powered()) framer_.push(byte);
  }
  void hear_other_station() override { framer_.reset(); }
  void hear_nothing_more() override { framer_.give_up_waiting(); }
  std::optional<pty::SimTime> due() const override { return framer_.due(); }
  void run(pty::SimTime now, pty::Transmitter& out) override;

  /// What it was hearing is forgotten.
  void reset() { framer_.reset(); }

  const Device& device() const { return device_; }
  const StationCounters& counters() const { return counters_; }
  std::uint64_t dropped_bytes() const { return framer_.dropped_bytes(); }

  /// What it hears and has counted; the device's state is its own.
  struct State {
    pty::RtuFramer::State framer;
    StationCounters counters;
  };
  State save() const;
  /// Throws std::invalid_argument for what this station cannot be.
  void check(const State& state) const { framer_.check(state.framer); }
  /// The same, and nothing has changed then.
  void restore(const State& state);

 private:
  void serve_frame(const pty::RtuFrame& frame, pty::Transmitter& out);

  Device& device_;
  pty::RtuFramer framer_;
  StationCounters counters_;
};

}  // namespace understudy::emulator
