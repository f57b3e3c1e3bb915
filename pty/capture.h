// Defines the contents of a capture in any format: one packet for each frame that went over a line, and one
// for each run of characters that was not a frame. Encoders (capture_pcapng.h, capture_text.h) are pure;
// capture_file.h writes their output.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "pty/line_observer.h"

namespace understudy::pty {

enum class Direction : std::uint8_t {
  from_host,
  to_host,
  // On a line that is only tapped, it is unknown which side is the host:
  from_one,    // received by the first adapter
  from_other,  // received by the second
  unknown,     // one adapter receives both sides
};

enum class Remark : std::uint8_t {
  none,
  wrong_checksum,  // a whole request with a wrong checksum: dropped
  incomplete,      // the beginning of a request: dropped
  not_a_frame,     // noise: dropped
  unheard,         // no station listens at the host's speed
  collided,        // overlapped another station's transmission
  to_nobody,       // sent while no host had the line open
};

/// Returns an empty text for Remark::none.
constexpr std::string_view text_of(Remark remark) {
  switch (remark) {
    case Remark::none: break;
    case Remark::wrong_checksum: return "dropped: bad CRC";
    case Remark::incomplete: return "dropped: incomplete";
    case Remark::not_a_frame: return "dropped: not a frame";
    case Remark::unheard: return "unheard: the host set another speed";
    case Remark::collided: return "collided with another station";
    case Remark::to_nobody: return "discarded: no host has the line open";
  }
  return "";
}

struct CapturedPacket {
  std::size_t line = 0;  // its number in the capture
  Direction direction = Direction::from_host;
  SimTime time{0};  // when its first character began
  std::span<const std::uint8_t> bytes;
  Remark remark = Remark::none;
  bool is_text = false;  // part of a line of text, not a Modbus frame
  // Effects of faults. Without bytes, they concern a message that was dropped or captured before.
  std::string_view faults{};
  std::string_view why{};      // of a reply: why the request had no effect or was refused
  std::string_view command{};  // the meaning of a command, if it has a name: "mill: MOVE X 1000"
  // The number of a request's last character; for a reply, that of its request. 0: unknown.
  std::uint64_t last_character = 0;
};

/// Returns a text such as "fault 1 drop: not sent; fault 2 delay: sent late".
std::string text_of(std::span<const Strike> strikes);
/// Returns the remark, faults, reason and command of a packet as one text. It may be empty.
std::string comment_of(const CapturedPacket& packet);
constexpr bool has_comment(const CapturedPacket& packet) {
  return packet.remark != Remark::none || !packet.faults.empty() || !packet.why.empty() ||
         !packet.command.empty();
}

/// A line as a capture lists it.
struct CapturedLine {
  std::string name;
  int baud = 0;
  bool is_tapped = false;  // packets are bytes as received, with real times since 1970
};

}  // namespace understudy::pty
