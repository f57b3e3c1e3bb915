// Captures as files: the forms that `serve --capture` writes, and what is wrong with others.
#include "emulator/box/capture/capture.h"

#include <gtest/gtest.h>

#include <sstream>

namespace understudy::emulator::box {
namespace capture_test {

Capture read(const std::string& text, const std::string& line = "") {
  std::istringstream file(text);
  return read_capture(file, "c.txt", {.line = line});
}

std::string diagnostic(const std::string& text, const std::string& line = "") {
  try {
    read(text, line);
  } catch (const CaptureReadError& error) {
    return error.what();
  }
  return "";
}

TEST(ReadCapture, JoinsRequestsAndReplies) {
  const Capture capture = read(
      "# simulated seconds, in (from the host) or out, line, bytes, # remark\n"
      "0.000000000 out pc (mill PC) 01 02\n"
      "0.100000000 in  pc (mill PC) 01 03\n"
      "0.105333333 out pc (mill PC) 01 83  # fault 2 corrupt_checksum: last byte inverted\n"
      "0.106000000 out pc (mill PC) 02\n"
      "0.200000000 in  pc (mill PC)  # fault 1 drop: not received\n"
      "1.5 in  pc (mill PC) FF\n");
  EXPECT_EQ(capture.line, "pc (mill PC)");
  EXPECT_EQ(capture.notes.unasked, 1U);
  ASSERT_EQ(capture.exchanges.size(), 2U);
  EXPECT_EQ(capture.exchanges[0].at, SimTime{100'000'000});
  EXPECT_EQ(capture.exchanges[0].replied_at, SimTime{105'333'333});
  EXPECT_EQ(capture.exchanges[0].reply, (CapturedBytes{1, 0x83, 2}));
  EXPECT_EQ(capture.exchanges[0].place, 3U);
  EXPECT_EQ(capture.exchanges[1].at, SimTime{1'500'000'000});
  EXPECT_EQ(capture.exchanges[1].replied_at, std::nullopt);
}

TEST(ReadCapture, SaysWhatIsWrongInOneLine) {
  const std::string good = "0.1 in a 01\n";
  EXPECT_EQ(diagnostic("0.1 out a 01\n"),
            "c.txt: has no request from a host; expected a capture of both directions");
  EXPECT_EQ(diagnostic("0.2 in a 01\n" + good),
            "c.txt:2: the time of this request is before the last one; expected increasing times");
  EXPECT_EQ(diagnostic(good + "0.2 in b 01\n"),
            "c.txt: has several lines, 'a' and 'b'; expected --line with one of them");
  EXPECT_EQ(diagnostic(good, "b"), "c.txt: has no line called 'b'; expected one such as 'a'");
  EXPECT_TRUE(
      diagnostic(good + "x in a 01\n").starts_with("c.txt:2: 'x' is not a time in seconds; expected a line"));
  EXPECT_TRUE(
      diagnostic(good + "0.1 to a 01\n").starts_with("c.txt:2: 'to' is not a direction; expected a line"));
  EXPECT_TRUE(diagnostic("0.1 in a 01 0G\n").starts_with("c.txt:1: '0G' is not a byte; expected a line"));
}

TEST(ReadCapture, RefusesABrokenPcapng) {
  const std::string section(
      "\x0a\x0d\x0d\x0a\x1c\0\0\0\x4d\x3c\x2b\x1a\1\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff\x1c\0\0\0", 28);
  EXPECT_NE(diagnostic(section).find("has no request"), std::string::npos);
  EXPECT_NE(diagnostic(section + std::string("\6\0\0\0\4\0\0\0", 8)).find("has a broken block"),
            std::string::npos);
  const std::string bluetooth("\1\0\0\0\x14\0\0\0\xbb\0\0\0\0\0\0\0\x14\0\0\0", 20);
  const std::string packet("\6\0\0\0\x20\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x20\0\0\0", 32);
  EXPECT_NE(
      diagnostic(section + bluetooth + packet).find("packet 1: is of link type 187; expected a serial line"),
      std::string::npos);
}

}  // namespace capture_test
}  // namespace understudy::emulator::box
