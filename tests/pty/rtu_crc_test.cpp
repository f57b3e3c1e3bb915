#include "pty/rtu_crc.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/pty/wire_examples.h"

namespace understudy::pty {
namespace rtu_crc_test {

/// The definition, bit by bit.
std::uint16_t crc_by_definition(const Bytes& bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) != 0 ? (crc >> 1) ^ 0xA001u : crc >> 1;
  }
  return static_cast<std::uint16_t>(crc);
}

TEST(RtuCrc, IsThePublishedCheckValue) {
  const std::string_view digits = "123456789";
  EXPECT_EQ(rtu_crc(Bytes(digits.begin(), digits.end())), 0x4B37);
  EXPECT_EQ(rtu_crc({}), 0xFFFF);
}

TEST(RtuCrc, AgreesWithEveryPrintedFrame) {
  std::vector<std::string_view> texts(kRequestExamples.begin(), kRequestExamples.end());
  texts.insert(texts.end(), kReplyExamples.begin(), kReplyExamples.end());
  for (const auto text : texts) {
    const Bytes frame = hex(text);
    EXPECT_TRUE(rtu_crc_ok(frame)) << text;
    Bytes again(frame.begin(), frame.end() - 2);
    append_rtu_crc(again);
    EXPECT_EQ(again, frame) << text;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      Bytes wrong = frame;
      wrong[i] ^= 0x10;
      EXPECT_FALSE(rtu_crc_ok(wrong)) << text << " with byte " << i << " changed";
    }
  }
}

TEST(RtuCrc, AgreesWithItsDefinition) {
  std::mt19937 random(1);
  for (std::size_t size = 0; size <= 260; ++size) {
    Bytes bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    EXPECT_EQ(rtu_crc(bytes), crc_by_definition(bytes)) << "size " << size;
  }
}

TEST(RtuCrc, IsNeverRightForACutFrame) {
  Bytes three = {0x01};
  append_rtu_crc(three);
  EXPECT_EQ(three.size(), 3u);
  EXPECT_FALSE(rtu_crc_ok(three));
  EXPECT_FALSE(rtu_crc_ok({}));
  EXPECT_FALSE(rtu_crc_ok(Bytes{0xFF, 0xFF}));
}

TEST(RtuCrc, CompletesAFixedBuffer) {
  std::array<std::uint8_t, 16> buffer = {0x01, 0x03, 0x00, 0x01, 0x00, 0x01};
  EXPECT_EQ(append_rtu_crc(buffer, 6), 8u);
  EXPECT_EQ(Bytes(buffer.begin(), buffer.begin() + 8), hex("01 03 00 01 00 01 D5 CA"));
}

}  // namespace rtu_crc_test
}  // namespace understudy::pty
