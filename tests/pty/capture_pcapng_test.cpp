// Read back by the tests' own reader; tests/acceptance/capture_test.cpp uses tshark.
#include "pty/capture_pcapng.h"

#include <gtest/gtest.h>

#include "tests/pty/pcapng_reader.h"

namespace understudy::pty {
namespace capture_pcapng_test {

const std::vector<CapturedLine> kLines = {{"rs485", 19200}, {"rs232", 115200}};
const Bytes kRequest = hex("01 03 00 01 00 01 D5 CA");
const Bytes kReply = hex("01 03 02 C0 01 29 84");

CapturedPacket packet(const Bytes& bytes, Direction direction, Remark remark = Remark::none) {
  return {.line = 0, .direction = direction, .time = SimTime{5}, .bytes = bytes, .remark = remark};
}

PcapngPacket written_and_read(const CapturedPacket& packet, std::uint64_t lost_before = 0) {
  std::string file;
  append_pcapng_head(file, kLines);
  append_pcapng_packet(file, packet, lost_before);
  const PcapngFile read = read_pcapng(file);
  EXPECT_EQ(read.packets.size(), 1U);
  return read.packets.at(0);
}

TEST(Pcapng, EachLineIsAnInterfaceWithNanoseconds) {
  std::string file;
  append_pcapng_head(file, kLines);
  const PcapngFile read = read_pcapng(file);
  ASSERT_EQ(read.interfaces.size(), 2U);
  EXPECT_EQ(read.interfaces[0].name, "rs485");
  EXPECT_EQ(read.interfaces[1].name, "rs232");
  for (const PcapngInterface& interface : read.interfaces) {
    EXPECT_EQ(interface.link_type, 252);
    EXPECT_EQ(interface.time_resolution, 9);
  }
  EXPECT_EQ(read.interfaces[1].speed, 115200U);
}

TEST(Pcapng, ARequestComesInAndAReplyGoesOut) {
  const PcapngPacket in = written_and_read(packet(kRequest, Direction::from_host));
  EXPECT_EQ(in.bytes, kRequest);
  EXPECT_EQ(in.flags, 1U);
  EXPECT_EQ(in.dissector, "mbrtu");
  EXPECT_EQ(in.destination_port, kPcapngStationPort);
  EXPECT_EQ(in.comment, "");
  const PcapngPacket out = written_and_read(packet(kReply, Direction::to_host));
  EXPECT_EQ(out.bytes, kReply);
  EXPECT_EQ(out.flags, 2U);
  EXPECT_EQ(out.source_port, kPcapngStationPort);
  EXPECT_EQ(out.destination_port, in.source_port);
}

TEST(Pcapng, LinesAreDistinguishedByInterfaceAndHostPort) {
  CapturedPacket second = packet(kRequest, Direction::from_host);
  second.line = 1;
  const PcapngPacket on_first = written_and_read(packet(kRequest, Direction::from_host));
  const PcapngPacket on_second = written_and_read(second);
  EXPECT_EQ(on_first.interface, 0U);
  EXPECT_EQ(on_second.interface, 1U);
  EXPECT_NE(on_first.source_port, on_second.source_port);
}

TEST(Pcapng, TimesBeyond32BitsAreExact) {
  CapturedPacket late = packet(kRequest, Direction::from_host);
  late.time = std::chrono::hours(24 * 365 * 100) + SimTime{1};
  EXPECT_EQ(written_and_read(late).time, static_cast<std::uint64_t>(late.time.count()));
}

TEST(Pcapng, RemarksAreCommentsAndErrorsAreFlags) {
  const PcapngPacket wrong = written_and_read(packet(kRequest, Direction::from_host, Remark::wrong_checksum));
  EXPECT_EQ(wrong.comment, "dropped: bad CRC");
  EXPECT_EQ(wrong.flags, 1U | 1U << 24);
  EXPECT_EQ(wrong.dissector, "mbrtu");
  const PcapngPacket cut =
      written_and_read(packet(hex("01 03 00"), Direction::from_host, Remark::incomplete));
  EXPECT_EQ(cut.comment, "dropped: incomplete");
  EXPECT_EQ(cut.flags, 1U | 1U << 26);
  EXPECT_EQ(cut.dissector, "data");
  EXPECT_EQ(written_and_read(packet(kReply, Direction::to_host, Remark::collided)).flags, 2U);
}

TEST(Pcapng, LostPacketsAreCounted) {
  EXPECT_EQ(written_and_read(packet(kRequest, Direction::from_host)).drop_count, 0U);
  EXPECT_EQ(written_and_read(packet(kRequest, Direction::from_host), 17).drop_count, 17U);
}

TEST(Pcapng, EverySizeOfAFrameIsPaddedRight) {
  for (std::size_t size = 1; size <= 256; ++size) {
    const Bytes bytes(size, 0xA5);
    EXPECT_EQ(written_and_read(packet(bytes, Direction::to_host)).bytes, bytes) << size;
  }
}

}  // namespace capture_pcapng_test
}  // namespace understudy::pty
