// Every stage on a line with wire time: which frame was hit, and the exact bytes and times that arrive
// instead.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "emulator/world/stations/rtu_station.h"
#include "tests/emulator/world/faults/faulty_line.h"

namespace understudy::emulator::world {
namespace wire_faults_test {

using namespace std::chrono_literals;

/// A stage's text, and its effect on a valid reply.
struct Stage {
  std::string text;  // without a trigger; % stands for the place
  std::function<Answer(const Answer&)> of_hit;
};

Answer with_bytes(const Answer& good, Bytes bytes) {
  return {bytes.empty() ? SimTime{0} : good.after, bytes};
}

Answer late(const Answer& good, SimTime by) { return {good.after + by, good.bytes}; }

Answer twice(const Answer& good) {
  Bytes bytes = good.bytes;
  bytes.insert(bytes.end(), good.bytes.begin(), good.bytes.end());
  return with_bytes(good, bytes);
}

Answer refused(const Answer& good, std::uint8_t code) {
  return with_bytes(good, with_crc({good.bytes[0], static_cast<std::uint8_t>(good.bytes[1] | 0x80), code}));
}

Answer nothing(const Answer& good) { return with_bytes(good, {}); }

const std::vector<Stage>& stages() {
  static const std::vector<Stage> all{
      {"drop %", nothing},
      {"delay % by=20ms", [](const Answer& good) { return late(good, 20ms); }},
      {"corrupt_checksum %",
       [](const Answer& good) {
         Bytes bytes(good.bytes.begin(), good.bytes.end() - 1);
         bytes.push_back(static_cast<std::uint8_t>(~good.bytes.back()));
         return with_bytes(good, bytes);
       }},
      {"truncate % keep=3",
       [](const Answer& good) {
         return with_bytes(good, {good.bytes.begin(), good.bytes.begin() + 3});
       }},
      {"duplicate %", twice},
      {"duplicate % after=40ms", twice},
      {"noise % before=FF00 after=\"55\"",
       [](const Answer& good) {
         Bytes bytes{0xFF, 0x00};
         bytes.insert(bytes.end(), good.bytes.begin(), good.bytes.end());
         bytes.push_back(0x55);
         return with_bytes(good, bytes);
       }},
      {"collision % with=\"F0 0F\"",
       [](const Answer& good) {
         Bytes bytes{static_cast<std::uint8_t>(good.bytes[0] & 0xF0),
                     static_cast<std::uint8_t>(good.bytes[1] & 0x0F)};
         bytes.insert(bytes.end(), good.bytes.begin() + 2, good.bytes.end());
         return with_bytes(good, bytes);
       }},
      {"exception % code=4", [](const Answer& good) { return refused(good, 4); }},
      {"busy %", [](const Answer& good) { return refused(good, 6); }},
      {"early_reply %", [](const Answer& good) { return late(good, -750us); }},
      {"drop % of=request", nothing},
      {"delay % by=20ms of=request", [](const Answer& good) { return late(good, 20ms); }},
      {"delay % by=20ms of=both", [](const Answer& good) { return late(good, 40ms); }},
      {"corrupt_checksum % of=request", nothing},
      {"truncate % keep=7 of=request", nothing},
      {"duplicate % of=request", twice},
      {"duplicate % after=40ms of=request", twice},
      {"collision % of=request", nothing},
      // Tolerant framing finds a valid frame after noise.
      {"noise % before=FF of=request", [](const Answer& good) { return good; }},
  };
  return all;
}

std::string at(const std::string& stage, const std::string& place) {
  std::string text = stage;
  return text.replace(text.find('%'), 1, place);
}

/// Frame i is sent at i * 100 ms, and ends 4.6 ms later (the fourth 10.9 ms).
const std::vector<Bytes>& frames() {
  static const std::vector<Bytes> all{kAskFeeder, kSetSpeed,  kAskTurner,
                                      kSetMove,   kAskFeeder, kSwitchServoOn,
                                      kMove,      kAskTurner, with_crc({0x01, 0x04, 0x00, 0x01, 0x00, 0x01}),
                                      kAskFeeder};
  return all;
}

const std::vector<Answer>& good_answers() {
  static const std::vector<Answer> all = FaultyLine().ask_all(frames());
  return all;
}

TEST(WireFaults, WithoutThemTheLineAnswersAsTheSpecificationSays) {
  // Requests have 8 characters, except the fourth, which has 19: 10,885,416 ns.
  const SimTime after_long{10'885'416 + 750'000 + 572'916};
  EXPECT_EQ(good_answers(), (std::vector<Answer>{{kUsual, kFeederSays},
                                                 {kUsual, kSetSpeed},
                                                 {kUsual, kTurnerSays},
                                                 {after_long, kSetMoveDone},
                                                 {kUsual, kFeederSays},
                                                 {kUsual, kSwitchServoOn},
                                                 {kUsual, kMove},
                                                 {kUsual, kTurnerSays},
                                                 {kUsual, with_crc({0x01, 0x04, 0x02, 0xC0, 0x01})},
                                                 {kUsual, kFeederSays}}));
}

struct TriggerCase {
  std::string text;
  std::vector<int> hits;  // numbers of frames
};

const std::vector<TriggerCase>& line_triggers() {
  static const std::vector<TriggerCase> all{
      {"", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}},
      {"nth=3", {3}},
      {"nth=9..", {9, 10}},
      {"nth=4..6", {4, 5, 6}},
      {"every=4", {4, 8}},
      {"every=2 nth=3..7", {4, 6}},
      {"function=6", {2, 6, 7}},
      {"function=0x10", {4}},
      {"function=6 nth=2", {6}},
      {"address=0x1002", {2, 4}},  // the fourth writes 0x1000 to 0x1004
      {"address=feeder.Aaxis_Speed", {2, 4}},
      {"address=feeder.Aaxis_Pulse", {4}},
      {"address=0x1006..0x1014", {6}},
      {"station=2", {3, 8}},
      {"station=2 nth=2", {8}},
      {"at=450ms", {5}},
      {"at=450ms for=200ms", {5, 6}},
      {"at=504.583333ms", {5}},  // it has ended then, and the silence later
      {"at=505.333334ms", {6}},  // and executed at 505,333,333 ns
      {"from=350ms to=650ms", {4, 5, 6}},
      {"from=350ms times=2", {4, 5}},
      {"to=250ms", {1, 2}},
      {"times=2", {1, 2}},
      // The second frame hits at 205 ms, and then whatever comes before 455 ms.
      {"nth=2 for=250ms", {2, 3, 4}},
      {"nth=2 for=250ms function=3", {3, 5}},  // of those that match
      // The move starts at 706 ms and accelerates for 50 ms to 10,667 pulses per second: 1,060 pulses by the
      // eighth frame, 1,900 by the ninth... (at - 0.025 s) * 10,667.
      {"when=\"feeder.A.pulses > 1500\"", {9, 10}},
      {"when=\"feeder.A.pulses > 1500\" nth=1", {9}},
      {"when=\"feeder.A.pulses > 1500\" times=1", {9}},
      {"when=\"feeder.Aaxis_Speed == 200 and time < 450ms\" station=2", {3}},
      {"when=\"1 / feeder.A.pulses > 0\"", {}},  // no result counts as false
      // In the stream of seed 7 (splitmix64) the numbers 1, 2, 5, 6, 7, 8, 9 and 10 are below a half.
      {"chance=50% seed=7", {1, 2, 5, 6, 7, 8, 9, 10}},
      {"chance=30% seed=11", {2, 5, 7}},
      {"chance=100%", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}},
  };
  return all;
}

