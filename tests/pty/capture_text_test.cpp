#include "pty/capture_text.h"

#include <gtest/gtest.h>

#include "tests/pty/wire_examples.h"

namespace understudy::pty {
namespace capture_text_test {

const std::vector<CapturedLine> kLines = {{"rs485", 19200}, {"rs232", 115200}};

std::string line_of(const CapturedPacket& packet, std::uint64_t lost_before = 0) {
  std::string text;
  append_text_packet(text, kLines, packet, lost_before);
  return text;
}

TEST(CaptureText, HasTimeWayLineAndBytes) {
  const Bytes request = hex("01 03 00 01 00 01 D5 CA");
  EXPECT_EQ(line_of({.line = 0, .direction = Direction::from_host, .time = SimTime{0}, .bytes = request}),
            "0.000000000 in  rs485 01 03 00 01 00 01 D5 CA\n");
  const Bytes reply = hex("01 03 02 C0 01 29 84");
  EXPECT_EQ(
      line_of({.line = 1, .direction = Direction::to_host, .time = SimTime{12'005'333'333}, .bytes = reply}),
      "12.005333333 out rs232 01 03 02 C0 01 29 84\n");
}

TEST(CaptureText, HasTheSidesOfATappedLine) {
  const std::vector<CapturedLine> tapped{{.name = "line", .baud = 19200, .is_tapped = true}};
  std::string text;
  append_text_head(text, tapped);
  const Bytes bytes = hex("01 03");
  for (const Direction side : {Direction::from_one, Direction::from_other, Direction::unknown})
    append_text_packet(text, tapped, {.direction = side, .time = SimTime{5}, .bytes = bytes}, 0);
  EXPECT_EQ(text,
            "# seconds since 1970, one or other (side of the line) or any, line, bytes\n"
            "0.000000005 one line 01 03\n0.000000005 other line 01 03\n0.000000005 any line 01 03\n");
}

TEST(CaptureText, HasRemarksAndGaps) {
  const Bytes noise = hex("FF 00");
  CapturedPacket packet{.line = 0, .direction = Direction::from_host, .time = SimTime{1}, .bytes = noise};
  EXPECT_EQ(line_of(packet, 3), "0.000000001 in  rs485 FF 00  # 3 packets are missing before this one\n");
  packet.remark = Remark::not_a_frame;
  EXPECT_EQ(line_of(packet), "0.000000001 in  rs485 FF 00  # dropped: not a frame\n");
  EXPECT_EQ(line_of(packet, 3),
            "0.000000001 in  rs485 FF 00  # dropped: not a frame; 3 packets are missing before this one\n");
}

TEST(CaptureText, HasWhatFaultsDid) {
  const Bytes reply = hex("01 03 02");
  CapturedPacket packet{.line = 0, .direction = Direction::to_host, .time = SimTime{1}, .bytes = reply};
  packet.faults = "fault 1 truncate: cut";
  EXPECT_EQ(line_of(packet), "0.000000001 out rs485 01 03 02  # fault 1 truncate: cut\n");
  packet.remark = Remark::to_nobody;
  EXPECT_EQ(line_of(packet, 3),
            "0.000000001 out rs485 01 03 02  # discarded: no host has the line open; fault 1 truncate: cut; "
            "3 packets are missing before this one\n");
  const std::vector<Strike> strikes{{1, "drop", "not sent"}, {12, "delay", "sent late"}};
  const std::string reported = text_of(strikes);
  EXPECT_EQ(
      line_of(
          {.line = 0, .direction = Direction::to_host, .time = SimTime{1}, .bytes = {}, .faults = reported}),
      "0.000000001 out rs485  # fault 1 drop: not sent; fault 12 delay: sent late\n");
}

}  // namespace capture_text_test
}  // namespace understudy::pty
