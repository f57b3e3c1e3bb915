// A device that is spoken to in lines of text, on its line: joins characters into lines, hands them to the
// device, and sends what it has said: an answer to a line, or something unasked.
//
// A device with flow control is held by the host's XOFF until its XON comes, or the power goes: it hears, but
// what it has said waits, and what it says unasked stays with it. It sends none of its own.
//
// Long texts go out in pieces, as fast as the wire carries them, so that no line's buffer overflows. While
// the wire is busy with its text, what the device says unasked stays with the device.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/device/text/text_speaker.h"
#include "emulator/world/stations/line_station.h"
#include "pty/text_lines.h"

namespace understudy::emulator::world {

class TextStation final : public LineStation {
 public:
  /// Characters that are given to the line at once.
  static constexpr std::size_t kPiece = 1024;
  /// The same if the host may hold it: what the line has been given cannot be held any more.
  static constexpr std::size_t kPieceThatCanBeHeld = 1;
  /// With this many characters waiting it takes no more from the device, until some have gone.
  static constexpr std::size_t kMostOutgoing = 64 * 1024;

  /// `is_instant`: the line's characters take no time. The device must have a speaker.
  TextStation(Device& device, std::size_t port, bool is_instant);

  void hear(const pty::TimedByte& byte) override;
  void hear_other_station() override {}  // there is none
  std::optional<pty::SimTime> due() const override;
  void run(pty::SimTime now, pty::Transmitter& out) override;

  void reset() override;
  bool look_for_speech(pty::SimTime now) override;
  std::uint64_t dropped_bytes() const override { return state_.lines.dropped_bytes(); }
  void write_state(StateWriter& writer) const override;
  std::function<void()> read_state(StateReader& reader) override;
  std::string difference(StateReader& a, StateReader& b, const std::string& path) const override;

  /// What has been heard and still has to be carried out: at its time, within the event that brought it.
  struct Waiting {
    bool has_heard = false;  // false: the character is only echoed
    pty::HeardText heard;
    std::string echo{};
  };
  struct Outgoing {
    std::uint64_t last_character = 0;  // of the line that it answers; 0: it is said unasked
    std::string text{};
  };
  struct State {
    pty::TextLines lines;
    StationCounters counters;
    std::vector<Waiting> waiting{};  // one at most
    std::vector<FaultyWire::Late> late{};
    std::vector<Outgoing> outgoing{};
    pty::SimTime free_at{0};                  // the wire has carried what it was given
    std::optional<pty::SimTime> speaks_at{};  // what the device says unasked is taken
    bool is_held = false;                     // by the host's XOFF
  };
  const State& save() const { return state_; }

 private:
  void echo(const Waiting& waiting, pty::Transmitter& out);
  void carry_out(const pty::HeardText& heard, pty::SimTime now, pty::Transmitter& out);
  void serve(const pty::HeardText& heard, pty::SimTime now, pty::Transmitter& out);
  void serve_piece(std::span<const std::uint8_t> bytes, std::uint64_t last_character, pty::SimTime now,
                   pty::Transmitter& out) override;
  void say(std::span<const std::uint8_t> bytes, std::uint64_t last_character, pty::Transmitter& out) override;
  void send(pty::SimTime now, pty::Transmitter& out);
  std::size_t outgoing_size() const;

  TextSpeaker& speaker_;
  bool is_instant_;
  State state_;
};

}  // namespace understudy::emulator::world
