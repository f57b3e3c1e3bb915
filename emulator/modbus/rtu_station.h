// A Modbus RTU station: a device's presence on a line. Takes frames from its own framer, asks the device
// whether the address is meant for it, and answers.
#pragma once

#include "emulator/device.h"
#include "emulator/faults/frame_faults.h"
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
  /// Requests and replies that are late; what is more is lost.
  static constexpr std::size_t kMostLate = 256;

  RtuStation(Device& device, pty::RtuFraming framing) : device_(device), framer_(framing) {}

  pty::LineSettings settings() const override { return device_.line_settings(); }
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

  /// What it was hearing, and what it has still to say, is forgotten.
  void reset();

  /// Where something is broken that frames meet; null: nothing is. The device's number is told with each
  /// frame.
  void set_faults(FrameFaults* faults, std::size_t device) {
    faults_ = faults;
    device_number_ = device;
  }

  const Device& device() const { return device_; }
  const StationCounters& counters() const { return counters_; }
  std::uint64_t dropped_bytes() const { return framer_.dropped_bytes(); }

  /// A message that a fault has made late.
  struct Late {
    pty::SimTime at{0};
    bool is_reply = false;  // else a request
    std::uint64_t last_character = 0;
    std::vector<std::uint8_t> bytes{};
  };
  /// What it hears and has counted; the device's state is its own.
  struct State {
    pty::RtuFramer::State framer;
    StationCounters counters;
    std::vector<Late> late{};  // in the order of time
  };
  State save() const;
  /// Throws std::invalid_argument for what this station cannot be.
  void check(const State& state) const;
  /// The same, and nothing has changed then.
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

  Device& device_;
  pty::RtuFramer framer_;
  StationCounters counters_;
  FrameFaults* faults_ = nullptr;
  std::size_t device_number_ = 0;
  std::vector<Late> late_;
  bool is_early_ = false;  // what the framer holds is served at once: within the event that brought it
};

}  // namespace understudy::emulator
