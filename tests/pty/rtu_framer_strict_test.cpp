// The strict rule: only silence ends a frame, to the nanosecond.
#include <gtest/gtest.h>

#include "pty/rtu_crc.h"
#include "pty/rtu_framer.h"
#include "tests/pty/wire_examples.h"

namespace understudy::pty {
namespace rtu_framer_strict_test {

using namespace std::chrono_literals;

constexpr SimTime kSilence = 750us;
constexpr SimTime kCharacter = 572'916ns;  // 11 bits at 19200 baud: longer than the silence

struct StrictWire {
  RtuFramer framer{{.strict = true, .silence = kSilence, .patience = 10ms}};
  SimTime now{0};
  Frames frames;

  /// Characters back to back, each announced by its start bit; the framer is asked whenever it is due.
  void send(const Bytes& bytes) {
    for (const std::uint8_t value : bytes) {
      framer.start_bit(now);
      collect(now + kCharacter);
      framer.push({now, now + kCharacter, value});
      now += kCharacter;
    }
  }
  void wait(SimTime time) {
    now += time;
    collect(now - 1ns);  // at equal times the character comes first
  }
  void collect(SimTime until) {
    while (framer.due() && *framer.due() <= until) {
      const auto due = framer.due();
      if (const auto frame = framer.take(*due)) {
        frames.emplace_back(frame->bytes.begin(), frame->bytes.begin() + frame->size);
      } else if (framer.due() == due) {
        FAIL() << "it is due, but has no effect";
      }
    }
  }
};

const Bytes kFirst = hex("01 03 00 01 00 01 D5 CA");
const Bytes kSecond = hex("01 06 10 14 00 01 0C CE");

TEST(RtuFramerStrict, WaitsForExactlyTheSilence) {
  StrictWire wire;
  wire.send(kFirst);
  EXPECT_EQ(wire.framer.due(), wire.now + kSilence);
  EXPECT_FALSE(wire.framer.take(wire.now + kSilence - 1ns));
  const auto frame = wire.framer.take(wire.now + kSilence);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->end, wire.now);
}

TEST(RtuFramerStrict, AGapOfTheSilenceSplitsTwoFrames) {
  StrictWire wire;
  wire.send(kFirst);
  wire.wait(kSilence);
  wire.send(kSecond);
  wire.wait(1s);
  EXPECT_EQ(wire.frames, (Frames{kFirst, kSecond}));
}

TEST(RtuFramerStrict, AGapOneNanosecondShorterMergesThem) {
  StrictWire wire;
  wire.send(kFirst);
  wire.wait(kSilence - 1ns);
  wire.send(kSecond);
  wire.wait(1s);
  EXPECT_TRUE(wire.frames.empty());
  EXPECT_EQ(wire.framer.dropped_bytes(), kFirst.size() + kSecond.size());
}

TEST(RtuFramerStrict, AGapInsideAFrameCostsItOnlyIfItIsTheSilence) {
  for (const SimTime gap : {kSilence - 1ns, kSilence}) {
    StrictWire wire;
    wire.send({kFirst.begin(), kFirst.begin() + 3});
    wire.wait(gap);
    wire.send({kFirst.begin() + 3, kFirst.end()});
    wire.wait(1s);
    EXPECT_EQ(wire.frames.size(), gap < kSilence ? 1u : 0u);
  }
}

TEST(RtuFramerStrict, TakesTheGapFromTheCharactersAlone) {
  for (const SimTime gap : {kSilence - 1ns, kSilence}) {
    RtuFramer framer({.strict = true, .silence = kSilence, .patience = 10ms});
    SimTime now{0};
    for (const Bytes& frame : {kFirst, kSecond}) {
      for (const std::uint8_t value : frame) {
        framer.push({now, now + kCharacter, value});
        now += kCharacter;
      }
      now += gap;
    }
    int count = 0;
    while (framer.take(now + 1s)) ++count;
    EXPECT_EQ(count, gap < kSilence ? 0 : 2);
  }
}

TEST(RtuFramerStrict, DeliversAnyLengthWithARightChecksum) {
  for (const auto* text : {"01 41", "01 83 02", "07 08 00 00 01 02 03 04 05"}) {
    Bytes frame = hex(text);
    append_rtu_crc(frame);
    StrictWire wire;
    wire.send(frame);
    wire.wait(1s);
    EXPECT_EQ(wire.frames, Frames{frame}) << text;
  }
}

TEST(RtuFramerStrict, DropsALumpThatIsTooLongWhole) {
  for (const std::size_t size : {256u, 257u, 258u, 300u, 2000u}) {
    Bytes frame(size - 2, 0x11);
    append_rtu_crc(frame);
    StrictWire wire;
    wire.send(frame);
    wire.wait(kSilence);
    wire.send(kFirst);
    wire.wait(1s);
    EXPECT_EQ(wire.frames.size(), size <= kRtuMaxFrame ? 2u : 1u) << size;
    EXPECT_EQ(wire.frames.back(), kFirst) << size;
    EXPECT_EQ(wire.framer.dropped_bytes(), size <= kRtuMaxFrame ? 0u : size) << size;
  }
}

TEST(RtuFramerStrict, NoiseJoinedToAFrameSpoilsIt) {
  StrictWire wire;
  wire.send(hex("FF"));
  wire.send(kFirst);
  wire.wait(1s);
  EXPECT_TRUE(wire.frames.empty());
}

}  // namespace rtu_framer_strict_test
}  // namespace understudy::pty
