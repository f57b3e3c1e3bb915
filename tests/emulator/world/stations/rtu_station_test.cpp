// Frames in, frames out: the specification's wire examples, addresses, checksums (1.2 to 1.5).
#include "emulator/world/stations/rtu_station.h"

#include <gtest/gtest.h>

#include "emulator/device/register_map/register_bank.h"
#include "pty/line.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::world {
namespace rtu_station_test {

using namespace std::chrono_literals;
using pty::SimTime;

constexpr pty::RtuFraming kTolerant{.strict = false, .silence = 750us, .patience = 10ms};
constexpr pty::RtuFraming kStrict{.strict = true, .silence = 750us, .patience = 10ms};

DeviceSettings at_switch(int rotary_switch, std::map<std::string, std::string> choices = {}) {
  DeviceSettings settings;
  settings.address = rotary_switch;
  settings.choices = std::move(choices);
  return settings;
}

Bytes framed(std::uint8_t address, const Bytes& pdu) {
  Bytes frame;
  frame.push_back(address);
  for (const std::uint8_t byte : pdu) frame.push_back(byte);
  pty::append_rtu_crc(frame);
  return frame;
}

/// A single station that receives frames far apart.
struct StationRig final : pty::Transmitter {
  explicit StationRig(const DeviceSettings& settings = {}, pty::RtuFraming framing = kTolerant)
      : device(make_simple2(settings)), station(*device, 0, framing) {}

  void transmit(std::span<const std::uint8_t> bytes) override { sent.push_back(text(bytes)); }
  void answer(std::span<const std::uint8_t> bytes, std::uint64_t) override { transmit(bytes); }

  /// Sends a frame and waits. Returns what the station sent, one text for each transmission.
  std::vector<std::string> exchange(const Bytes& frame) {
    sent.clear();
    for (const std::uint8_t value : frame) {
      station.receive({.start = now, .end = now + 573us, .value = value});
      now += 573us;
    }
    for (int runs = 0; station.due(); ++runs) {
      now = std::max(now, *station.due());
      station.run(now, *this);
      if (runs < 1000) continue;
      ADD_FAILURE() << "it is always due";
      break;
    }
    now += 100ms;
    return sent;
  }

  bool is_untouched() const { return device->same_state(*make_simple2(device->settings())); }

  std::unique_ptr<Device> device;
  RtuStation station;
  std::vector<std::string> sent;
  SimTime now{0};
};

using Said = std::vector<std::string>;

TEST(WireExamples, AreAnsweredByteForByte) {
  struct Example {
    std::string_view meaning;
    std::string_view request;
    std::string_view reply;  // empty: the same as the request
  };
  const std::vector<Example> examples = {
      {"read HW_Code", "01 03 00 01 00 01 D5 CA", "01 03 02 C0 01 29 84"},
      {"Aaxis_Speed = 200", "01 06 10 02 00 C8 2D 5C", ""},
      {"Aaxis_Pulse = 32000, Speed 200, Acc 5, Dec 5",
       "01 10 10 00 00 05 0A 7D 00 00 00 00 C8 00 05 00 05 B3 F7", "01 10 10 00 00 05 04 CA"},
      {"Aaxis_Pulse = -500", "01 10 10 00 00 02 04 FE 0C FF FF CE 34", "01 10 10 00 00 02 45 08"},
      {"Aaxis_SVON = 1", "01 06 10 14 00 01 0C CE", ""},
      {"Aaxis_Move_INC = 1", "01 06 10 05 00 01 5C CB", ""},
      {"read Aaxis_Resoultion", "01 03 F0 02 00 02 56 CB", "01 03 04 0C 80 00 00 F8 8B"},
      {"function 05", "01 05 00 00 FF 00 8C 3A", "01 85 01 83 50"},
      {"read the hole 0x0003", "01 03 00 03 00 01 74 0A", "01 83 02 C0 F1"},
      {"Aaxis_AccTime = 3001", "01 06 10 03 0B B9 BB 88", "01 86 03 02 61"},
  };
  for (const pty::RtuFraming& framing : {kTolerant, kStrict}) {
    StationRig rig({}, framing);
    for (const Example& example : examples) {
      const std::string_view reply = example.reply.empty() ? example.request : example.reply;
      EXPECT_EQ(rig.exchange(hex(example.request)), Said{std::string(reply)}) << example.meaning;
    }
  }
}

TEST(WireExamples, TheStatusIsReadWithFunction04) {
  StationRig rig;
  EXPECT_EQ(rig.exchange(hex("01 04 00 00 00 01 31 CA")), Said{text(framed(1, hex("04 02 00 00")))});
  rig.exchange(hex("01 06 10 14 00 01 0C CE"));  // Aaxis_SVON: bit 10
  EXPECT_EQ(rig.exchange(hex("01 04 00 00 00 01 31 CA")), Said{text(framed(1, hex("04 02 04 00")))});
}

TEST(WireExamples, TheCoordinateOfThePrintedReplyIs32000) {
  StationRig rig;
  const auto cord_a = rig.device->register_bank()->find("Cord_A");
  ASSERT_TRUE(cord_a);
  rig.exchange(framed(1, hex("10 0E 04 00 02 04 7D 00 00 00")));
  EXPECT_EQ(rig.exchange(hex("01 03 0E 04 00 02 87 22")), Said{"01 03 04 7D 00 00 00 E2 5F"});
}

TEST(RtuStation, TheLongestReplyIsARightFrameOf255Bytes) {
  StationRig rig;
  const Said sent = rig.exchange(framed(1, read_pdu(3, 0x4000, 125)));
  ASSERT_EQ(sent.size(), 1u);
  const Bytes reply = hex(sent[0]);
  EXPECT_EQ(reply.size(), 255u);
  EXPECT_TRUE(pty::rtu_crc_ok(reply));
}

TEST(RtuStation, EverySingleWrongBitKeepsItSilentAndUnchanged) {
  for (const std::string_view example :
       {"01 06 10 02 00 C8 2D 5C", "01 10 10 00 00 02 04 FE 0C FF FF CE 34", "01 03 00 01 00 01 D5 CA"}) {
    for (const pty::RtuFraming& framing : {kTolerant, kStrict}) {
      StationRig rig({}, framing);
      const Bytes frame = hex(example);
      for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
        Bytes wrong = frame;
        wrong[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
        EXPECT_EQ(rig.exchange(wrong), Said{}) << example << " with bit " << bit << " wrong";
      }
      EXPECT_TRUE(rig.is_untouched()) << example;
      EXPECT_EQ(rig.station.counters().requests, 0u);
      EXPECT_EQ(rig.exchange(frame).size(), 1u) << "and it receives the next valid frame";
    }
  }
}

TEST(RtuStation, CutFramesAreSilent) {
  for (const pty::RtuFraming& framing : {kTolerant, kStrict}) {
    StationRig rig({}, framing);
    const Bytes frame = hex("01 10 10 00 00 02 04 FE 0C FF FF CE 34");
    for (std::size_t size = 1; size < frame.size(); ++size) {
      EXPECT_EQ(rig.exchange(Bytes(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size))), Said{})
          << size;
    }
    EXPECT_TRUE(rig.is_untouched());
  }
}

