// Turns the traffic of one line into packets: requests as a station frames them, replies as stations send
// them, and characters that were dropped. It has its own framer, so that each request is captured once
// however many stations the line has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pty/capture.h"
#include "pty/line_observer.h"
#include "pty/rtu_framer.h"

namespace understudy::pty {

/// What makes a packet of a line.
enum class Packets : std::uint8_t {
  frames,        // of Modbus RTU
  ascii_frames,  // of Modbus ASCII: from ':' to LF
  lines,         // of text; an LF after its CR begins the next one, and ESC ends one as well
};

class CaptureFrames final : public LineObserver {
 public:
  using Sink = std::function<void(const CapturedPacket&)>;

  /// `framing` is that of the line's stations, with the shortest silence if they differ. It matters for
  /// frames of Modbus RTU only.
  CaptureFrames(std::size_t line, RtuFraming framing, Sink sink, Packets packets = Packets::frames);

  void on_start_bit(SimTime at) override;
  void on_character(const TimedByte& character, bool is_received) override;
  void on_nothing_more() override;
  void on_transmission(const Transmission& transmission) override;
  void on_served(const ServedRequest& request) override;
  void on_strike(const StruckMessage& message) override;
  std::optional<SimTime> due() const override { return framer_.due(); }  // none on other lines
  void run(SimTime now) override;
  std::size_t quiet_characters() const override { return is_text() ? 0 : framer_.quiet_characters(); }

  /// Ends the capture: characters of an incomplete packet become a packet now.
  void finish();

 private:
  bool is_text() const { return packets_ != Packets::frames; }
  void take_text(const TimedByte& character);
  void take_ascii(const TimedByte& character);
  void give_text();
  void give_ascii();
  void give_strikes();
  void give_packet(std::size_t count, Remark remark);
  void give_dropped(std::size_t count);
  void give_what_was_dropped();

  std::size_t line_;
  Sink sink_;
  RtuFramer framer_;
  Packets packets_;
  std::vector<TimedByte> waiting_;  // characters that are in no packet yet
  bool is_received_ = true;         // whether they were received: the same for all of them
  std::string faults_;              // those of the next reply
  SimTime struck_at_{0};            // when the faults acted on that reply
  std::string why_;                 // what a station said of the last request for which it had a reason
  std::uint64_t why_of_ = 0;        // the number of that request's last character
};

}  // namespace understudy::pty
