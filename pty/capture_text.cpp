#include "pty/capture_text.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "pty/capture.h"

namespace understudy::pty {

namespace {

std::string_view word_of(Direction direction) {
  switch (direction) {
    case Direction::from_host: return " in  ";
    case Direction::to_host: return " out ";
    case Direction::from_one: return " one ";
    case Direction::from_other: return " other ";
    case Direction::unknown: return " any ";
  }
  return " ";
}

}  // namespace

void append_text_head(std::string& file, std::span<const CapturedLine> lines) {
  const bool is_tapped = !lines.empty() && lines.front().is_tapped;
  file += is_tapped ? "# seconds since 1970, one or other (side of the line) or any, line, bytes\n"
                    : "# simulated seconds, in (from the host) or out, line, bytes, # remark\n";
}

void append_text_packet(std::string& file, std::span<const CapturedLine> lines, const CapturedPacket& packet,
                        std::uint64_t lost_before) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  file += std::to_string(packet.time.count() / kSecond);
  file += '.';
  file += std::to_string(packet.time.count() % kSecond + kSecond).substr(1);
  file += word_of(packet.direction);
  file += lines[packet.line].name;
  for (const std::uint8_t byte : packet.bytes) {
    file += ' ';
    file += kDigits[byte >> 4];
    file += kDigits[byte & 0x0F];
  }
  const std::string comment = comment_of(packet);
  if (!comment.empty()) (file += "  # ") += comment;
  if (lost_before > 0) {
    file += comment.empty() ? "  # " : "; ";
    file += std::to_string(lost_before) + " packets are missing before this one";
  }
  file += '\n';
}

}  // namespace understudy::pty
