#include "pty/rtu_framer.h"

#include <gtest/gtest.h>

#include <random>

#include "pty/rtu_crc.h"
#include "tests/pty/wire_examples.h"

namespace understudy::pty {
namespace rtu_framer_test {

using namespace std::chrono_literals;

constexpr SimTime kSilence = 750us;
constexpr SimTime kPatience = 10ms;
constexpr RtuFraming kTolerant{.strict = false, .silence = kSilence, .patience = kPatience};
constexpr SimTime kCharacter = 572'916ns;

Bytes with_crc(std::string_view text) {
  Bytes frame = hex(text);
  append_rtu_crc(frame);
  return frame;
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

Bytes bytes_of(const RtuFrame& frame) { return {frame.bytes.begin(), frame.bytes.begin() + frame.size}; }

constexpr SimTime kRestPatience = 200ms;
constexpr RtuFraming kPatient{
    .strict = false, .silence = kSilence, .patience = kPatience, .rest_patience = kRestPatience};

/// A wire with a framer at its end: sends characters back to back, and collects frames when they are due.
struct Wire {
  explicit Wire(const RtuFraming& framing = kTolerant) : framer(framing) {}
  RtuFramer framer;
  SimTime now{0};
  Frames frames;
  std::vector<SimTime> served_at;

  void send(const Bytes& bytes) {
    for (const std::uint8_t value : bytes) {
      collect();  // what is due before the start bit
      framer.start_bit(now);
      framer.push({now, now + kCharacter, value});
      now += kCharacter;
    }
  }
  void wait(SimTime time) {
    now += time;
    collect();
  }
  void collect() {
    while (framer.due() && *framer.due() < now) {
      const SimTime due = *framer.due();
      if (const auto frame = framer.take(due)) {
        frames.push_back(bytes_of(*frame));
        served_at.push_back(due);
        EXPECT_GE(due, frame->end + kSilence);
      } else if (framer.due() == due) {
        FAIL() << "it is due, but has no effect";
      }
    }
  }
};

TEST(RtuFramer, GivesAllThatIsDueAndThenNothing) {
  Wire wire;
  wire.send(hex("FF FF") + hex(kRequestExamples.front()));
  RtuFramer& framer = wire.framer;
  EXPECT_FALSE(framer.take_due(wire.now));  // the silence has not ended
  const auto frame = framer.take_due(wire.now + kPatience);
  ASSERT_TRUE(frame);
  EXPECT_EQ(bytes_of(*frame), hex(kRequestExamples.front()));
  EXPECT_FALSE(framer.take_due(wire.now + 1s));
  EXPECT_EQ(framer.due(), std::nullopt);
  // A character in progress: nothing is due, however long one waits.
  wire.send(hex("01"));
  framer.start_bit(wire.now);
  EXPECT_FALSE(framer.take_due(wire.now + 1s));
  EXPECT_EQ(framer.due(), std::nullopt);
}

TEST(RtuFramer, EndsEveryPrintedRequestAtItsLastByte) {
  for (const auto text : kRequestExamples) {
    Wire wire;
    const Bytes frame = hex(text);
    wire.send(frame);
    const SimTime end = wire.now;
    ASSERT_EQ(wire.framer.due(), end + kSilence) << text;
    EXPECT_FALSE(wire.framer.take(end + kSilence - 1ns)) << text;
    const auto taken = wire.framer.take(end + kSilence);
    ASSERT_TRUE(taken) << text;
    EXPECT_EQ(bytes_of(*taken), frame) << text;
    EXPECT_EQ(taken->end, end);
    EXPECT_EQ(wire.framer.due(), std::nullopt);
    EXPECT_EQ(wire.framer.dropped_bytes(), 0u);
  }
}

TEST(RtuFramer, KnowsTheLengthOfEveryStandardRequest) {
  const std::array requests = {"01 01 00 00 00 08",
                               "01 02 00 00 00 08",
                               "01 03 00 00 00 01",
                               "01 04 00 00 00 01",
                               "01 05 00 00 FF 00",
                               "01 06 00 00 00 01",
                               "01 07",
                               "01 08 00 00 12 34",
                               "01 0B",
                               "01 0C",
                               "01 11",
                               "01 0F 00 00 00 0A 02 CD 01",
                               "01 10 00 00 00 01 02 00 05",
                               "01 10 00 00 00 00 00",
                               "01 16 00 04 00 F2 00 25",
                               "01 17 00 03 00 06 00 0E 00 03 06 00 FF 00 FF 00 FF",
                               "01 18 04 DE"};
  for (const auto* text : requests) {
    Wire wire;
    wire.send(with_crc(text));
    EXPECT_EQ(wire.framer.due(), wire.now + kSilence) << text;
    wire.wait(kSilence + 1ns);
    EXPECT_EQ(wire.frames, Frames{with_crc(text)}) << text;
  }
}

TEST(RtuFramer, TakesTheLongestFrameAndNoLonger) {
  Bytes longest = hex("01 10 00 00 00 7B F7");
  longest.resize(254, 0x55);
  append_rtu_crc(longest);
  ASSERT_EQ(longest.size(), kRtuMaxFrame);
  Wire wire;
  wire.send(longest);
  wire.wait(kSilence + 1ns);
  EXPECT_EQ(wire.frames, Frames{longest});

  Bytes too_long = hex("01 10 00 00 00 7C F8");
  too_long.resize(255, 0x55);
  append_rtu_crc(too_long);
  wire.send(too_long);
  wire.wait(1s);
  EXPECT_EQ(wire.frames.size(), 1u);
  EXPECT_EQ(wire.framer.dropped_bytes(), too_long.size());
}

TEST(RtuFramer, EndsUnknownFunctionsByPatience) {
  for (const auto* text : {"01 2D 0E 01 00", "01 41", "01 08 00 00 12 34 56 78", "01 83 02", "01 00 07"}) {
    Wire wire;
    const Bytes frame = with_crc(text);
    wire.send(frame);
    ASSERT_EQ(wire.framer.due(), wire.now + kPatience) << text;
    EXPECT_FALSE(wire.framer.take(wire.now + kPatience - 1ns));
    const auto taken = wire.framer.take(wire.now + kPatience);
    ASSERT_TRUE(taken) << text;
    EXPECT_EQ(bytes_of(*taken), frame) << text;
    EXPECT_EQ(taken->end, wire.now);
  }
}

TEST(RtuFramer, EndsARequestForTheIdentityBySilence) {
  Wire wire;
  const Bytes frame = with_crc("01 2B 0E 01 00");
  wire.send(frame);
  ASSERT_EQ(wire.framer.due(), wire.now + kSilence);
  wire.wait(kSilence + 1ns);
  EXPECT_EQ(wire.frames, Frames{frame});
}

TEST(RtuFramer, SurvivesAHostThatStallsInsideAFrame) {
  const Bytes frame = hex(kRequestExamples[3]);
  for (std::size_t cut = 1; cut < frame.size(); ++cut) {
    Wire wire;
    wire.send({frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(cut)});
    wire.wait(kPatience - 1ns);
    wire.send({frame.begin() + static_cast<std::ptrdiff_t>(cut), frame.end()});
    wire.wait(kSilence + 1ns);
    EXPECT_EQ(wire.frames, Frames{frame}) << "cut at " << cut;
  }
}

TEST(RtuFramer, DropsACutFrameAfterPatience) {
  const Bytes frame = hex(kRequestExamples[0]);
  Wire wire;
  wire.send({frame.begin(), frame.begin() + 5});
  wire.wait(kPatience);
  wire.send(frame);
  wire.wait(kSilence + 1ns);
  EXPECT_EQ(wire.frames, Frames{frame});
  EXPECT_EQ(wire.framer.dropped_bytes(), 5u);
}

// Wherever it is paused, however often, for as long as allowed.
TEST(RtuFramer, AwaitsTheRestOfAFrameWhoseLengthIsKnown) {
  for (const std::string_view text : kRequestExamples) {
    const Bytes frame = hex(text);
    for (const SimTime pause : {SimTime{10ms}, SimTime{16ms}, SimTime{150ms}, kRestPatience - 1ns}) {
      for (std::size_t cut = 1; cut < frame.size(); ++cut) {
        Wire wire(kPatient);
        wire.send({frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(cut)});
        wire.wait(pause);
        wire.send({frame.begin() + static_cast<std::ptrdiff_t>(cut), frame.end()});
        wire.wait(kSilence + 1ns);
        EXPECT_EQ(wire.frames, Frames{frame}) << text << " cut at " << cut;
        EXPECT_EQ(wire.framer.dropped_bytes(), 0u) << text << " cut at " << cut;
      }
      Wire wire(kPatient);
      for (const std::uint8_t byte : frame) {
        wire.wait(pause);
        wire.send({byte});
      }
      wire.wait(kSilence + 1ns);
      EXPECT_EQ(wire.frames, Frames{frame}) << text << " byte by byte";
    }
  }
}

// Cut anywhere, after a pause of any length: the next one is served at its end, whole or in two pieces.
TEST(RtuFramer, PrefersAGoodFrameBehindAPauseToTheRestOfACutOne) {
  for (const std::string_view first : kRequestExamples) {
    const Bytes cut_one = hex(first);
    for (const std::string_view second : kRequestExamples) {
      const Bytes frame = hex(second);
      for (std::size_t cut = 1; cut < cut_one.size(); ++cut) {
        for (const SimTime pause : {SimTime{10ms}, SimTime{50ms}, kRestPatience, SimTime{1s}}) {
          for (std::size_t piece : {std::size_t{1}, frame.size() / 2, frame.size()}) {
            Wire wire(kPatient);
            wire.send({cut_one.begin(), cut_one.begin() + static_cast<std::ptrdiff_t>(cut)});
            wire.wait(pause);
            wire.send({frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(piece)});
            if (piece < frame.size()) wire.wait(12ms);
            wire.send({frame.begin() + static_cast<std::ptrdiff_t>(piece), frame.end()});
            wire.wait(piece < frame.size() ? SimTime{kPatience + 1ns} : SimTime{kSilence + 1ns});
            ASSERT_EQ(wire.frames, Frames{frame}) << first << " cut at " << cut << ", " << second;
            EXPECT_EQ(wire.framer.dropped_bytes(), cut);
          }
        }
      }
    }
  }
}

TEST(RtuFramer, DropsACutFrameAfterItsPatience) {
  const Bytes frame = hex(kRequestExamples[0]);
  Wire wire(kPatient);
  wire.send({frame.begin(), frame.begin() + 5});
  EXPECT_EQ(wire.framer.due(), wire.now + kPatience);
  wire.wait(kPatience + 1ns);
  EXPECT_EQ(wire.framer.due(), wire.now - kPatience - 1ns + kRestPatience);
  EXPECT_EQ(wire.framer.dropped_bytes(), 0u);
  wire.wait(kRestPatience);
  EXPECT_EQ(wire.framer.dropped_bytes(), 5u);
  EXPECT_EQ(wire.framer.due(), std::nullopt);
}

// A lump that does not begin with a frame of known length gets the usual timeout.
TEST(RtuFramer, GivesUpAllElseAfterTheUsualPatience) {
  for (const auto* text :
       {"01 41 07", "01 03 00 01 00 01 D5 CB", "01 83 02", "FF FF FF 01 03 00", "00 00 00 01"}) {
    Wire wire(kPatient);
    wire.send(hex(text));
    wire.wait(kPatience + 1ns);
    EXPECT_EQ(wire.framer.due(), std::nullopt) << text;
    EXPECT_EQ(wire.framer.dropped_bytes(), hex(text).size()) << text;
  }
}

TEST(RtuFramer, ServesPipelinedFramesEachAtItsOwnEnd) {
  Wire wire;
  Bytes stream;
  Frames expected;
  std::vector<SimTime> expected_at;
  for (const auto text : kRequestExamples) {
    expected.push_back(hex(text));
    stream = stream + hex(text);
    expected_at.push_back(kCharacter * static_cast<std::int64_t>(stream.size()) + kSilence);
  }
  // All at once, as an operating system delivers them: taken only afterwards.
  SimTime now{0};
  for (const std::uint8_t value : stream) {
    wire.framer.push({now, now + kCharacter, value});
    now += kCharacter;
  }
  wire.wait(now + kSilence + 1ns);
  EXPECT_EQ(wire.frames, expected);
  EXPECT_EQ(wire.served_at, expected_at);
  EXPECT_EQ(wire.framer.dropped_bytes(), 0u);
}

TEST(RtuFramer, FindsAGoodFrameRightAfterNoise) {
  const Bytes frame = hex(kRequestExamples[6]);
  // Nothing here can still become a frame once the valid one has arrived.
  for (const auto* noise : {"FF FF", "00", "00 00 00", "01 83 02 C0 F1", "01 03 00 03 00 01 74 0B",
                            "01 10 10 00 00 02 04 FE 0C FF FF CE 35"}) {
    Wire wire;
    wire.send(hex(noise) + frame);
    EXPECT_EQ(wire.framer.due(), wire.now + kSilence) << noise;
    wire.wait(kSilence + 1ns);
    EXPECT_EQ(wire.frames, Frames{frame}) << noise;
    EXPECT_EQ(wire.framer.dropped_bytes(), hex(noise).size()) << noise;
  }
}

TEST(RtuFramer, FindsAGoodFrameUnderACutOneAfterPatience) {
  const Bytes frame = hex(kRequestExamples[6]);
  for (const auto* cut : {"01 10 10 00 00 05 0A 7D", "01 41 07", "01 10 10 00 00 7B F6"}) {
    Wire wire;
    wire.send(hex(cut) + frame + frame);
    wire.wait(kSilence + 1ns);
    EXPECT_TRUE(wire.frames.empty() || wire.frames.size() == 1) << cut;
    wire.wait(kPatience);
    EXPECT_EQ(wire.frames.back(), frame) << cut;
    EXPECT_EQ(wire.framer.due(), std::nullopt);
  }
}

TEST(RtuFramer, NeverExecutesAFrameInsideAGoodOne) {
  const Bytes inner = hex("01 06 10 05 00 01 5C CB");
  const std::vector<Bytes> outers = {
      hex("01 10 10 00 00 04 08") + inner,              // known length
      hex("01 10 10 00 00 05 0A 00 01") + inner,        //
      hex("01 17 00 00 00 01 00 00 00 04 08") + inner,  //
      hex("01 41") + inner,                             // unknown function
      hex("01 2B 0E") + inner + hex("07") + inner,      //
      hex("01 08 00 00") + inner,                       // known function, unknown length
  };
  for (Bytes outer : outers) {
    append_rtu_crc(outer);
    Wire wire;
    wire.send(outer);
    wire.wait(1s);
    EXPECT_EQ(wire.frames, Frames{outer});
    // The same after noise that ends at once.
    wire.frames.clear();
    if (outer[1] == 0x10 || outer[1] == 0x17) {
      wire.send(hex("FF FF") + outer);
      wire.wait(1s);
      EXPECT_EQ(wire.frames, Frames{outer});
    }
  }
}

TEST(RtuFramer, ForgetsWhatIsBufferedWhenReset) {
  Wire wire;
  for (const Bytes& buffered : {hex(kRequestExamples[0]), hex("01 03 00")}) {
    wire.send(buffered);
    wire.framer.reset();
    EXPECT_EQ(wire.framer.due(), std::nullopt);
  }
  wire.send(hex(kRequestExamples[1]));
  wire.wait(kSilence + 1ns);
  EXPECT_EQ(wire.frames, Frames{hex(kRequestExamples[1])});
}

TEST(RtuFramer, IsAValue) {
  Wire wire;
  const Bytes frame = hex(kRequestExamples[0]);
  wire.send({frame.begin(), frame.begin() + 5});
  Wire copy = wire;
  wire.framer.reset();
  copy.send({frame.begin() + 5, frame.end()});
  copy.wait(kSilence + 1ns);
  EXPECT_EQ(copy.frames, Frames{frame});
}

// --- random streams ------------------------------------------------------------------------------

struct Stream {
  std::mt19937 random;
  std::size_t pick(std::size_t bound) { return random() % bound; }

  Bytes request() {
    if (pick(2) == 0) return hex(kRequestExamples[pick(kRequestExamples.size())]);
    Bytes frame = {static_cast<std::uint8_t>(pick(248)), 0x10, 0, 0, 0, 0,
                   static_cast<std::uint8_t>(pick(247))};
    const std::size_t count = frame[6];
    for (std::size_t i = 0; i < count; ++i) frame.push_back(static_cast<std::uint8_t>(pick(256)));
    append_rtu_crc(frame);
    return frame;
  }
  Bytes noise() {
    Bytes bytes(1 + pick(40));
    do {
      for (auto& byte : bytes) byte = static_cast<std::uint8_t>(pick(256));
    } while (rtu_crc_ok(bytes));  // one in 65536 is a frame
    return bytes;
  }
};

TEST(RtuFramerRandom, EverySplitOfGoodFramesGivesThemAll) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Stream stream{std::mt19937(seed)};
    Wire wire;
    Frames expected;
    Bytes bytes;
    for (int i = 0; i < 12; ++i) {
      expected.push_back(stream.request());
      bytes = bytes + expected.back();
    }
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t lump = std::min(1 + stream.pick(30), bytes.size() - at);
      wire.send({bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + lump)});
      at += lump;
      wire.wait(SimTime(stream.pick(static_cast<std::size_t>(kPatience.count()))));
    }
    wire.wait(kPatience);
    EXPECT_EQ(wire.frames, expected) << "seed " << seed;
    EXPECT_EQ(wire.framer.dropped_bytes(), 0u) << "seed " << seed;
  }
}

