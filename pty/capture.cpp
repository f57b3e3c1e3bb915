#include "pty/capture.h"

#include <span>
#include <string>
#include <string_view>

#include "pty/line_observer.h"

namespace understudy::pty {

std::string text_of(std::span<const Strike> strikes) {
  std::string text;
  for (const Strike& strike : strikes) {
    if (!text.empty()) text += "; ";
    text += "fault " + std::to_string(strike.fault) + " ";
    text += strike.kind;
    text += ": ";
    text += strike.effect;
  }
  return text;
}

std::string comment_of(const CapturedPacket& packet) {
  const bool has_no_crc = packet.is_text && packet.remark == Remark::wrong_checksum;
  std::string text(has_no_crc ? "dropped: bad LRC" : text_of(packet.remark));
  for (const std::string_view more : {packet.faults, packet.why, packet.command}) {
    if (!text.empty() && !more.empty()) text += "; ";
    text += more;
  }
  return text;
}

}  // namespace understudy::pty
