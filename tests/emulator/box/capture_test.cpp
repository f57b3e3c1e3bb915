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

/// `one` is the host.
TEST(ReadCapture, AccountsForRepliesWhoseRequestsAreMissing) {
  struct Case {
    const char* reply;   // it comes without its request
    const char* before;  // the exchange before it
    std::size_t exchanges;
    std::size_t restored;
    std::size_t lost;
  };
  const char* const reading = "1.00 one a 01 03 10 02 00 01 21 0A\n1.01 other a 01 03 02 00 00 B8 44\n";
  const char* const writing = "1.00 one a 01 06 10 02 00 37 6D 1C\n1.01 other a 01 06 10 02 00 37 6D 1C\n";
  const std::vector<Case> cases{
      {"01 06 10 02 00 37 6D 1C", reading, 3, 1, 0},  // it repeats its request
      {"01 10 10 02 00 01 A4 C9", reading, 2, 0, 1},  // its values are lost
      {"01 06 10 02 00 37 6D 1C", writing, 2, 0, 0},  // once more: an echo
      {"01 03 02 00 00 B8 44", reading, 2, 0, 0},     // a read changes nothing
      {"01 86 02 C3 A1", reading, 2, 0, 0},           // nor does what was refused
  };
  for (const Case& one : cases) {
    const Capture capture = read(std::string(one.before) + "1.06 other a " + one.reply +
                                 "\n1.10 one a 01 03 10 02 00 01 21 0A\n"
                                 "1.11 other a 01 03 02 00 37 F9 92\n");
    ASSERT_EQ(capture.exchanges.size(), one.exchanges) << one.reply;
    EXPECT_EQ(capture.notes.restored_requests, one.restored) << one.reply;
    EXPECT_EQ(capture.notes.lost_requests, one.lost) << one.reply;
    EXPECT_EQ(capture.exchanges.back().follows_loss, one.lost != 0) << one.reply;
    EXPECT_FALSE(capture.exchanges.front().follows_loss) << one.reply;
    EXPECT_EQ(capture.exchanges.back().reply, (CapturedBytes{1, 3, 2, 0, 0x37, 0xF9, 0x92}));
    if (one.restored == 0) continue;
    EXPECT_EQ(capture.exchanges[1].request, (CapturedBytes{1, 6, 0x10, 2, 0, 0x37, 0x6D, 0x1C}));
    EXPECT_EQ(capture.exchanges[1].at, SimTime{60'000'000});
  }
}

TEST(ReadCapture, LosesNoLineToAByteOrderMark) {
  const std::string ours = "0.1 in a 01 03\n0.2 out a 01 83\n0.3 in a 01 04\n";
  const std::string log =
      "1.000000 TX 01 03 10 02 00 01 21 0a\n1.012000 RX 01 03 02 00 00 b8 44\n"
      "1.100000 TX 01 03 10 02 00 01 21 0a\n1.112000 RX 01 03 02 00 37 f9 92\n";
  for (const std::string& text : {ours, log}) {
    const std::string pattern = text == log ? "{time} {dir} {hex}" : "";
    std::istringstream plain(text);
    std::istringstream marked("\xEF\xBB\xBF" + text);
    const Capture expected = read_capture(plain, "c.txt", {.pattern = pattern});
    const Capture came = read_capture(marked, "c.txt", {.pattern = pattern});
    ASSERT_EQ(came.exchanges.size(), 2U);
    EXPECT_EQ(expected.exchanges.size(), 2U);
    EXPECT_EQ(came.exchanges.front().request, expected.exchanges.front().request);
    EXPECT_EQ(came.notes.format, expected.notes.format);
  }
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
