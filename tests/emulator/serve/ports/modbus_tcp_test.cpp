// Modbus TCP to RTU and back. The frames are those of the two standards, written out by hand.
#include "emulator/serve/ports/modbus_tcp.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string_view>

#include "pty/ascii_frame.h"
#include "pty/rtu_crc.h"
#include "tests/pty/pty_host.h"

namespace understudy::emulator::serve {
namespace modbus_tcp_test {

using pty::hex;
using Bytes = ModbusTcp::Bytes;

// A read of one register at 1 of station 1, and a station's reply.
const Bytes kRequest = hex("12 34 00 00 00 06 01 03 00 01 00 01");
const Bytes kFrame = hex("01 03 00 01 00 01 D5 CA");
const Bytes kReplyFrame = hex("01 03 02 C0 01 29 84");
const Bytes kReply = hex("12 34 00 00 00 05 01 03 02 C0 01");
constexpr std::size_t kRoom = 256;  // the line's time for any frame
const Bytes kNobody = hex("12 34 00 00 00 03 01 83 0B");

Bytes with_transaction(Bytes message, std::uint8_t low) {
  message[1] = low;
  return message;
}

TEST(ModbusTcp, MakesAFrameOfARequestAndAnAnswerOfAReply) {
  ModbusTcp gateway;
  EXPECT_TRUE(gateway.receive_from_client(kRequest));
  EXPECT_EQ(gateway.take_for_line(kRoom), kFrame);
  EXPECT_TRUE(gateway.waits());
  EXPECT_EQ(gateway.take_for_client(), Bytes{});
  gateway.receive_from_line(kReplyFrame);
  EXPECT_EQ(gateway.take_for_client(), kReply);
  EXPECT_FALSE(gateway.waits());
}

/// The gateway waits for the frames on the wire, so its patience depends on their size.
TEST(ModbusTcp, KnowsTheSizeOfARequestAndItsReply) {
  struct Case {
    const char* request;
    std::size_t bytes;
  };
  for (const Case& c :
       {Case{"01 00 00 00 09", 8 + 7}, Case{"03 00 01 00 01", 8 + 7}, Case{"04 00 00 00 7D", 8 + 255},
        Case{"03 00 01 FF FF", 8 + 256}, Case{"06 00 01 00 01", 8 + 8},
        Case{"10 00 01 00 01 02 00 07", 11 + 8}, Case{"16 00 00 00 F2 00 25", 10 + 10},
        Case{"17 00 00 00 02 00 01 00 01 02 00 09", 15 + 9}, Case{"11", 4 + 256}}) {
    const Bytes pdu = hex(c.request);
    Bytes message = hex("12 34 00 00 00 00 01");
    message[5] = static_cast<std::uint8_t>(pdu.size() + 1);
    message.insert(message.end(), pdu.begin(), pdu.end());
    ModbusTcp gateway;
    ASSERT_TRUE(gateway.receive_from_client(message));
    EXPECT_EQ(gateway.exchange_bytes(), 0U);
    gateway.take_for_line(kRoom);
    EXPECT_EQ(gateway.exchange_bytes(), c.bytes) << c.request;
  }
}

TEST(ModbusTcp, KnowsThatAsciiFramesAreLonger) {
  const Bytes message = hex("12 34 00 00 00 06 01 03 00 01 00 01");
  ModbusTcp gateway({.is_ascii = true});
  ASSERT_TRUE(gateway.receive_from_client(message));
  const std::size_t request = gateway.take_for_line(pty::kAsciiMaxFrame).size();
  EXPECT_EQ(request, std::string_view(":010300010001FA\r\n").size());
  EXPECT_EQ(gateway.exchange_bytes(), request + std::string_view(":0103020000FA\r\n").size());
}

TEST(ModbusTcp, TakesBothInPiecesOfAnySize) {
  for (std::size_t piece = 1; piece < kRequest.size(); ++piece) {
    ModbusTcp gateway;
    for (std::size_t at = 0; at < kRequest.size(); at += piece) {
      EXPECT_EQ(gateway.take_for_line(kRoom), Bytes{}) << at;
      EXPECT_TRUE(gateway.receive_from_client(
          std::span(kRequest).subspan(at, std::min(piece, kRequest.size() - at))));
    }
    EXPECT_EQ(gateway.take_for_line(kRoom), kFrame) << piece;
    for (std::size_t at = 0; at < kReplyFrame.size(); at += piece) {
      EXPECT_EQ(gateway.take_for_client(), Bytes{}) << at;
      gateway.receive_from_line(std::span(kReplyFrame).subspan(at, std::min(piece, kReplyFrame.size() - at)));
    }
    EXPECT_EQ(gateway.take_for_client(), kReply) << piece;
  }
}

TEST(ModbusTcp, HasOneRequestAtATimeOnTheLine) {
  ModbusTcp gateway;
  Bytes three;
  for (const std::uint8_t low : {1, 2, 3}) {
    const Bytes one = with_transaction(kRequest, low);
    three.insert(three.end(), one.begin(), one.end());
  }
  EXPECT_TRUE(gateway.receive_from_client(three));
  for (const std::uint8_t low : {1, 2, 3}) {
    EXPECT_EQ(gateway.take_for_line(kRoom), kFrame);
    EXPECT_EQ(gateway.take_for_line(kRoom), Bytes{}) << "another request is on the line";
    gateway.receive_from_line(kReplyFrame);
    EXPECT_EQ(gateway.take_for_client(), with_transaction(kReply, low));
  }
  EXPECT_EQ(gateway.take_for_line(kRoom), Bytes{});
}

TEST(ModbusTcp, KnowsWhereEachReplyEnds) {
  struct Case {
    const char* request;
    const char* frame;
    const char* answer;
  };
  for (const Case& c : {
           Case{"00 01 00 00 00 06 11 05 00 AC FF 00", "11 05 00 AC FF 00 4E 8B",
                "00 01 00 00 00 06 11 05 00 AC FF 00"},
           Case{"00 01 00 00 00 06 11 06 00 01 00 03", "11 06 00 01 00 03 9A 9B",
                "00 01 00 00 00 06 11 06 00 01 00 03"},
           Case{"00 01 00 00 00 0B 11 10 00 01 00 02 04 00 0A 01 02", "11 10 00 01 00 02 12 98",
                "00 01 00 00 00 06 11 10 00 01 00 02"},
           Case{"00 01 00 00 00 06 0A 01 04 A1 00 01", "0A 81 02 B0 53", "00 01 00 00 00 03 0A 81 02"},
           // A function whose replies have no length of their own: they end at the first correct checksum.
           Case{"00 01 00 00 00 02 01 41", "01 41 07 08 52 3A", "00 01 00 00 00 04 01 41 07 08"},
       }) {
    ModbusTcp gateway;
    EXPECT_TRUE(gateway.receive_from_client(hex(c.request)));
    gateway.take_for_line(kRoom);
    for (const std::uint8_t byte : hex(c.frame)) {
      EXPECT_EQ(gateway.take_for_client(), Bytes{});
      gateway.receive_from_line(std::array{byte});
    }
    EXPECT_EQ(gateway.take_for_client(), hex(c.answer)) << c.request;
  }
}

TEST(ModbusTcp, ReportsAStationThatDoesNotAnswer) {
  ModbusTcp gateway;
  EXPECT_TRUE(gateway.receive_from_client(kRequest));
  gateway.take_for_line(kRoom);
  gateway.give_up();
  EXPECT_EQ(gateway.take_for_client(), kNobody);
  EXPECT_FALSE(gateway.waits());
  gateway.receive_from_line(kReplyFrame);  // too late
  EXPECT_EQ(gateway.take_for_client(), Bytes{});
  gateway.give_up();
  EXPECT_EQ(gateway.take_for_client(), Bytes{}) << "there was no request";
}

TEST(ModbusTcp, PassesOnNothingButTheReply) {
  const Bytes of_station_2 = hex("02 03 02 C0 01 6D 84");
  const Bytes garbled = hex("01 03 02 C0 02 29 84");
  const Bytes of_function_6 = hex("01 06 10 02 00 C8 2D 5C");
  for (const Bytes& other : {of_station_2, garbled, of_function_6}) {
    ModbusTcp gateway;
    EXPECT_TRUE(gateway.receive_from_client(kRequest));
    gateway.take_for_line(kRoom);
    gateway.receive_from_line(other);
    EXPECT_EQ(gateway.take_for_client(), Bytes{});
    gateway.receive_from_line(kReplyFrame);
    EXPECT_EQ(gateway.take_for_client(), kReply);
  }
}

TEST(ModbusTcp, LeavesABroadcastUnanswered) {
  ModbusTcp gateway;
  EXPECT_TRUE(gateway.receive_from_client(hex("12 34 00 00 00 06 00 06 10 02 00 C8")));
  EXPECT_EQ(gateway.take_for_line(kRoom), hex("00 06 10 02 00 C8 2C 8D"));
  EXPECT_TRUE(gateway.is_broadcast());
  gateway.give_up();
  EXPECT_EQ(gateway.take_for_client(), Bytes{});
  EXPECT_FALSE(gateway.waits());
}

TEST(ModbusTcp, PassesOverAnotherProtocol) {
  ModbusTcp gateway;
  EXPECT_TRUE(gateway.receive_from_client(hex("00 01 00 07 00 03 01 02 03")));
  EXPECT_TRUE(gateway.receive_from_client(kRequest));
  EXPECT_EQ(gateway.take_for_line(kRoom), kFrame);
}

TEST(ModbusTcp, LetsALengthGoThatNoRequestHas) {
  for (const char* length : {"00 00", "00 01", "00 FF", "FF FF"}) {
    ModbusTcp gateway;
    EXPECT_FALSE(gateway.receive_from_client(hex("00 01 00 00 " + std::string(length)))) << length;
    ModbusTcp later;
    Bytes both = kRequest;
    const Bytes wrong = hex("00 01 00 00 " + std::string(length));
    both.insert(both.end(), wrong.begin(), wrong.end());
    EXPECT_FALSE(later.receive_from_client(both)) << length;
  }
  ModbusTcp gateway;
  EXPECT_TRUE(gateway.receive_from_client(hex("00 01 00 00 00 FE")));
}

// Cut anywhere, with anything received after it: a refused message never goes to the line.
TEST(ModbusTcp, NeverServesWhatItHasRefused) {
  for (const char* length : {"00 00", "00 01", "00 FF", "01 2C", "FF FF"}) {
    for (const bool has_good : {false, true}) {
      Bytes sent = has_good ? kRequest : Bytes{};
      const Bytes wrong = hex("00 01 00 00 " + std::string(length));
      sent.insert(sent.end(), wrong.begin(), wrong.end());
      sent.resize(sent.size() + 300);
      for (std::size_t cut = 1; cut <= sent.size(); ++cut) {
        ModbusTcp gateway;
        const bool is_refused = cut >= (has_good ? kRequest.size() : 0) + wrong.size();
        EXPECT_EQ(gateway.receive_from_client(std::span(sent).first(cut)), !is_refused)
            << length << " " << cut;
        if (is_refused) {
          EXPECT_FALSE(gateway.receive_from_client(std::span(sent).subspan(cut)));
          EXPECT_FALSE(gateway.receive_from_client(kRequest));
        }
        const bool is_served = has_good && cut >= kRequest.size();
        EXPECT_EQ(gateway.take_for_line(kRoom), is_served ? kFrame : Bytes{}) << length << " " << cut;
        gateway.give_up();
        gateway.take_for_client();
        EXPECT_EQ(gateway.take_for_line(kRoom), Bytes{}) << length << " " << cut;
      }
    }
  }
}

TEST(ModbusTcp, HasRoomForSoMuch) {
  ModbusTcp gateway;
  for (int i = 0; gateway.has_room(); ++i) {
    ASSERT_LT(i, 1000);
    EXPECT_TRUE(gateway.receive_from_client(kRequest));
  }
  while (!gateway.take_for_line(kRoom).empty()) {
    gateway.give_up();
    EXPECT_FALSE(gateway.take_for_client().empty());
  }
  EXPECT_TRUE(gateway.has_room());
}

TEST(ModbusTcp, WaitsUntilItsAnswerIsTaken) {
  ModbusTcp gateway;
  EXPECT_TRUE(gateway.receive_from_client(kRequest));
  EXPECT_TRUE(gateway.receive_from_client(kRequest));
  gateway.take_for_line(kRoom);
  gateway.receive_from_line(kReplyFrame);
  EXPECT_EQ(gateway.take_for_line(kRoom), Bytes{}) << "the reply has not been taken";
  EXPECT_EQ(gateway.take_for_client(), kReply);
  EXPECT_EQ(gateway.take_for_line(kRoom), kFrame);
}

// Whatever arrives from both sides, frames have their checksum and replies their length, and nothing grows.
TEST(ModbusTcp, StaysWholeWhateverItReceives) {
  std::mt19937 random(20'261'124);
  const std::array pieces{kRequest,
                          kReplyFrame,
                          hex("00 01 00 00 00 06 00 06 10 02 00 C8"),
                          hex("00 02 00 09 00 03 01 03 05"),
                          hex("00 03 00 00 00 02 01 41"),
                          hex("01 83 02 C0 F1"),
                          hex("00 04 00 00 00 FE 07")};
  ModbusTcp gateway;
  int frames = 0;
  for (int i = 0; i < 200'000; ++i) {
    Bytes piece = pieces[random() % pieces.size()];
    if (random() % 4 == 0) piece[random() % piece.size()] = static_cast<std::uint8_t>(random());
    piece.resize(1 + random() % piece.size());
    const unsigned what = random() % 8;
    if (what < 4 && gateway.has_room() && !gateway.receive_from_client(piece)) gateway = ModbusTcp();
    if (what >= 4 && what < 7) gateway.receive_from_line(piece);
    if (what == 7) gateway.give_up();
    const Bytes frame = gateway.take_for_line(kRoom);
    if (!frame.empty()) {
      ++frames;
      ASSERT_TRUE(pty::rtu_crc_ok(frame));
      ASSERT_TRUE(gateway.waits());
    }
    const Bytes answer = gateway.take_for_client();
    if (answer.empty()) continue;
    ASSERT_EQ(answer.size(), 6U + answer[5]) << "one, because one request was on the line";
    ASSERT_LE(answer.size(), 260U);
  }
  EXPECT_GT(frames, 1'000);
}

}  // namespace modbus_tcp_test
}  // namespace understudy::emulator::serve
