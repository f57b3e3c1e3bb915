// A device with a text protocol on its line. It joins characters into lines, passes the lines to the device,
// and sends the device's text: answers to lines, or unsolicited text.
//
// If a device has flow control, XOFF from the host stops it until XON, or until the power fails: the device
// still receives, but its answers wait, and its unsolicited text stays in the device. The device itself does
// not send XOFF.
//
// Long texts are sent in pieces, as fast as the wire carries them, so that the line's buffer does not
// overflow. While the wire is busy with its text, unsolicited text stays in the device.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/device/text/text_protocol.h"
#include "emulator/world/stations/line_station.h"
#include "pty/text_lines.h"

namespace understudy::emulator::world {

class TextStation final : public LineStation {
 public:
  /// The number of characters that are passed to the line at once.
  static constexpr std::size_t kPiece = 1024;
  /// Like kPiece, but for hosts that may send XOFF: characters that are already on the line cannot be
  /// stopped.
  static constexpr std::size_t kPieceThatCanBeHeld = 1;
  /// If this many characters are waiting, the station accepts no more text from the device until some have
  /// been sent.
  static constexpr std::size_t kMaxOutgoing = 64 * 1024;

  /// `is_instant` is true if characters take no time on the line. The device must have a text protocol.
  TextStation(Device& device, std::size_t port, bool is_instant);

  void receive(const pty::TimedByte& byte) override;
  void on_other_station() override {}  // not needed
  std::optional<pty::SimTime> due() const override;
  void run(pty::SimTime now, pty::Transmitter& out) override;

  void reset() override;
  bool poll_text(pty::SimTime now) override;
  std::uint64_t dropped_bytes() const override { return state_.lines.dropped_bytes(); }
  void write_state(StateWriter& writer) const override;
  std::function<void()> read_state(StateReader& reader) override;
  std::string difference(StateReader& a, StateReader& b, const std::string& path) const override;

  /// A received line that has not been executed yet. It is executed at the time of the event that completed
  /// it.
  struct Waiting {
    bool has_received = false;  // false if the character must only be echoed
    pty::ReceivedText received;
    std::string echo{};
  };
  struct Outgoing {
    std::uint64_t last_character = 0;  // of the line that this text answers; 0: sent without a request
    std::string text{};
  };
  struct State {
    pty::TextLines lines;
    StationCounters counters;
    std::vector<Waiting> waiting{};  // at most one
    std::vector<FaultyWire::Late> late{};
    std::vector<Outgoing> outgoing{};
    pty::SimTime free_at{0};                  // when the wire has transmitted all data of this station
    std::optional<pty::SimTime> speaks_at{};  // when to read unsolicited text from the device
    bool is_held = false;                     // by the host's XOFF
  };
  const State& save() const { return state_; }

 private:
  void echo(const Waiting& waiting, pty::Transmitter& out);
  void carry_out(const pty::ReceivedText& received, pty::SimTime now, pty::Transmitter& out);
  void serve(const pty::ReceivedText& received, pty::SimTime now, pty::Transmitter& out);
  void serve_piece(std::span<const std::uint8_t> bytes, std::uint64_t last_character, pty::SimTime now,
                   pty::Transmitter& out) override;
  void transmit(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                pty::Transmitter& out) override;
  void send(pty::SimTime now, pty::Transmitter& out);
  std::size_t outgoing_size() const;

  TextProtocol& protocol_;
  bool is_instant_;
  State state_;
};

}  // namespace understudy::emulator::world