/// Stages count requests when they are received and replies when they are sent: here the same frames.
TEST(WireFaults, EveryStageWithEveryTriggerHitsExactlyItsFrames) {
  for (const Stage& stage : stages()) {
    for (const TriggerCase& trigger : line_triggers()) {
      // If both directions count as frames, the counts differ.
      const bool is_both = stage.text.find("of=both") != std::string::npos;
      const bool counts = trigger.text.find("nth") != std::string::npos ||
                          trigger.text.find("every") != std::string::npos ||
                          trigger.text.find("times") != std::string::npos ||
                          trigger.text.find("chance") != std::string::npos || trigger.text.find("at=") == 0;
      if (is_both && counts) continue;
      FaultyLine line;
      const std::string text = at(stage.text, "rs485") + (trigger.text.empty() ? "" : " " + trigger.text);
      const std::size_t number = line.inject(text);
      const std::vector<Answer> answers = line.ask_all(frames());
      for (std::size_t i = 0; i < answers.size(); ++i) {
        const bool is_hit =
            std::count(trigger.hits.begin(), trigger.hits.end(), static_cast<int>(i) + 1) != 0;
        const Answer& good = good_answers()[i];
        EXPECT_EQ(answers[i], is_hit ? stage.of_hit(good) : good) << text << ": frame " << i + 1;
      }
      EXPECT_EQ(line.course(number).hits, static_cast<std::int64_t>(trigger.hits.size()) * (is_both ? 2 : 1))
          << text;
      EXPECT_EQ(line.course(number).seen, is_both ? 20 : 10) << text;
    }
  }
}

