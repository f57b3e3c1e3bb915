// A Modbus ASCII station: the presence of a device on a line whose frames are lines of hexadecimal digits. It
// serves a frame at the end of its line feed.
#pragma once

#include <vector>

#include "emulator/world/stations/line_station.h"
#include "pty/ascii_framer.h"
#include "pty/station.h"

namespace understudy::emulator::world {

class AsciiStation final : public LineStation {
 public:
  /// `patience` is the maximum time between two characters of a frame.
  AsciiStation(Device& device, std::size_t port, pty::SimTime patience)
      : LineStation(device, port, state_.counters, state_.late),
        state_{.framer = pty::AsciiFramer(patience), .counters = {}} {}

  void receive(const pty::TimedByte& byte) override;
  void on_other_station() override { state_.framer.reset(); }
  void on_idle() override { state_.framer.give_up_waiting(); }
  std::optional<pty::SimTime> due() const override;
  void run(pty::SimTime now, pty::Transmitter& out) override;

  void reset() override;
  std::uint64_t dropped_bytes() const override { return state_.framer.dropped_bytes(); }
  void write_state(StateWriter& writer) const override;
  std::function<void()> read_state(StateReader& reader) override;
  std::string difference(StateReader& a, StateReader& b, const std::string& path) const override;

  struct State {
    pty::AsciiFramer framer;
    StationCounters counters;
    std::vector<pty::AsciiFrame> waiting{};  // at most one, served when it is complete
    std::vector<FaultyWire::Late> late{};
  };
  const State& save() const { return state_; }

 private:
  void serve_frame(const pty::AsciiFrame& frame, pty::SimTime now, pty::Transmitter& out);
  void serve_piece(std::span<const std::uint8_t> bytes, std::uint64_t last_character, pty::SimTime now,
                   pty::Transmitter& out) override;
  void transmit(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                pty::Transmitter& out) override;

  State state_;
};

}  // namespace understudy::emulator::world
