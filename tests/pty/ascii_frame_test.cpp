#include "pty/ascii_frame.h"

#include <gtest/gtest.h>

#include <string>

#include "pty/ascii_framer.h"
#include "pty/wire_fault.h"
#include "tests/pty/wire_examples.h"

namespace understudy::pty {
namespace ascii_frame_test {

using namespace std::chrono_literals;

Bytes bytes(const std::string& text) { return {text.begin(), text.end()}; }
std::string text(const Bytes& some) { return {some.begin(), some.end()}; }

struct Example {
  const char* rtu;
  const char* ascii;
};
/// The first three are examples of Modicon's reference guide (PI-MBUS-300). All checksums are those of
/// pymodbus.
constexpr Example kExamples[] = {
    {"11 03 00 6B 00 03 76 87", ":1103006B00037E\r\n"},
    {"11 05 00 AC FF 00 4E 8B", ":110500ACFF003F\r\n"},
    {"11 06 00 01 00 03 9A 9B", ":110600010003E5\r\n"},
    {"F7 03 13 89 00 0A 04 35", ":F7031389000A60\r\n"},
};

TEST(AsciiFrame, CarriesTheBytesOfAnRtuFrame) {
  for (const Example& example : kExamples) {
    EXPECT_EQ(text(ascii_of_rtu(hex(example.rtu))), example.ascii);
    EXPECT_EQ(rtu_of_ascii(bytes(example.ascii)), hex(example.rtu));
  }
  EXPECT_EQ(rtu_of_ascii(bytes(":1103006b00037e\r\n")), hex(kExamples[0].rtu)) << "small letters";
}

TEST(AsciiFrame, IsNotMoreNorLess) {
  for (const char* const wrong :
       {"", ":", ":\r\n", ":1103006B00037E", ":1103006B00037E\r", ":1103006B00037E\n\r", "1103006B00037E\r\n",
        ":1103006B00037F\r\n", ":1103006B0037E\r\n", ":1103006B0003 7E\r\n", ":1103G06B00037E\r\n",
        ":11EF\r\n", "::1103006B00037E\r\n", ":1103006B00037E\r\n\n"})
    EXPECT_FALSE(rtu_of_ascii(bytes(wrong))) << wrong;
  EXPECT_TRUE(has_ascii_form(bytes(":1103006B00037F\r\n")));
  EXPECT_FALSE(has_ascii_form(bytes(":1103006B0037F\r\n")));
}

/// The longest frame: 254 bytes and the LRC.
TEST(AsciiFrame, HasAtMost513Characters) {
  Bytes longest(256, 0x00);
  EXPECT_EQ(ascii_of_rtu(longest).size(), kAsciiMaxFrame);
  EXPECT_TRUE(rtu_of_ascii(ascii_of_rtu(longest)));
  longest.push_back(0);
  EXPECT_FALSE(rtu_of_ascii(ascii_of_rtu(longest)));
}

TEST(AsciiFrame, HasItsChecksumCorruptedInItsDigits) {
  const WireFault corrupt{.kind = WireFault::Kind::corrupt_checksum};
  const Bytes frame = bytes(kExamples[0].ascii);
  const auto pieces = through_faults(frame, std::span(&corrupt, 1));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(text(pieces[0].bytes), ":1103006B000370\r\n");
  EXPECT_TRUE(has_ascii_form(pieces[0].bytes)) << text(pieces[0].bytes);
  EXPECT_FALSE(rtu_of_ascii(pieces[0].bytes));
  EXPECT_EQ(through_faults(bytes("A\n"), std::span(&corrupt, 1))[0].bytes, (Bytes{'A', '\n' ^ 0xFF}));
}

/// Pushes characters of 1 ms each. '|' is a pause of `pause`.
struct Pushed {
  std::string frames;
  std::uint64_t dropped = 0;
};
Pushed pushed(const std::string& characters, SimTime pause) {
  AsciiFramer framer;
  Pushed result;
  SimTime now{0};
  std::uint64_t number = 0;
  for (const char character : characters) {
    if (character == '|') {
      now += pause;
      continue;
    }
    const TimedByte byte{now, now + 1ms, static_cast<std::uint8_t>(character), ++number};
    now += 1ms;
    const auto frame = framer.push(byte);
    if (!frame) continue;
    EXPECT_EQ(frame->last_character, number);
    EXPECT_EQ(frame->end, now);
    EXPECT_EQ(rtu_of_ascii(frame->bytes), frame->rtu);
    result.frames += "[" + text(frame->bytes).substr(1, frame->bytes.size() - 3) + "]";
  }
  framer.give_up_waiting();
  result.dropped = framer.dropped_bytes();
  return result;
}

TEST(AsciiFramer, FindsFramesBetweenColonAndLineFeed) {
  const std::string frame = ":1103006B00037E\r\n";
  struct Case {
    std::string characters;
    int frames;
    std::uint64_t dropped;
  };
  const Case kCases[] = {
      {frame, 1, 0},
      {frame + frame, 2, 0},
      {"noise\n" + frame, 1, 6},
      {":1103" + frame, 1, 5},                  // a new colon begins anew
      {":1103006B00037F\r\n" + frame, 1, 17},   // a wrong LRC
      {":1103006B00037E\r" + frame, 1, 16},     // without LF
      {":1103006B00037E\n" + frame, 1, 16},     // without CR
      {":1103 006B00037E\r\n" + frame, 1, 18},  // a blank
      {":1103006B00037E\rA\n" + frame, 1, 18},
      {":" + std::string(600, '0') + frame, 1, 601},
      {":1103006", 0, 8},
  };
  for (const Case& one : kCases) {
    const Pushed result = pushed(one.characters, SimTime{0});
    std::string expected;
    for (int i = 0; i < one.frames; ++i) expected += "[1103006B00037E]";
    EXPECT_EQ(result.frames, expected) << one.characters;
    EXPECT_EQ(result.dropped, one.dropped) << one.characters;
  }
}

/// The standard: up to one second may pass between two characters.
TEST(AsciiFramer, WaitsASecondBetweenCharacters) {
  for (const char* const characters :
       {":|1103006B00037E\r\n", ":1103006B|00037E\r\n", ":1103006B00037E\r|\n"}) {
    EXPECT_EQ(pushed(characters, 1s).frames, "[1103006B00037E]") << characters;
    EXPECT_EQ(pushed(characters, 1s + 1ns).frames, "") << characters;
    EXPECT_EQ(pushed(characters, 1s + 1ns).dropped, 17U) << characters;
  }
}

TEST(AsciiFramer, ChecksARestoredState) {
  AsciiFramer framer;
  for (const char c : std::string(":1103")) framer.push({1ms, 1ms, static_cast<std::uint8_t>(c), 1});
  AsciiFramer other;
  other.restore(framer.save());
  for (const char c : std::string("006B00037E\r\n")) {
    const auto frame = other.push({2ms, 2ms, static_cast<std::uint8_t>(c), 1});
    EXPECT_EQ(frame.has_value(), c == '\n');
  }
  EXPECT_THROW(other.restore({.characters = {'1'}}), std::invalid_argument);
  EXPECT_THROW(other.restore({.characters = Bytes(600, ':')}), std::invalid_argument);
}

}  // namespace ascii_frame_test
}  // namespace understudy::pty