TEST(WireFaults, OfADeviceSeeItsOwnFramesOnly) {
  struct Case {
    std::string text;
    std::vector<int> hits;
    std::int64_t seen;
  };
  for (const auto& [trigger, hits, seen] : std::vector<Case>{
           {"feeder nth=3", {4}, 8},  // after 1 and 2; the third is for the other station
           {"feeder every=4", {5, 10}, 8},
           {"turner", {3, 8}, 2},
           {"turner nth=2", {8}, 2},
           {"feeder address=Aaxis_Speed", {2, 4}, 8},
           {"turner address=0x1002", {}, 2},
           {"feeder when=\"turner.requests == 1\"", {4, 5, 6, 7}, 8},
       }) {
    for (const char* stage : {"drop % of=request", "drop %", "exception % code=4"}) {
      FaultyLine line;
      std::string text = stage;
      text.replace(text.find('%'), 1, trigger.substr(0, trigger.find(' ')));
      text += trigger.find(' ') == std::string::npos ? "" : trigger.substr(trigger.find(' '));
      const std::size_t number = line.inject(text);
      const std::vector<Answer> answers = line.ask_all(frames());
      for (std::size_t i = 0; i < answers.size(); ++i) {
        const bool is_hit = std::count(hits.begin(), hits.end(), static_cast<int>(i) + 1) != 0;
        const Answer& good = good_answers()[i];
        const Answer hit = std::string(stage).starts_with("exception") ? refused(good, 4) : nothing(good);
        EXPECT_EQ(answers[i], is_hit ? hit : good) << text << ": frame " << i + 1;
      }
      EXPECT_EQ(line.course(number).seen, seen) << text;
    }
  }
}

TEST(WireFaults, SlowDevicesCarryOutRequestsLate) {
  FaultyLine line;
  line.inject("slow feeder by=30ms nth=2");
  EXPECT_EQ(line.ask(kAskFeeder), (Answer{kUsual, kFeederSays}));
  line.world().advance_to(200ms);
  line.world().receive(0, kSetSpeed, 200ms);
  const auto speed = [&] {
    const RegisterName name = find_register(line.world().known(), "feeder.Aaxis_Speed");
    return read_value(*line.world().device(0).register_bank(), name.place);
  };
  // It would have been executed at 205,333,333 ns.
  line.world().advance_to(SimTime{235'333'332});
  EXPECT_EQ(speed(), 0);
  line.world().advance_to(SimTime{235'333'333});
  EXPECT_EQ(speed(), 200);
  line.world().advance_to(299ms);
  const auto sent = line.world().line(0).line.output();
  EXPECT_EQ(hex(sent), hex(kSetSpeed));
}

TEST(WireFaults, ADroppedRequestIsNotCarriedOutADroppedReplyIs) {
  for (const bool of_request : {false, true}) {
    FaultyLine line;
    line.inject(of_request ? "drop feeder of=request nth=1" : "drop feeder nth=1");
    EXPECT_EQ(line.ask(kSetSpeed).bytes, Bytes{});
    EXPECT_EQ(line.world().line(0).stations[0]->counters().requests, of_request ? 0u : 1u);
    const Answer read = line.ask(with_crc({0x01, 0x03, 0x10, 0x02, 0x00, 0x01}));
    const std::uint8_t speed = of_request ? 0 : 0xC8;
    EXPECT_EQ(read.bytes, with_crc({0x01, 0x03, 0x02, 0x00, speed}));
  }
}

TEST(WireFaults, ARefusedWriteChangesNothingAndABroadcastIsSilent) {
  FaultyLine line;
  const std::size_t number = line.inject("busy rs485 function=6");
  EXPECT_EQ(line.ask(kSetSpeed).bytes, (Bytes{0x01, 0x86, 0x06, 0xC2, 0x62}));
  EXPECT_EQ(line.ask(with_crc({0x00, 0x06, 0x10, 0x02, 0x00, 0x64})).bytes, Bytes{});
  for (const std::uint8_t station : {1, 2}) {
    EXPECT_EQ(line.ask(with_crc({station, 0x03, 0x10, 0x02, 0x00, 0x01})).bytes,
              with_crc({station, 0x03, 0x02, 0x00, 0x00}));
  }
  EXPECT_EQ(line.course(number).hits, 3) << "the broadcast is for both";
  EXPECT_EQ(line.world().line(0).stations[0]->counters().exceptions, 1u);
}

TEST(WireFaults, ABroadcastIsOneRequestOfTheLine) {
  FaultyLine line;
  const std::size_t number = line.inject("drop rs485 of=request nth=1");
  line.ask(with_crc({0x00, 0x06, 0x10, 0x02, 0x00, 0x64}));
  EXPECT_EQ(line.course(number).seen, 1);
  for (const std::uint8_t station : {1, 2}) {
    EXPECT_EQ(line.ask(with_crc({station, 0x03, 0x10, 0x02, 0x00, 0x01})).bytes,
              with_crc({station, 0x03, 0x02, 0x00, 0x00}))
        << "neither has received it";
  }
}