TEST(RtuFramerRandom, NoiseNeverCostsAFrameThatComesAfterSilence) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    Stream stream{std::mt19937(seed)};
    Wire wire;
    Frames expected;
    std::size_t noise_size = 0;
    for (int i = 0; i < 10; ++i) {
      const Bytes noise = stream.noise();
      noise_size += noise.size();
      wire.send(noise);
      wire.wait(kPatience);
      expected.push_back(stream.request());
      wire.send(expected.back());
      if (stream.pick(2) == 0) wire.wait(SimTime(stream.pick(20'000'000)));
    }
    wire.wait(1s);
    EXPECT_EQ(wire.frames, expected) << "seed " << seed;
    EXPECT_EQ(wire.framer.dropped_bytes(), noise_size) << "seed " << seed;
  }
}

TEST(RtuFramerRandom, AGoodFrameInNoiseWithoutAGapIsFoundInTheEnd) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    Stream stream{std::mt19937(seed)};
    Wire wire;
    const Bytes frame = hex(kRequestExamples[stream.pick(kRequestExamples.size())]);
    wire.send(stream.noise() + frame + stream.noise());
    wire.wait(1s);
    EXPECT_EQ(wire.frames, Frames{frame}) << "seed " << seed;
  }
}

TEST(RtuFramerRandom, AFloodStaysInItsBounds) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    for (const bool strict : {false, true}) {
      RtuFramer framer({.strict = strict, .silence = kSilence, .patience = kPatience});
      SimTime now{0};
      std::uint64_t taken = 0;
      const std::uint64_t count = 20'000;
      // Few values, so that byte counts, unknown functions and long candidates all occur.
      const std::array<std::uint8_t, 8> values = {0x01, 0x03, 0x10, 0x41, 0xF7, 0x00, 0x07, 0xFF};
      for (std::uint64_t i = 0; i < count; ++i) {
        framer.push({now, now + 1us, values[random() % values.size()]});
        now += random() % 1000 == 0 ? SimTime(20ms) : SimTime(1us);
      }
      now += 1s;
      while (const auto frame = framer.take_due(now)) taken += frame->size;
      EXPECT_EQ(framer.due(), std::nullopt);
      EXPECT_EQ(framer.dropped_bytes() + taken, count) << "seed " << seed;
    }
  }
}

TEST(RtuFramerRandom, GoodFramesThatNobodyTakesDropTheOldest) {
  RtuFramer framer(kTolerant);
  SimTime now{0};
  const int count = 500;
  for (int i = 0; i < count; ++i) {
    Bytes frame = {0x01, 0x06, 0x00, 0x00, static_cast<std::uint8_t>(i >> 8), static_cast<std::uint8_t>(i)};
    append_rtu_crc(frame);
    for (const std::uint8_t value : frame) framer.push({now, now + 1us, value}), now += 1us;
  }
  std::uint64_t taken = 0;
  int last = -1;
  while (const auto frame = framer.take(now + 1s)) {
    const int value = frame->bytes[4] * 256 + frame->bytes[5];
    EXPECT_TRUE(last < 0 || value == last + 1) << value;
    last = value;
    ++taken;
  }
  EXPECT_EQ(last, count - 1);
  EXPECT_GE(taken, 64u);
  EXPECT_EQ(framer.dropped_bytes(), (count - taken) * 8);
}

}  // namespace rtu_framer_test
}  // namespace understudy::pty