TEST(RtuStation, FramesForOthersAreNeitherAnsweredNorObeyed) {
  StationRig rig(at_switch(5));
  for (int address = 1; address <= 255; ++address) {
    if (address == 5) continue;
    EXPECT_EQ(rig.exchange(framed(static_cast<std::uint8_t>(address), hex("06 10 02 00 C8"))), Said{})
        << address;
  }
  EXPECT_TRUE(rig.is_untouched());
  EXPECT_EQ(rig.station.counters().requests, 0u);
  EXPECT_EQ(rig.exchange(framed(5, hex("06 10 02 00 C8"))), Said{text(framed(5, hex("06 10 02 00 C8")))});
}

TEST(RtuStation, EveryPositionOfTheRotarySwitchAnswersItsOwnNumber) {
  for (int position = 1; position <= 15; ++position) {
    StationRig rig(at_switch(position));
    const auto address = static_cast<std::uint8_t>(position);
    EXPECT_EQ(rig.exchange(framed(address, hex("03 00 01 00 01"))),
              Said{text(framed(address, hex("03 02 C0 01")))});
  }
}

TEST(RtuStation, ABroadcastIsObeyedInSilence) {
  StationRig rig(at_switch(5));
  EXPECT_EQ(rig.exchange(framed(0, hex("06 10 02 00 C8"))), Said{});
  EXPECT_EQ(rig.exchange(framed(0, hex("10 10 03 00 02 04 00 07 00 08"))), Said{});
  EXPECT_EQ(rig.exchange(framed(0, hex("03 10 02 00 01"))), Said{}) << "a read";
  EXPECT_EQ(rig.exchange(framed(0, hex("06 10 03 0B B9"))), Said{}) << "an exception";
  EXPECT_EQ(rig.exchange(framed(0, hex("05 00 00 FF 00"))), Said{}) << "an unknown function";
  EXPECT_EQ(read(*rig.device, 0x1002, 3), (Words{200, 7, 8}));
  EXPECT_EQ(rig.station.counters().requests, 5u);
  EXPECT_EQ(rig.station.counters().replies, 0u);
}

TEST(RtuStation, TheChoiceStation0RequestCanHaveBroadcastsIgnored) {
  StationRig rig(at_switch(5, {{"station_0_request", "ignored"}}));
  EXPECT_EQ(rig.exchange(framed(0, hex("06 10 02 00 C8"))), Said{});
  EXPECT_TRUE(rig.is_untouched());
  EXPECT_EQ(rig.station.counters().requests, 0u);
}

TEST(RtuStation, AtSwitch0EveryAddressIsAnsweredWithTheSameAddress) {
  StationRig rig(at_switch(0));
  for (int address = 0; address <= 255; ++address) {
    const auto byte = static_cast<std::uint8_t>(address);
    EXPECT_EQ(rig.exchange(framed(byte, hex("03 00 01 00 01"))),
              Said{text(framed(byte, hex("03 02 C0 01")))});
  }
  const auto speed = [&](int address) {
    rig.exchange(
        framed(static_cast<std::uint8_t>(address), write_request(0x1002, static_cast<std::size_t>(address))));
    return read(*rig.device, 0x1002, 1);
  };
  for (const int address : {247, 0, 1, 255})
    EXPECT_EQ(speed(address), Words{static_cast<std::uint16_t>(address)});
}