TEST(WireFaults, NoiseSpoilsARequestWhereOnlySilenceEndsAFrame) {
  FaultyLine strict("", {.strict_framing = true});
  strict.inject("noise rs485 before=FF of=request nth=1");
  strict.inject("noise rs485 after=FF of=request nth=2");
  EXPECT_EQ(strict.ask(kAskFeeder).bytes, Bytes{});
  EXPECT_EQ(strict.ask(kAskFeeder).bytes, Bytes{});
  EXPECT_EQ(strict.ask(kAskFeeder).bytes, kFeederSays);
}

TEST(WireFaults, AFrameThatIsCutShortIsOfTheRegistersItStillNames) {
  struct Case {
    Bytes cut;
    bool names;  // 0x1002
  };
  const std::vector<Case> cases = {
      {{0x01, 0x06, 0x10, 0x02}, true},
      {{0x01, 0x06, 0x10}, false},
      {{0x01, 0x03, 0x10, 0x02, 0x00, 0x01}, true},
      {{0x01, 0x03, 0x10, 0x02, 0x00}, false},
  };
  for (const Case& c : cases) {
    FaultyLine line("", {.strict_framing = true});
    const std::size_t fault = line.inject("drop feeder of=request address=0x1002");
    line.ask(with_crc(c.cut));
    EXPECT_EQ(line.course(fault).hits, c.names ? 1 : 0) << hex(c.cut);
  }
}

TEST(WireFaults, AnEarlyReplyIsOneUnderStrictFramingToo) {
  FaultyLine line("", {.strict_framing = true});
  line.inject("early_reply feeder nth=2");
  EXPECT_EQ(line.ask(kAskFeeder).after, kUsual);
  EXPECT_EQ(line.ask(kAskFeeder), (Answer{kUsual - 750us, kFeederSays}));
  EXPECT_EQ(line.ask(kAskTurner), (Answer{kUsual, kTurnerSays}));
}

TEST(WireFaults, StagesActInOrderAndDroppedFramesGoNoFurther) {
  FaultyLine line;
  const std::size_t cut = line.inject("truncate rs485 keep=2");
  const std::size_t garble = line.inject("corrupt_checksum rs485");
  EXPECT_EQ(line.ask(kAskFeeder).bytes, (Bytes{0x01, 0xFC}));  // 03 inverted
  const std::size_t drop = line.inject("drop rs485");
  const std::size_t behind = line.inject("delay rs485 by=1ms");
  EXPECT_EQ(line.ask(kAskFeeder).bytes, Bytes{});
  EXPECT_EQ(line.course(drop).hits, 1);
  EXPECT_EQ(line.course(behind).seen, 0);
  line.world().clear_fault(drop);
  line.world().clear_fault(cut);
  EXPECT_EQ(line.ask(kAskFeeder), (Answer{kUsual + 1ms, {0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x7B}}));
  EXPECT_EQ(line.course(garble).hits, 3);
  line.world().clear_fault(garble);
  line.world().clear_fault(behind);
  EXPECT_EQ(line.ask(kAskFeeder), (Answer{kUsual, kFeederSays})) << "all cleared";
}

TEST(WireFaults, ALateReplyRunsIntoTheNextOne) {
  // The first reply, 100 ms late, begins with the second one: the wire carries the AND of both.
  FaultyLine line;
  line.inject("delay feeder by=100ms nth=1");
  EXPECT_EQ(line.ask(kAskFeeder).bytes, Bytes{});
  Bytes both = kFeederSays;
  for (std::size_t i = 0; i < both.size(); ++i) both[i] &= kTurnerSays[i];
  EXPECT_EQ(line.ask(kAskTurner), (Answer{kUsual, both}));
  EXPECT_EQ(line.world().line(0).line.counters().collisions, 1u);
}

TEST(WireFaults, WhatIsLateDiesWithThePower) {
  FaultyLine line;
  line.inject("delay feeder by=100ms nth=1");
  line.ask(kAskFeeder);
  line.world().switch_power(0, false);
  line.world().switch_power(0, true);
  EXPECT_EQ(line.ask(kAskTurner), (Answer{kUsual, kTurnerSays}));
}

TEST(WireFaults, AtMostSoMuchIsLate) {
  FaultyLine line;
  line.inject("duplicate feeder after=1h of=request");
  line.inject("duplicate feeder after=2h of=request");
  line.inject("duplicate feeder after=3h of=request");
  for (int i = 0; i < 60; ++i) EXPECT_EQ(line.ask(kAskFeeder).bytes, kFeederSays);
  EXPECT_EQ(dynamic_cast<const RtuStation&>(*line.world().line(0).stations[0]).save().late.size(),
            FaultyWire::kMaxLate);
}

}  // namespace wire_faults_test
}  // namespace understudy::emulator::world
