// Captures of other programs. The files in captures/ are what these programs wrote of one exchange of a
// Simple2-R3: two registers are read, the speed is set to 60, and read. text2pcap made the packets; the
// tables of Saleae and the log of interceptty were written by hand, as their documentation shows them.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <random>
#include <sstream>

#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/log_pattern.h"
#include "emulator/box/capture/log_time.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {
namespace foreign_captures_test {

using std::chrono::milliseconds;

CapturedBytes frame(CapturedBytes bytes) {
  pty::append_rtu_crc(bytes);
  return bytes;
}

const CapturedBytes kAskVersion = frame({1, 3, 0, 1, 0, 2});
const CapturedBytes kVersion = frame({1, 3, 4, 0xC0, 1, 0, 0x98});
const CapturedBytes kSetSpeed = frame({1, 6, 0x10, 2, 0, 60});
const CapturedBytes kAskSpeed = frame({1, 3, 0x10, 2, 0, 1});
const CapturedBytes kSpeed = frame({1, 3, 2, 0, 60});

Capture read_file(const std::string& name, CaptureSettings settings = {}) {
  std::ifstream file(TEST_FACTS "/box/captures/" + name, std::ios::binary);
  EXPECT_TRUE(file) << name;
  return read_capture(file, name, settings);
}

Capture read_text(const std::string& text, CaptureSettings settings = {}) {
  std::istringstream file(text);
  return read_capture(file, "c.txt", settings);
}

std::string diagnostic(const std::string& text, CaptureSettings settings = {}) {
  try {
    read_text(text, settings);
  } catch (const CaptureReadError& error) {
    return error.what();
  }
  return "";
}

struct FileCase {
  std::string name;
  std::string format;
  CaptureSettings settings{};
  bool is_side_inferred = true;
  std::optional<milliseconds> second_at{};  // when the second request came, after the first
};

TEST(ForeignCapture, OfEachProgramHasTheThreeExchanges) {
  const std::vector<FileCase> cases{
      {"socat.txt", "a log of socat -x", {}, true, milliseconds(34)},
      {"libmodbus.txt", "debug output of libmodbus", {.every = milliseconds(20)}, true, milliseconds(20)},
      {"pymodbus.txt", "debug output of pymodbus", {}, true, milliseconds(12)},
      {"interceptty.txt", "a log of interceptty", {.every = milliseconds(20)}, true, milliseconds(20)},
      {"saleae.csv", "a table of Saleae Logic 2", {}, true, milliseconds(28)},
      {"saleae1.csv", "a table of Saleae Logic", {}, true, milliseconds(28)},
      {"sigrok.json", "a trace of sigrok-cli", {}, true, milliseconds(28)},
      {"sigrok.txt", "a decode of sigrok-cli", {.sample_rate = 1e6}, true, milliseconds(28)},
      {"user.pcap", "packets of a serial line", {}, true, milliseconds(34)},
      {"user.pcapng", "packets of a serial line", {}, true, milliseconds(34)},
      {"rtac.pcap", "packets of a serial line", {}, true, milliseconds(34)},
      {"tcp.pcap", "packets of TCP", {}, false, milliseconds(34)},
      {"tcp6.pcapng", "packets of TCP", {}, false, milliseconds(34)},
      {"null.pcap", "packets of TCP", {}, false, milliseconds(34)},
      {"raw.pcap", "packets of TCP", {}, false, milliseconds(34)},
      {"cooked.pcap", "packets of TCP", {}, false, milliseconds(34)},
      {"cooked2.pcap", "packets of TCP", {}, false, milliseconds(34)},
  };
  for (const FileCase& one : cases) {
    SCOPED_TRACE(one.name);
    const Capture capture = read_file(one.name, one.settings);
    EXPECT_EQ(capture.notes.format, one.format);
    EXPECT_EQ(capture.notes.is_side_inferred, one.is_side_inferred);
    EXPECT_EQ(capture.notes.bytes_of_no_frame, 0U);
    EXPECT_EQ(capture.notes.unasked, 0U);
    ASSERT_EQ(capture.exchanges.size(), 3U);
    EXPECT_EQ(capture.exchanges[0].request, kAskVersion);
    EXPECT_EQ(capture.exchanges[0].reply, kVersion);
    EXPECT_EQ(capture.exchanges[1].request, kSetSpeed);
    EXPECT_EQ(capture.exchanges[1].reply, kSetSpeed);
    EXPECT_EQ(capture.exchanges[2].request, kAskSpeed);
    EXPECT_EQ(capture.exchanges[2].reply, kSpeed);
    EXPECT_EQ(capture.exchanges[0].at.count(), 0);
    EXPECT_LT(std::chrono::abs(capture.exchanges[1].at - *one.second_at), milliseconds(1));
  }
}

/// A log of one adapter, with times of `step` between pieces of `size` bytes.
std::string lumps(const CapturedBytes& bytes, std::size_t size) {
  std::string text;
  char word[32];
  for (std::size_t i = 0; i < bytes.size(); i += size) {
    std::snprintf(word, sizeof word, "%.3f ", static_cast<double>(i) / 1000);
    text += word;
    for (std::size_t k = i; k < std::min(bytes.size(), i + size); ++k) {
      std::snprintf(word, sizeof word, " %02x", bytes[k]);
      text += word;
    }
    text += "\n";
  }
  return text;
}

TEST(ForeignCapture, IsReadWhereverAnAdapterCutsIt) {
  CapturedBytes all;
  for (int i = 0; i < 4; ++i)
    for (const CapturedBytes& one : {kAskVersion, kVersion, kSetSpeed, kSetSpeed, kAskSpeed, kSpeed})
      all.insert(all.end(), one.begin(), one.end());
  for (std::size_t size = 1; size <= all.size(); ++size) {
    const Capture capture = read_text(lumps(all, size), {.pattern = "{time} {hex}"});
    ASSERT_EQ(capture.exchanges.size(), 12U) << "pieces of " << size;
    EXPECT_EQ(capture.notes.bytes_of_no_frame, 0U);
    for (std::size_t i = 0; i < capture.exchanges.size(); ++i)
      EXPECT_EQ(capture.exchanges[i].reply, i % 3 == 0 ? kVersion : i % 3 == 1 ? kSetSpeed : kSpeed);
  }
}

TEST(ForeignCapture, CountsStrayBytesAndMakesNoWrongExchange) {
  CapturedBytes all;
  for (int i = 0; i < 10; ++i)
    for (const CapturedBytes& one : {kAskVersion, kVersion, kSetSpeed, kSetSpeed, kAskSpeed, kSpeed})
      all.insert(all.end(), one.begin(), one.end());
  std::mt19937 random(40);
  for (int round = 0; round < 200; ++round) {
    CapturedBytes torn = all;
    const std::size_t lost = 30 + random() % (all.size() - 60);
    torn.erase(torn.begin() + static_cast<std::ptrdiff_t>(lost));
    const Capture capture = read_text(lumps(torn, 1 + random() % 20), {.pattern = "{time} {hex}"});
    EXPECT_GT(capture.notes.bytes_of_no_frame, 0U);
    EXPECT_GE(capture.exchanges.size(), 29U);
    for (const Exchange& exchange : capture.exchanges) {
      if (exchange.reply.empty()) {
        EXPECT_TRUE(exchange.has_broken_reply || exchange.follows_loss) << round;
        continue;
      }
      const CapturedBytes& expected = exchange.request == kAskVersion ? kVersion
                                      : exchange.request == kSetSpeed ? kSetSpeed
                                                                      : kSpeed;
      EXPECT_EQ(exchange.reply, expected) << round;
    }
  }
}

TEST(ForeignCapture, RestoresALostWriteFromItsReply) {
  const std::string log =
      "0.000 > 01 03 00 01 00 02 95 CB\n0.010 < 01 03 04 C0 01 00 98 96 59\n"
      "0.020 > 01 06 10 02 3C 2C DB\n0.030 < 01 06 10 02 00 3C 2C DB\n"
      "0.040 > 01 03 10 02 00 01 21 0A\n0.050 < 01 03 02 00 3C B8 55\n";
  const Capture capture = read_text(log, {.pattern = "{time} {dir} {hex}"});
  ASSERT_EQ(capture.exchanges.size(), 3U);
  EXPECT_EQ(capture.exchanges[1].request, kSetSpeed);
  EXPECT_EQ(capture.notes.restored_requests, 1U);
  EXPECT_EQ(capture.notes.bytes_of_no_frame, 7U);
  EXPECT_FALSE(capture.exchanges[2].follows_loss);
}

TEST(ForeignCapture, KnowsNothingAfterALostWriteOfSeveral) {
  const std::string log =
      "0.000 > 01 03 00 01 00 02 95 CB\n0.010 < 01 03 04 C0 01 00 98 96 59\n"
      "0.020 > 01 10 10 02 00 01 02 3C 00 00\n"
      "0.040 > 01 03 10 02 00 01 21 0A\n0.050 < 01 03 02 00 3C B8 55\n";
  const Capture capture = read_text(log, {.pattern = "{time} {dir} {hex}"});
  ASSERT_EQ(capture.exchanges.size(), 2U);
  EXPECT_EQ(capture.notes.lost_requests, 1U);
  EXPECT_FALSE(capture.exchanges[0].follows_loss);
  EXPECT_TRUE(capture.exchanges[1].follows_loss);
}

TEST(ForeignCapture, OfLinesOfTextHasTheirReplies) {
  const std::string log =
      "10:00:00.000 < 3F 50 41\n10:00:00.010 < 0D\n10:00:00.020 > 31 30 0D\n10:00:00.030 > 0A\n"
      "10:00:01.000 < 3F 50 42 0D 0A\n10:00:01.020 > 35 0D 0A\n";
  const Capture capture = read_text(log, {.is_text = true, .pattern = "{time} {dir} {hex}"});
  ASSERT_EQ(capture.exchanges.size(), 2U);
  const auto text = [](const CapturedBytes& bytes) { return std::string(bytes.begin(), bytes.end()); };
  EXPECT_EQ(text(capture.exchanges[0].request), "?PA\r");
  EXPECT_EQ(text(capture.exchanges[0].reply), "10\r\n");
  EXPECT_EQ(text(capture.exchanges[1].request), "?PB\r");
  EXPECT_EQ(capture.exchanges[1].at, SimTime(std::chrono::seconds(1)));
  EXPECT_NE(
      diagnostic("1 3F 0D\n", {.is_text = true, .pattern = "{time} {hex}"}).find("does not tell who sent"),
      std::string::npos);
}

TEST(ForeignCapture, SaysWhatItLacksInOneLine) {
  const std::string request = "0.1 > 01 03 10 02 00 01 21 0A\n";
  const std::string pattern = "{time} {dir} {hex}";
  const struct {
    std::string text;
    CaptureSettings settings;
    std::string what;
  } cases[] = {
      {"[01][03][10][02][00][01][21][0A]\n", {}, "c.txt:1: has no times; expected a log with times"},
      {"100-200 uart-1: 01\n", {}, "c.txt:1: counts samples; expected --sample-rate"},
      {request + "0.2 > 01 03 10 02 00 01 21 0A\n", {.pattern = pattern}, "has 2 requests, but no reply"},
      {"0.2 > 01 03 10 02 00 01 21 0A\n" + request,
       {.pattern = pattern},
       "c.txt:2: the time of these bytes is before"},
      {"0.1 > 50 41 0D\n", {.pattern = pattern}, "has 3 bytes, but no frame of Modbus"},
      {"hello\n", {}, "is not a known capture; expected one of"},
      {"hello\n", {.pattern = pattern}, "none of its 1 lines fits --pattern"},
      {"hello\n", {.pattern = "{tme} {hex}"}, "--pattern: '{tme}' is not a field; expected {time}"},
      {"hello\n", {.pattern = "{time}"}, "--pattern: '{time}' has no bytes; expected {hex}"},
      {"", {}, "is not a known capture"},
  };
  for (const auto& one : cases) {
    const std::string reported = diagnostic(one.text, one.settings);
    EXPECT_NE(reported.find(one.what), std::string::npos) << reported;
    EXPECT_EQ(reported.find('\n'), std::string::npos);
  }
}

TEST(ForeignCapture, SaysThatAPatternFitsNoLine) {
  const std::string log = "\n12.5 tx 01 03 00 01 00 01 D5 CA\n12.6 rx 01 03 02 C0 01 29 84\n";
  const auto diagnostic = [&](const std::string& pattern) -> std::string {
    std::istringstream file(log);
    try {
      read_capture(file, "c.txt", {.pattern = pattern});
    } catch (const CaptureReadError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(diagnostic("{time} {dir} {hex}"), "");
  EXPECT_EQ(
      diagnostic("{time} {dir}: {hex}"),
      "c.txt: none of its 3 lines fits --pattern '{time} {dir}: {hex}'; expected a pattern of whole lines "
      "such as '12.5 tx 01 03 00 01 00 01 D5 CA'");
}

TEST(LogTime, TakesWhatLogsBeginWith) {
  using namespace std::chrono;
  const SimTime day = sys_days(year(2026) / 11 / 28).time_since_epoch();
  const struct {
    std::string text;
    SimTime at;
    std::size_t size;
  } cases[] = {
      {"0.125 x", milliseconds(125), 5},
      {"1795899635.210017 x", seconds(1795899635) + microseconds(210017), 17},
      {"14:03:07.125 x", hours(14) + minutes(3) + seconds(7) + milliseconds(125), 12},
      {"2026-11-28 14:03:07,125 x", day + hours(14) + minutes(3) + seconds(7) + milliseconds(125), 23},
      {"2026/11/28 14:03:07.000000125 x", day + hours(14) + minutes(3) + seconds(7) + nanoseconds(125), 29},
      {"2026-11-28T14:03:07Z x", day + hours(14) + minutes(3) + seconds(7), 20},
      {"Jan  2 00:00:01 x", sys_days(year(2000) / 1 / 2).time_since_epoch() + seconds(1), 15},
      {"12 x", seconds(12), 2},
  };
  for (const auto& one : cases) {
    const auto taken = take_log_time(one.text);
    ASSERT_TRUE(taken) << one.text;
    EXPECT_EQ(taken->at, one.at) << one.text;
    EXPECT_EQ(taken->size, one.size) << one.text;
  }
  for (const std::string text : {"x", "", "2026-13-28 00:00:00", "14:3", ".5", "99999999999"})
    EXPECT_FALSE(take_log_time(text)) << text;
}

TEST(LogPattern, TakesBytesInAllForms) {
  const CapturedBytes expected{1, 3, 0xC0};
  for (const std::string text : {"01 03 c0", "0x1 0x3 0xc0", "01:03:C0", "0103C0", "[01][03][C0]", "01,03,C0",
                                 "\\x01\\x03\\xc0", "<01><03><C0>"}) {
    CapturedBytes bytes;
    EXPECT_GT(take_hex(text, bytes), 0U) << text;
    EXPECT_EQ(bytes, expected) << text;
  }
  for (const std::string text : {"", "hello", "1", "deadline", "012"}) {
    CapturedBytes bytes;
    EXPECT_EQ(take_hex(text, bytes), 0U) << text;
  }
}

}  // namespace foreign_captures_test
}  // namespace understudy::emulator::box