TEST(RtuStation, TheChoiceSwitch0BroadcastCanSilenceAddress0Alone) {
  StationRig rig(at_switch(0, {{"switch_0_broadcast", "silent"}}));
  EXPECT_EQ(rig.exchange(framed(0, hex("06 10 02 00 C8"))), Said{});
  EXPECT_EQ(read(*rig.device, 0x1002, 1), Words{200});
  EXPECT_EQ(rig.exchange(framed(1, hex("06 10 02 00 C9"))), Said{text(framed(1, hex("06 10 02 00 C9")))});
}

TEST(RtuStation, CountsRequestsRepliesAndExceptions) {
  StationRig rig;
  rig.exchange(hex("01 03 00 01 00 01 D5 CA"));
  rig.exchange(hex("01 03 00 03 00 01 74 0A"));
  rig.exchange(hex("01 05 00 00 FF 00 8C 3A"));
  rig.exchange(framed(0, hex("06 10 02 00 C8")));
  rig.exchange(framed(2, hex("06 10 02 00 C8")));
  rig.exchange(hex("01 03 00 01 00 01 D5 CB"));
  EXPECT_EQ(rig.station.counters().requests, 4u);
  EXPECT_EQ(rig.station.counters().replies, 3u);
  EXPECT_EQ(rig.station.counters().exceptions, 2u);
  EXPECT_EQ(rig.station.dropped_bytes(), 8u);
}

TEST(RtuStation, WhatItHalfHeardIsForgottenWhenAnotherStationSpeaks) {
  StationRig rig;
  const Bytes frame = hex("01 06 10 02 00 C8 2D 5C");
  for (std::size_t i = 0; i < 6; ++i) rig.station.receive({rig.now, rig.now, frame[i]});
  rig.station.on_other_station();
  EXPECT_FALSE(rig.station.due());
  EXPECT_EQ(rig.exchange(hex("2D 5C")), Said{});
  EXPECT_TRUE(rig.is_untouched());
}

// --- on a line: the meaning of silence (specification 1.1: END time, idle from stop bit to start bit) -----

/// Returns the reply to a frame that is sent in two parts with an idle gap between them.
std::string reply_to_split(const Bytes& frame, std::size_t first_part, SimTime gap, int baud) {
  DeviceSettings settings;
  settings.bauds = {baud};
  const auto device = make_simple2(settings);
  RtuStation station(*device, 0, kStrict);
  pty::Line line("line", {.settings = device->line_settings(0), .enforce_settings = false}, {});
  line.attach(station);
  const auto parts = std::span(frame);
  const SimTime second = device->line_settings(0).duration_of(static_cast<std::int64_t>(first_part)) + gap;
  line.receive(parts.first(first_part), 0ns);
  line.run(second - 1ns);
  line.receive(parts.subspan(first_part), second);
  line.run(second + 1s);
  return text(line.output());
}

TEST(StrictFraming, AGapShorterThanTheEndTimeNeverSplitsAFrame) {
  const Bytes frame = hex("01 03 00 01 00 01 D5 CA");
  for (const int baud : {19200, 115200}) {
    for (const SimTime gap : {0us, 50us, 178us, 300us, 573us, 700us, 749us}) {
      for (const std::size_t part : {1u, 4u, 7u}) {
        EXPECT_EQ(reply_to_split(frame, part, gap, baud), "01 03 02 C0 01 29 84")
            << gap.count() << " ns after " << part << " characters at " << baud;
      }
    }
  }
}

TEST(StrictFraming, AGapLongerThanTheEndTimeSplitsAFrame) {
  const Bytes frame = hex("01 03 00 01 00 01 D5 CA");
  for (const int baud : {19200, 115200}) {
    for (const SimTime gap : {751us, 1000us, 9000us}) {
      for (const std::size_t part : {1u, 4u, 7u}) {
        EXPECT_EQ(reply_to_split(frame, part, gap, baud), "")
            << gap.count() << " ns after " << part << " at " << baud;
      }
    }
  }
}

TEST(StrictFraming, TheReplyBeginsNoEarlierThanTheEndTime) {
  const auto device = make_simple2();
  RtuStation station(*device, 0, kStrict);
  pty::Line line("line", {.settings = device->line_settings(0), .enforce_settings = false}, {});
  line.attach(station);
  line.receive(hex("01 03 00 01 00 01 D5 CA"), 0ns);
  // 8 characters of 11 bits at 19200 baud, 0.75 ms, one character of the reply: a little over 5,906,250 ns.
  const SimTime first_byte = 4'583'333ns + 750'000ns + 572'916ns;
  line.run(first_byte - 1ns);
  EXPECT_EQ(text(line.output()), "");
  line.run(first_byte);
  EXPECT_EQ(text(line.output()), "01");
}

}  // namespace rtu_station_test
}  // namespace understudy::emulator::world
