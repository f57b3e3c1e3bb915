// How a line's observer splits its traffic into packets.
#include "pty/capture_frames.h"

#include <gtest/gtest.h>

#include <random>

#include "pty/capture_text.h"
#include "tests/pty/fake_station.h"

namespace understudy::pty {
namespace capture_frames_test {

using namespace std::chrono_literals;

const Bytes kRequest = hex("01 03 00 01 00 01 D5 CA");
const Bytes kReply = hex("01 03 02 C0 01 29 84");
const Bytes kWrongChecksum = hex("01 03 00 01 00 01 D5 CB");
const Bytes kForStation2 = hex("02 03 00 01 00 01 D5 F9");
const Bytes kNoise = hex("FF 00 01 03 42");

constexpr RtuFraming kFraming{.silence = 750us, .patience = 10ms};
constexpr RtuFraming kStrict{.strict = true, .silence = 750us, .patience = 10ms};

Bytes together(const Frames& parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// A line with one slave, captured as text.
struct CaptureRig : LineRig {
  explicit CaptureRig(LineOptions options = {}, RtuFraming framing = kFraming)
      : LineRig(options),
        slave(1, kReply, framing),
        capture(0, framing, [this](const CapturedPacket& packet) {
          times.push_back(packet.time);
          total += packet.direction == Direction::from_host ? packet.bytes.size() : 0;
          std::string text;
          append_text_packet(text, std::vector<CapturedLine>{{"L", 19200}}, packet, 0);
          lines.push_back(text.substr(text.find(' ') + 1, text.size() - text.find(' ') - 2));
        }) {
    line.attach(slave);
    line.add_observer(capture);
    line.host_settings(HostSettings{.baud = 19200});
  }

  std::vector<std::string> lines;  // without the time
  std::vector<SimTime> times;
  std::size_t total = 0;  // bytes from the host
  FakeSlave slave;
  CaptureFrames capture;
};

using Lines = std::vector<std::string>;
const std::string kRequestLine = "in  L 01 03 00 01 00 01 D5 CA";
const std::string kReplyLine = "out L 01 03 02 C0 01 29 84";

TEST(CaptureFrames, RequestAndReplyCarryTheirFirstCharactersTimes) {
  CaptureRig rig;
  rig.send(kRequest, 1s);
  rig.run(2s);
  EXPECT_EQ(rig.lines, (Lines{kRequestLine, kReplyLine}));
  // 8 characters of 11 bits at 19200 baud, and the station's 0.75 ms.
  EXPECT_EQ(rig.times, (std::vector<SimTime>{1s, 1s + 4'583'333ns + 750us}));
}

TEST(CaptureFrames, WithoutLineTimeEverythingHappensAtOnceAndInOrder) {
  const RtuFraming no_silence{.patience = 10ms};
  CaptureRig rig({.settings = {}, .timing = Timing::instant}, no_silence);
  rig.send(together({kRequest, kRequest}), 1s);
  rig.run(2s);
  EXPECT_EQ(rig.lines, (Lines{kRequestLine, kReplyLine, kRequestLine, kReplyLine}));
  EXPECT_EQ(rig.times, (std::vector<SimTime>{1s, 1s, 1s, 1s}));
}

TEST(CaptureFrames, ARequestForNobodyHereIsCapturedToo) {
  CaptureRig rig;
  rig.send(kForStation2, 0s);
  rig.run(1s);
  EXPECT_EQ(rig.lines, (Lines{"in  L 02 03 00 01 00 01 D5 F9"}));
}

TEST(CaptureFrames, WhatWasDroppedSaysWhy) {
  CaptureRig rig;
  rig.send(kWrongChecksum, 0s);
  rig.run(1s);
  rig.send(hex("01 03 00 01"), 1s);
  rig.run(2s);
  rig.send(hex("01"), 2s);
  rig.run(3s);
  rig.send(kNoise, 3s);
  rig.run(4s);
  EXPECT_EQ(rig.lines, (Lines{"in  L 01 03 00 01 00 01 D5 CB  # dropped: bad CRC",
                              "in  L 01 03 00 01  # dropped: incomplete", "in  L 01  # dropped: incomplete",
                              "in  L FF 00 01 03 42  # dropped: not a frame"}));
  EXPECT_EQ(rig.times, (std::vector<SimTime>{0s, 1s, 2s, 3s}));
}

TEST(CaptureFrames, NoiseIsAPacketOfItsOwnBeforeTheRequestThatFollows) {
  CaptureRig rig;
  rig.send(together({kNoise, kWrongChecksum, kRequest}), 0s);
  rig.run(1s);
  EXPECT_EQ(rig.lines, (Lines{"in  L FF 00 01 03 42 01 03 00 01 00 01 D5 CB  # dropped: not a frame",
                              kRequestLine, kReplyLine}));
}

TEST(CaptureFrames, StrictFramingDropsTwoFramesWithoutAPauseAsOne) {
  CaptureRig rig({}, kStrict);
  rig.send(together({kRequest, kRequest}), 0s);
  rig.run(1s);
  EXPECT_EQ(rig.lines,
            (Lines{"in  L 01 03 00 01 00 01 D5 CA 01 03 00 01 00 01 D5 CA  # dropped: not a frame"}));
}

TEST(CaptureFrames, StrictFramingDropsAFrameWithAPauseAsTwo) {
  CaptureRig rig({}, kStrict);
  rig.send(hex("01 03 00 01"), 0s);
  rig.run(5ms);
  rig.send(hex("00 01 D5 CA"), 5ms);
  rig.run(1s);
  EXPECT_EQ(rig.lines,
            (Lines{"in  L 01 03 00 01  # dropped: incomplete", "in  L 00 01 D5 CA  # dropped: incomplete"}));
}

TEST(CaptureFrames, AHostAtAnotherSpeedIsCapturedAsUnheard) {
  CaptureRig rig;
  rig.line.host_settings(HostSettings{.baud = 9600});
  rig.send(kRequest, 0s);
  rig.run(1s);
  rig.line.host_settings(HostSettings{.baud = 19200});
  rig.send(kRequest, 1s);
  rig.run(2s);
  EXPECT_EQ(rig.lines,
            (Lines{kRequestLine + "  # unheard: the host set another speed", kRequestLine, kReplyLine}));
}

TEST(CaptureFrames, TwoStationsThatSpeakAtOnceAreBothCaptured) {
  CaptureRig rig;
  FakeSlave other(1, hex("01 83 02 C0 F1"));
  rig.line.attach(other);
  rig.send(kRequest, 0s);
  rig.run(1s);
  EXPECT_EQ(rig.lines,
            (Lines{kRequestLine, kReplyLine, "out L 01 83 02 C0 F1  # collided with another station"}));
}

TEST(CaptureFrames, AReplyThatNobodyWaitsForSaysSo) {
  CaptureRig rig;
  rig.send(kRequest, 0s);
  rig.line.host_closed();
  rig.run(1s);
  EXPECT_EQ(rig.lines, (Lines{kRequestLine, kReplyLine + "  # discarded: no host has the line open"}));
}

TEST(CaptureFrames, AStoppedClockDropsAPartialFrameWhenStationsDo) {
  const RtuFraming no_silence{.patience = 10ms};
  CaptureRig rig({.settings = {}, .timing = Timing::instant}, no_silence);
  rig.send(hex("01 03 00 01"), 1s);
  rig.line.run(1s);
  EXPECT_EQ(rig.lines, Lines{});
  rig.line.nothing_more(1s);
  EXPECT_EQ(rig.lines, (Lines{"in  L 01 03 00 01  # dropped: incomplete"}));
  EXPECT_EQ(rig.capture.due(), std::nullopt);
}

TEST(CaptureFrames, WhatIsOnItsWayAtTheEndIsAPacketToo) {
  CaptureRig rig;
  rig.send(kRequest, 0s);
  rig.run(2ms);
  rig.capture.finish();
  EXPECT_EQ(rig.lines, (Lines{"in  L 01 03 00  # dropped: incomplete"}));
}

/// Every byte of the host is in exactly one packet, in order, whatever it sends.
TEST(CaptureFrames, NothingIsMissingAndNothingIsThereTwice) {
  for (const RtuFraming& framing : {kFraming, kStrict}) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << (framing.strict ? " strict" : " tolerant"));
      std::mt19937 random(seed);
      CaptureRig rig({}, framing);
      std::size_t sent = 0;
      SimTime now{0};
      for (int lump = 0; lump < 30; ++lump) {
        Bytes bytes = random() % 3 == 0 ? kRequest : random() % 2 == 0 ? kWrongChecksum : kForStation2;
        if (random() % 4 == 0) bytes.resize(1 + random() % bytes.size());
        if (random() % 8 == 0) {
          bytes.resize(random() % 600);
          for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
        }
        bytes.resize(std::min(bytes.size(), rig.line.room()));
        rig.send(bytes, now);
        sent += bytes.size();
        now += std::chrono::microseconds(random() % 12'000);
        rig.run(now);
      }
      rig.run(now + 10s);
      EXPECT_EQ(rig.total, sent) << "before the end";
      rig.capture.finish();
      EXPECT_EQ(rig.total, sent);
    }
  }
}

TEST(CaptureFrames, NoiseWithoutEndComesInPacketsOfBoundedSize) {
  for (const RtuFraming& framing : {kFraming, kStrict}) {
    CaptureRig rig({}, framing);
    SimTime now{0};
    for (int lump = 0; lump < 10; ++lump) {
      rig.send(Bytes(1000, 0x55), now);
      now += LineSettings{}.duration_of(1000);
      rig.run(now);
    }
    EXPECT_GE(rig.total, 8500U);
    EXPECT_LE(rig.lines.size(), 45U);
  }
}

TEST(CaptureFrames, ALineDoesTheSameWithAndWithoutACapture) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    CaptureRig watched;
    LineRig alone;
    FakeSlave slave(1, kReply);
    alone.line.attach(slave);
    alone.line.host_settings(HostSettings{.baud = 19200});
    SimTime now{0};
    for (int lump = 0; lump < 20; ++lump) {
      const Bytes bytes = together({random() % 2 == 0 ? kNoise : Bytes{}, kRequest});
      now += std::chrono::microseconds(random() % 20'000);
      for (LineRig* rig : {static_cast<LineRig*>(&watched), &alone}) {
        rig->run(now);
        rig->send(bytes, now);
      }
    }
    for (LineRig* rig : {static_cast<LineRig*>(&watched), &alone}) rig->run(now + 1s);
    EXPECT_EQ(watched.out, alone.out) << "seed " << seed;
    EXPECT_EQ(watched.out_at, alone.out_at) << "seed " << seed;
  }
}

}  // namespace capture_frames_test
}  // namespace understudy::pty
