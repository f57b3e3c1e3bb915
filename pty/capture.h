// What a capture holds, whatever its format: one packet for each frame that went over a line, and for what
// was not a frame. Encoders (capture_pcapng.h, capture_text.h) are pure; capture_file.h writes what they
// make.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "pty/line_observer.h"

namespace understudy::pty {

enum class Way : std::uint8_t { from_host, to_host };

/// A remark about a packet.
enum class Remark : std::uint8_t {
  none,
  wrong_checksum,  // a whole request but for its checksum: dropped
  incomplete,      // the beginning of one: dropped
  not_a_frame,     // noise: dropped
  unheard,         // no station listens at the host's speed
  collided,        // ran into what another station was saying
  to_nobody,       // said while no host had the line open
};

/// Empty for Remark::none.
constexpr std::string_view text_of(Remark remark) {
  switch (remark) {
    case Remark::none: break;
    case Remark::wrong_checksum: return "dropped: bad CRC";
    case Remark::incomplete: return "dropped: incomplete";
    case Remark::not_a_frame: return "dropped: not a frame";
    case Remark::unheard: return "unheard: the host set another speed";
    case Remark::collided: return "collided with another station";
    case Remark::to_nobody: return "to nobody: no host has the line open";
  }
  return "";
}

struct CapturedPacket {
  std::size_t line = 0;  // its number in the capture
  Way way = Way::from_host;
  SimTime time{0};  // when its first character began
  std::span<const std::uint8_t> bytes;
  Remark remark = Remark::none;
  bool is_text = false;  // of a line of text, and no Modbus frame
  std::string_view
      faults{};  // what they have done to it; without bytes: to one that was dropped, or already seen
  std::string_view command{};  // what it means, where that has a name: "mill: MOVE X 1000"
};

/// "fault 1 drop: not said; fault 2 delay: said later".
std::string text_of(std::span<const Strike> strikes);
/// Everything there is to say about it; may be empty.
std::string comment_of(const CapturedPacket& packet);
constexpr bool has_comment(const CapturedPacket& packet) {
  return packet.remark != Remark::none || !packet.faults.empty() || !packet.command.empty();
}

/// A line of a capture.
struct CapturedLine {
  std::string name;
  int baud = 0;
};

}  // namespace understudy::pty
