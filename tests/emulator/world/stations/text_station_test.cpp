// A text-protocol device on its line: what it receives, what it sends, and when.
#include "emulator/world/stations/text_station.h"

#include <gtest/gtest.h>

#include "emulator/world/snapshot.h"
#include "emulator/world/stations/station_fields.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/world/stations/echo_box.h"

namespace understudy::emulator::world {
namespace text_station_test {

using namespace std::chrono_literals;

// 9600 8N1: ten bits per character, 1041666.67 ns.
SimTime characters(std::int64_t count) { return SimTime{count * 10 * 1'000'000'000 / 9600}; }

struct Rig {
  explicit Rig(pty::Timing timing = pty::Timing::wire, DeviceSettings settings = {})
      : bench(echo_bench(timing, with_greeting(std::move(settings)))), world(bench, {}, {}) {
    world.advance_to(20ms);  // its text at power-up has ended: "HELLO", CR, LF take 7.3 ms
    EXPECT_EQ(received(), "HELLO\r\n");
  }
  static DeviceSettings with_greeting(DeviceSettings settings) {
    settings.firmware = 100;
    return settings;
  }
  void transmit(std::string_view text) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    world.receive(0, bytes);
  }
  /// Returns what was received since the last call.
  std::string received() {
    const auto output = world.line(0).line.output();
    std::string text(output.begin(), output.end());
    world.take_output(0, output.size());
    return text;
  }
  std::string answer(std::string_view text, SimTime within = 200ms) {
    transmit(text);
    world.advance_to(world.now() + within);
    return received();
  }
  EchoBox& box() { return dynamic_cast<EchoBox&>(world.device(0)); }

  Bench bench;
  World world;
};

TEST(TextStation, AnswersALineInTheTimeOfTheWire) {
  Rig rig;
  const SimTime start = rig.world.now();
  rig.transmit("SAY ab\r");  // seven characters to the device, four back
  rig.world.advance_to(start + characters(7) + characters(1) - 1ns);
  EXPECT_EQ(rig.received(), "");
  rig.world.advance_to(start + characters(7) + characters(1));
  EXPECT_EQ(rig.received(), "a");
  rig.world.advance_to(start + characters(7) + characters(4) - 1ns);
  EXPECT_EQ(rig.received(), "b\r");
  rig.world.advance_to(start + characters(7) + characters(4));
  EXPECT_EQ(rig.received(), "\n");
}

TEST(TextStation, AnswersAtOnceWhereCharactersTakeNoTime) {
  Rig rig(pty::Timing::instant);
  EXPECT_EQ(rig.answer("SAY ab\r\nSAY c\r?N0\r", 0ms), "ab\r\nc\r\n0\r\n");
}

TEST(TextStation, HearsWhatIsNoLineToo) {
  Rig rig;
  EXPECT_EQ(rig.answer("\x1B"), "BREAK\r\n");
  EXPECT_EQ(rig.answer("SAY 678901234567890\r"), "678901234567890\r\n");
  EXPECT_EQ(rig.answer("SAY 6789012345678901234\r"), "LONG\r\n");
  EXPECT_EQ(rig.answer("\r"), "ERR 1\r\n");
  EXPECT_EQ(rig.answer("SAY a\nSAY b\n"), "a\r\nb\r\n");
}

TEST(TextStation, SpeaksUnaskedFromItsTickOn) {
  for (const bool bulk : {true, false}) {
    Rig rig;
    rig.world.set_bulk_ticks(bulk);
    EXPECT_EQ(rig.answer("AT 500\r"), "");
    EXPECT_EQ(rig.world.next_due(), bulk ? std::optional(500ms) : rig.world.next_due());
    rig.world.advance_to(500ms + characters(1) - 1ns);
    EXPECT_EQ(rig.received(), "");
    rig.world.advance_to(500ms + characters(1));
    EXPECT_EQ(rig.received(), "T");
    rig.world.advance_to(500ms + characters(10));  // "TICK 500", CR, LF
    EXPECT_EQ(rig.received(), "ICK 500\r\n");
    EXPECT_EQ(rig.world.next_due(), std::nullopt);
  }
}

TEST(TextStation, WhatItSaysUnaskedWaitsUntilTheWireIsFree) {
  Rig rig;
  rig.answer("AT 300\r");
  rig.world.advance_to(290ms);
  // Eight characters to the device: received at 298.3 ms; "line 1" to "line 3" with their ends are 24 back.
  rig.transmit("LIST 3\r");
  rig.world.advance_to(400ms);
  EXPECT_EQ(rig.received(), "line 1\r\nline 2\r\nline 3\r\nTICK 300\r\n");
}

TEST(TextStation, ALongAnswerComesWhole) {
  std::string wanted;
  for (int i = 1; i <= 1000; ++i) wanted += "line " + std::to_string(i) + "\r\n";
  ASSERT_GT(wanted.size(), 2 * pty::Line::kOutputCapacity);
  for (const pty::Timing timing : {pty::Timing::wire, pty::Timing::instant}) {
    Rig rig(timing);
    rig.transmit("LIST 1000\r");
    std::string received;
    for (int i = 0; i < 200; ++i) {
      rig.world.advance_to(rig.world.now() + 100ms);
      received += rig.received();
    }
    EXPECT_EQ(received, wanted);
    EXPECT_EQ(rig.world.line(0).line.counters().bytes_discarded, 0u);
  }
}

TEST(TextStation, ALongAnswerLeavesNoGapOnTheWire) {
  Rig rig;
  const SimTime start = rig.world.now();
  rig.transmit("LIST 1000\r");
  // 9893 characters: nine lines of 8, ninety of 9, nine hundred of 10, one of 11.
  const SimTime end = start + characters(10) + characters(9 * 8 + 90 * 9 + 900 * 10 + 11);
  for (SimTime at = start; at < end - 100ms; at += 100ms) {
    rig.world.advance_to(at);
    rig.received();
  }
  rig.world.advance_to(end - 2us);
  const auto before = rig.world.line(0).line.counters().bytes_out;
  rig.world.advance_to(end);
  EXPECT_EQ(before + 1, rig.world.line(0).line.counters().bytes_out);
  EXPECT_EQ(rig.world.next_due(), std::nullopt);
}

TEST(TextStation, EchoesWhatIsTypedAndLetsItBeTakenBack) {
  Rig rig;
  EXPECT_EQ(rig.answer("ECHO=1\r"), "");
  EXPECT_EQ(rig.answer("SAX\bY a\r"), "SAX\b \bY a\r\na\r\n");
}

TEST(TextStation, WithoutPowerItHearsNothingAndForgetsWhatItHeard) {
  Rig rig;
  rig.answer("SAY a");
  rig.world.switch_power(0, false);
  EXPECT_EQ(rig.answer("SAY b\r"), "");
  rig.world.switch_power(0, true);
  rig.world.advance_to(rig.world.now() + 10ms);
  EXPECT_EQ(rig.received(), "HELLO\r\n");
  EXPECT_EQ(rig.answer("SAY c\r"), "c\r\n");
}

TEST(TextStation, WhatItWasSayingEndsWithItsPower) {
  Rig rig;
  rig.transmit("LIST 9\r");
  rig.world.advance_to(rig.world.now() + characters(7) + characters(10) + 1us);
  rig.world.switch_power(0, false);
  rig.world.advance_to(rig.world.now() + 1s);
  // Ten characters have ended, and the eleventh has started.
  EXPECT_EQ(rig.received(), "line 1\r\nlin");
}

TEST(TextStation, AnAnswerIsForTheHostThatAsked) {
  Rig rig;
  rig.transmit("SAY a\r");
  rig.world.host_closed(0);
  rig.world.host_opened(0);
  rig.world.advance_to(rig.world.now() + 100ms);
  EXPECT_EQ(rig.received(), "");
  EXPECT_EQ(rig.world.line(0).stations[0]->counters().requests, 1u);
}

TEST(TextStation, CountsLinesAndAnswers) {
  Rig rig;
  rig.answer("SAY a\rN0=5\r?N0\r\x1B");
  const StationCounters& counters = rig.world.line(0).stations[0]->counters();
  EXPECT_EQ(counters.requests, 3u);
  EXPECT_EQ(counters.replies, 3u);  // to two lines and to ESC
}

TEST(TextStation, ActsFromOutsideMayMakeItSpeakAndAreSentAtTheirTime) {
  Rig rig;
  rig.box().receive_line("SAY x");  // as an act does: not over the line
  EXPECT_EQ(rig.world.assign(0, "N0", 7), std::nullopt);
  rig.world.advance_to(rig.world.now() + characters(3));
  EXPECT_EQ(rig.received(), "x\r\n");
  EXPECT_EQ(rig.answer("?N0\r"), "7\r\n");
  EXPECT_EQ(rig.world.assign(0, "N0", 1e6), "is out of range; expected -32768 to 32767");
  EXPECT_EQ(rig.world.assign(0, "QQ", 1), "is not a name here; expected N0, R0 or ECHO");
  EXPECT_EQ(rig.answer("?N0\r"), "7\r\n");
}

// At every point of a dialogue: half a line received, a reply half sent, unrequested text waiting.
TEST(TextStation, AWorldThatIsRestoredSaysTheSameBytes) {
  for (const pty::Timing timing : {pty::Timing::wire, pty::Timing::instant}) {
    Rig first(timing);
    Rig other(timing);
    const auto play = [](Rig& rig, int step) {
      static const std::vector<std::string> kLines{"SAY a\r", "AT 400\r", "ECHO=1\r", "LIST 30", "0\r",
                                                   "SAX\b",   "Y b\r",    "ECHO=0\r", "\x1B",    "N0=7\r"};
      if (step % 7 == 0) rig.transmit(kLines[static_cast<std::size_t>(step / 7) % kLines.size()]);
      rig.world.advance_to(rig.world.now() + 3700us);
      return rig.received();
    };
    constexpr int kSteps = 300;
    for (int step = 0; step < kSteps; ++step) {
      if (step % 13 == 0) {
        const WorldState state = save(first.world);
        restore(other.world, state);
        EXPECT_EQ(save(other.world), state);
        EXPECT_TRUE(same_state(other.world.device(0), first.world.device(0)));
      }
      EXPECT_EQ(play(first, step), play(other, step)) << "step " << step;
      ASSERT_EQ(hash(first.world), hash(other.world)) << "step " << step;
    }
    EXPECT_GT(first.world.line(0).line.counters().bytes_out, 500u);
  }
}

TEST(TextStation, RefusesStatesThatCannotBe) {
  Rig rig;
  auto& station = dynamic_cast<TextStation&>(*rig.world.line(0).stations[0]);
  const TextStation::State good = station.save();
  const std::vector<std::function<void(TextStation::State&)>> spoilers{
      [](auto& state) { state.waiting.resize(2); },          [](auto& state) { state.late.push_back({}); },
      [](auto& state) { state.outgoing.push_back({}); },     [](auto& state) { state.free_at = SimTime{-1}; },
      [](auto& state) { state.speaks_at = SimTime::max(); },
  };
  const auto read = [&](const TextStation::State& state) {
    StateWriter writer;
    writer.write(state);
    const std::vector<std::byte> bytes = writer.take();
    StateReader reader(bytes);
    station.read_state(reader);
  };
  read(good);
  for (const auto& spoil : spoilers) {
    TextStation::State bad = good;
    spoil(bad);
    EXPECT_ANY_THROW(read(bad));
  }
}

}  // namespace text_station_test
}  // namespace understudy::emulator::world
