// A serial port over telnet. Both sides of the dialogues are written out by hand from RFC 854, 855 and 2217.
#include "emulator/serve/ports/rfc2217.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/pty/pty_host.h"

namespace understudy::emulator::serve {
namespace rfc2217_test {

using pty::hex;
using pty::HostSettings;
using pty::Parity;
using Bytes = Rfc2217::Bytes;

constexpr pty::LineSettings kLine{.baud = 19200, .data_bits = 8, .parity = Parity::even, .stop_bits = 1};
constexpr std::size_t kRoom = 1024;

// WILL and DO of BINARY and SUPPRESS-GO-AHEAD, and DO of COM-PORT-OPTION.
const Bytes kGreeting = hex("FF FD 00 FF FB 00 FF FD 03 FF FB 03 FF FD 2C");
// pyserial's replies to that, of which some tell us nothing new.
const Bytes kAgreement = hex("FF FB 00 FF FD 00 FF FB 03 FF FD 03 FF FB 2C");
const Bytes kModemReady = hex("FF FA 2C 6B B0 FF F0");

/// Passes everything to the line, which accepts `room` bytes at a time.
Bytes line_bytes(Rfc2217& port, std::size_t room = kRoom) {
  Bytes all;
  for (Bytes some = port.take_for_line(room); !some.empty(); some = port.take_for_line(room)) {
    EXPECT_LE(some.size(), room);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// A port that has agreed with its client on all options.
Rfc2217 agreed() {
  Rfc2217 port(kLine);
  EXPECT_EQ(port.take_for_client(), kGreeting);
  EXPECT_TRUE(port.receive_from_client(kAgreement));
  EXPECT_EQ(line_bytes(port), Bytes{});
  EXPECT_EQ(port.take_for_client(), kModemReady);
  return port;
}

/// The reply to that.
Bytes answer(Rfc2217& port, const Bytes& sent) {
  EXPECT_TRUE(port.receive_from_client(sent));
  EXPECT_EQ(line_bytes(port), Bytes{});
  return port.take_for_client();
}

/// A subnegotiation of COM-PORT-OPTION.
Bytes com_port(const std::string& body) { return hex("FF FA 2C " + body + " FF F0"); }

TEST(Rfc2217, CarriesEveryByteInBothDirections) {
  Rfc2217 port = agreed();
  Bytes all;
  Bytes escaped;
  for (int i = 0; i < 256; ++i) {
    all.push_back(static_cast<std::uint8_t>(i));
    escaped.push_back(static_cast<std::uint8_t>(i));
    if (i == 255) escaped.push_back(255);
  }
  EXPECT_TRUE(port.receive_from_client(escaped));
  EXPECT_EQ(line_bytes(port), all);
  port.receive_from_line(all);
  EXPECT_EQ(port.take_for_client(), escaped);
}

TEST(Rfc2217, AnswersEachCommandWithWhatIsInEffect) {
  struct Case {
    const char* sent;
    const char* answer;
    HostSettings host;
  };
  const HostSettings kAtFirst{.baud = 19200, .stop_bits = 1, .data_bits = 8, .parity = Parity::even};
  const auto with = [&](auto change) {
    HostSettings host = kAtFirst;
    change(host);
    return host;
  };
  const std::vector<Case> cases = {
      // 0 is a query; 9600; faster than any; too short to be valid.
      {"01 00 00 00 00", "65 00 00 4B 00", kAtFirst},
      {"01 00 00 25 80", "65 00 00 25 80", with([](HostSettings& h) { h.baud = 9600; })},
      {"01 FF FF FF FF FF FF FF FF", "65 00 00 4B 00", kAtFirst},  // each 255 is sent twice
      {"01 25 80", "", kAtFirst},
      {"02 00", "66 08", kAtFirst},
      {"02 07", "66 07", with([](HostSettings& h) { h.data_bits = 7; })},
      {"02 09", "66 08", kAtFirst},
      {"03 00", "67 03", kAtFirst},
      {"03 01", "67 01", with([](HostSettings& h) { h.parity = Parity::none; })},
      {"03 02", "67 02", with([](HostSettings& h) { h.parity = Parity::odd; })},
      {"03 04", "67 04", with([](HostSettings& h) { h.parity = Parity::mark; })},
      {"03 05", "67 05", with([](HostSettings& h) { h.parity = Parity::space; })},
      {"03 06", "67 03", kAtFirst},
      {"04 00", "68 01", kAtFirst},
      {"04 02", "68 02", with([](HostSettings& h) { h.stop_bits = 2; })},
      {"04 03", "68 01", kAtFirst},
      // Flow control: a query, hardware, by DCD, which does not exist. DTR, RTS, inbound flow.
      {"05 00", "69 01", kAtFirst},
      {"05 03", "69 03", kAtFirst},
      {"05 11", "69 01", kAtFirst},
      {"05 04", "69 06", kAtFirst},
      {"05 07", "69 08", kAtFirst},
      {"05 09", "69 09", kAtFirst},
      {"05 0A", "69 0B", kAtFirst},
      {"05 0C", "69 0C", kAtFirst},
      {"05 0D", "69 0E", kAtFirst},
      {"05 10", "69 10", kAtFirst},
      {"06", "6A 60", kAtFirst},
      {"07", "6B B0", kAtFirst},
      {"0A 10", "6E 10", kAtFirst},
      {"0B 00", "6F 00", kAtFirst},
      {"0C 01", "70 01", kAtFirst},
      {"00", "64 75 6E 64 65 72 73 74 75 64 79", kAtFirst},  // "understudy"
      {"00 68 6F 73 74", "", kAtFirst},                      // its own signature
      {"0D 01", "", kAtFirst},
      {"", "", kAtFirst},
  };
  for (const Case& c : cases) {
    Rfc2217 port = agreed();
    const std::string expected(c.answer);
    EXPECT_EQ(answer(port, com_port(c.sent)), expected.empty() ? Bytes{} : com_port(expected)) << c.sent;
    EXPECT_EQ(port.settings(), c.host) << c.sent;
  }
}

TEST(Rfc2217, ReportsTheMaskedModemStateBehindTheMask) {
  Rfc2217 port = agreed();
  EXPECT_EQ(answer(port, com_port("0B 10")), hex("FF FA 2C 6F 10 FF F0 FF FA 2C 6B 10 FF F0"));
}

// A setting applies to the data written after it.
TEST(Rfc2217, KeepsSettingsAndBytesInTheirOrder) {
  Rfc2217 port = agreed();
  Bytes sent{0x41};
  for (const Bytes& more :
       {com_port("03 01"), Bytes{0x42}, com_port("02 07"), com_port("04 02"), Bytes{0x43}})
    sent.insert(sent.end(), more.begin(), more.end());
  EXPECT_TRUE(port.receive_from_client(sent));
  EXPECT_EQ(port.take_for_line(kRoom), Bytes{0x41});
  EXPECT_EQ(port.settings()->parity, Parity::even);
  EXPECT_EQ(port.take_for_line(kRoom), Bytes{0x42});
  EXPECT_EQ(port.settings()->parity, Parity::none);
  EXPECT_EQ(port.settings()->data_bits, 8);
  EXPECT_EQ(port.take_for_line(kRoom), Bytes{0x43});
  EXPECT_EQ(port.settings()->data_bits, 7);
  EXPECT_EQ(port.settings()->stop_bits, 2);
}

TEST(Rfc2217, UnderstandsWhatComesInPiecesOfAnySize) {
  Bytes sent = kAgreement;
  for (const Bytes& more : {hex("01 FF FF 03"), com_port("01 00 00 25 80"), hex("02"), com_port("05 05"),
                            hex("FF FB 18 FF FD 05 FF F6 03")})
    sent.insert(sent.end(), more.begin(), more.end());
  const Bytes received = hex("01 FF 03 02 00 03");  // the 0 is the break
  Bytes first;
  for (std::size_t piece = 1; piece <= sent.size(); ++piece) {
    Rfc2217 port(kLine);
    Bytes line;
    for (std::size_t at = 0; at < sent.size(); at += piece) {
      EXPECT_TRUE(port.receive_from_client(std::span(sent).subspan(at, std::min(piece, sent.size() - at))));
      const Bytes some = line_bytes(port, 1 + piece % 3);
      line.insert(line.end(), some.begin(), some.end());
    }
    EXPECT_EQ(line, received) << piece;
    const Bytes answers = port.take_for_client();
    if (piece == 1) first = answers;
    EXPECT_EQ(answers, first) << piece;
  }
}

// RFC 854: an option that is already on gets no reply, so there is no endless exchange; an unknown option is
// refused.
TEST(Rfc2217, NegotiatesWithoutEnd) {
  struct Case {
    const char* sent;
    const char* answer;
  };
  for (const Case& c : {Case{"FF FD 00", ""}, Case{"FF FB 2C", ""}, Case{"FF FD 2C", "FF FB 2C"},
                        Case{"FF FE 2C", ""}, Case{"FF FC 00", "FF FE 00"}, Case{"FF FE 00", "FF FC 00"},
                        Case{"FF FD 01", "FF FC 01"}, Case{"FF FB 18", "FF FE 18"}, Case{"FF FC 18", ""},
                        Case{"FF FE 01", ""}, Case{"FF F1", ""}, Case{"FF F6", "FF F1"}, Case{"FF F2", ""}}) {
    Rfc2217 port = agreed();
    EXPECT_EQ(answer(port, hex(c.sent)), hex(c.answer)) << c.sent;
  }
}

// A terminal sends a carriage return as two bytes, the second 0, and receives it in the same form.
TEST(Rfc2217, KnowsTheReturnOfThoseThatAreNotBinary) {
  Rfc2217 port(kLine);
  port.take_for_client();
  EXPECT_TRUE(port.receive_from_client(hex("FF FC 00 FF FE 00 41 0D 00 42 0D 0A 43 00 0D")));
  Bytes line = line_bytes(port);
  EXPECT_TRUE(port.receive_from_client(hex("00 44")));
  const Bytes rest = line_bytes(port);
  line.insert(line.end(), rest.begin(), rest.end());
  EXPECT_EQ(line, hex("41 0D 42 0D 0A 43 00 0D 44"));
  port.take_for_client();
  port.receive_from_line(hex("41 0D 42 0D 0A FF 0D"));
  EXPECT_EQ(port.take_for_client(), hex("41 0D 00 42 0D 0A FF FF 0D 00"));
}

TEST(Rfc2217, PassesOverWhatIsMalformed) {
  const Bytes kOverlong = [] {
    Bytes sent = hex("FF FA 2C 01");
    sent.insert(sent.end(), 20'000, 0x55);
    sent.insert(sent.end(), {0xFF, 0xFF, 0x55, 0xFF, 0xFF, 0xFF, 0xF0});
    return sent;
  }();
  struct Case {
    const char* what;
    Bytes sent;
    Bytes answer;
  };
  for (const Case& c :
       {Case{"of another option", hex("FF FA 18 01 FF F0"), {}},
        Case{"without anything", hex("FF FA FF F0 FF F0"), {}}, Case{"an end alone", hex("FF F0"), {}},
        Case{"broken off by a command", hex("FF FA 2C 03 01 FF FD 01"), hex("FF FC 01")},
        Case{"longer than any", kOverlong, {}}}) {
    Rfc2217 port = agreed();
    Bytes answers;
    for (std::size_t at = 0; at < c.sent.size(); at += 1000) {
      EXPECT_TRUE(port.receive_from_client(
          std::span(c.sent).subspan(at, std::min<std::size_t>(1000, c.sent.size() - at))));
      EXPECT_EQ(line_bytes(port), Bytes{}) << c.what;
      EXPECT_TRUE(port.has_room()) << c.what;
      const Bytes some = port.take_for_client();
      answers.insert(answers.end(), some.begin(), some.end());
    }
    EXPECT_EQ(answers, c.answer) << c.what;
    EXPECT_EQ(port.settings()->parity, Parity::even) << c.what;
    EXPECT_TRUE(port.receive_from_client(Bytes{0x7E}));
    EXPECT_EQ(line_bytes(port), Bytes{0x7E}) << c.what << ": the data after it are understood";
  }
}

TEST(Rfc2217, SaysABreakAsOneCharacter) {
  Rfc2217 port = agreed();
  Bytes sent = com_port("05 05");
  for (const Bytes& more :
       {com_port("05 05"), com_port("05 06"), Bytes{0x31}, com_port("05 05"), hex("FF F3")})
    sent.insert(sent.end(), more.begin(), more.end());
  EXPECT_TRUE(port.receive_from_client(sent));
  EXPECT_EQ(line_bytes(port), hex("00 31 00 00")) << "switching it on again is not a change";
}

TEST(Rfc2217, TakesBackAndThrowsAwayAsPurged) {
  struct Case {
    const char* sent;
    bool discards_input;
    bool discards_output;
  };
  for (const Case& c : {Case{"0C 01", false, true}, Case{"0C 02", true, false}, Case{"0C 03", true, true},
                        Case{"0C 04", false, false}}) {
    Rfc2217 port = agreed();
    EXPECT_TRUE(port.receive_from_client(com_port(c.sent)));
    EXPECT_EQ(port.take_for_line(0), Bytes{}) << "even if the line has no room";
    EXPECT_EQ(port.discards_input(), c.discards_input) << c.sent;
    EXPECT_EQ(port.discards_output(), c.discards_output) << c.sent;
    EXPECT_FALSE(port.discards_input() || port.discards_output()) << "once";
  }
}

TEST(Rfc2217, DoesNotListenWhileItIsAskedToWait) {
  Rfc2217 port = agreed();
  EXPECT_TRUE(port.listens());
  EXPECT_EQ(answer(port, com_port("08")), Bytes{});
  EXPECT_FALSE(port.listens());
  EXPECT_EQ(answer(port, com_port("09")), Bytes{});
  EXPECT_TRUE(port.listens());
}

// Bytes wait until the line has room, and replies until they are taken; no more than that is accepted.
TEST(Rfc2217, KeepsLittle) {
  Rfc2217 port = agreed();
  EXPECT_TRUE(port.receive_from_client(Bytes(4096, 0x41)));
  EXPECT_FALSE(port.has_room());
  EXPECT_EQ(port.take_for_line(100).size(), 100U);
  EXPECT_TRUE(port.has_room());
  Rfc2217 chatty = agreed();
  const Bytes asks = com_port("00");
  for (int i = 0; i < 300 && chatty.has_room(); ++i) {
    EXPECT_TRUE(chatty.receive_from_client(asks));
    EXPECT_EQ(line_bytes(chatty), Bytes{});
  }
  EXPECT_FALSE(chatty.has_room());
  EXPECT_LT(chatty.take_for_client().size(), 5000U);
  EXPECT_TRUE(chatty.has_room());
}

}  // namespace rfc2217_test
}  // namespace understudy::emulator::serve
