// Time on the wire, several stations, collisions, limits.
#include "pty/line.h"

#include <gtest/gtest.h>

#include "tests/pty/fake_station.h"

namespace understudy::pty {
namespace line_test {

using namespace std::chrono_literals;

const Bytes kRequest = hex("01 03 00 01 00 01 D5 CA");
const Bytes kReply = hex("01 03 02 C0 01 29 84");
const LineOptions kQuietWire{.settings = {}, .timing = Timing::wire, .enforce_settings = false};
const LineOptions kInstant{.settings = {}, .timing = Timing::instant, .enforce_settings = false};

LineOptions at_baud(int baud) {
  LineOptions options = kQuietWire;
  options.settings.baud = baud;
  return options;
}

TEST(LineSettings, AreWrittenAsEngineersWriteThem) {
  EXPECT_EQ(to_string(LineSettings{}), "19200 8E1");
  EXPECT_EQ(to_string(LineSettings{.baud = 9600, .parity = Parity::none, .stop_bits = 2}), "9600 8N2");
  EXPECT_EQ(to_string(LineSettings{.baud = 115200, .data_bits = 7, .parity = Parity::odd}), "115200 7O1");
}

/// It wants to be called at once, whatever happens.
class AlwaysDue final : public Station {
 public:
  LineSettings settings() const override { return {}; }
  void receive(const TimedByte&) override {}
  void on_other_station() override {}
  std::optional<SimTime> due() const override { return 1s; }
  void run(SimTime, Transmitter&) override {}
};

TEST(Line, AStationThatIsDueForEverDoesNotHoldItForEver) {
  LineRig rig(kQuietWire);
  AlwaysDue station;
  rig.line.attach(station);
  rig.line.run(999ms);
  EXPECT_THROW(rig.line.run(2s), std::logic_error);
}

TEST(Line, CharactersTakeTheTimeThatTheWireTakes) {
  struct Case {
    LineSettings settings;
    std::vector<SimTime> ends;  // by hand: k * bits * 1e9 / baud, rounded down
  };
  const std::vector<Case> cases = {
      {{.baud = 19200}, {572'916ns, 1'145'833ns, 1'718'750ns, 2'291'666ns}},
      {{.baud = 115200}, {95'486ns, 190'972ns, 286'458ns, 381'944ns}},
      {{.baud = 9600, .parity = Parity::none}, {1'041'666ns, 2'083'333ns, 3'125'000ns, 4'166'666ns}},
  };
  for (const auto& [settings, ends] : cases) {
    LineRig rig({.settings = settings, .enforce_settings = false});
    FakeSlave slave(9, {});
    rig.line.attach(slave);
    rig.send(hex("11 22 33 44"), 5s);
    rig.run(10s);
    ASSERT_EQ(slave.received.size(), 4u);
    SimTime start{0};
    for (std::size_t i = 0; i < ends.size(); ++i) {
      EXPECT_EQ(slave.received[i].start, 5s + start) << to_string(settings) << " character " << i;
      EXPECT_EQ(slave.received[i].end, 5s + ends[i]) << to_string(settings) << " character " << i;
      start = ends[i];
    }
  }
}

TEST(Line, AnExchangeTakesRequestSilenceAndReply) {
  struct Case {
    int baud;
    SimTime served, first_out, last_out;
  };
  // 19200: 8 characters 4,583,333 ns, silence 750,000 ns, 1 and 7 characters 572,916 and 4,010,416 ns.
  // 115200: 763,888 ns, 750,000 ns, 95,486 and 668,402 ns.
  for (const Case& expected : {Case{19200, 5'333'333ns, 5'906'249ns, 9'343'749ns},
                               Case{115200, 1'513'888ns, 1'609'374ns, 2'182'290ns}}) {
    LineRig rig(at_baud(expected.baud));
    FakeSlave slave(1, kReply);
    rig.line.attach(slave);
    rig.send(kRequest, 0ns);
    rig.run(1s);
    ASSERT_EQ(slave.served_at, std::vector{expected.served});
    EXPECT_EQ(rig.out, kReply);
    EXPECT_EQ(rig.out_at.front(), expected.first_out);
    EXPECT_EQ(rig.out_at.back(), expected.last_out);
    EXPECT_EQ(rig.line.due(), std::nullopt);
  }
}

TEST(Line, OneLongStepIsTheSameAsManyShortOnes) {
  LineRig rig(kQuietWire);
  FakeSlave slave(1, kReply);
  rig.line.attach(slave);
  rig.send(kRequest, 0ns);
  rig.line.run(5'333'332ns);
  EXPECT_TRUE(slave.served_at.empty());
  rig.line.run(1s);
  EXPECT_EQ(slave.served_at, std::vector<SimTime>{5'333'333ns});
  const auto output = rig.line.output();
  EXPECT_EQ(Bytes(output.begin(), output.end()), kReply);
}

TEST(Line, LumpsFollowEachOtherWithoutDrift) {
  LineRig rig(kQuietWire);
  FakeSlave slave(9, {});
  rig.line.attach(slave);
  // 40,000 characters, a few at a time, always before the wire has run dry.
  const std::size_t count = 40'000;
  std::size_t sent = 0;
  for (SimTime now{0}; sent < count; now += 500us) {
    rig.run(now);
    const std::size_t lump = std::min({std::size_t{3}, count - sent, rig.line.room()});
    rig.send(Bytes(lump, 0x55), now);
    sent += lump;
  }
  rig.run(1h);
  ASSERT_EQ(slave.received.size(), count);
  for (std::size_t k : {1u, 2u, 3u, 19'199u, 19'200u, 19'201u, 38'400u, 40'000u}) {
    EXPECT_EQ(slave.received[k - 1].end, SimTime(static_cast<std::int64_t>(k) * 11 * 1'000'000'000 / 19200))
        << k;
  }
}

TEST(Line, ABurstBeginsWhenTheBytesComeAndNotBefore) {
  LineRig rig(kQuietWire);
  FakeSlave slave(9, {});
  rig.line.attach(slave);
  rig.send({0x01}, 0ns);
  rig.send({0x02}, 572'915ns);  // the first is still on the wire
  rig.send({0x03}, 2ms);        // idle since 1,145,833
  rig.run(1s);
  ASSERT_EQ(slave.received.size(), 3u);
  EXPECT_EQ(slave.received[1].start, 572'916ns);
  EXPECT_EQ(slave.received[1].end, 1'145'833ns);
  EXPECT_EQ(slave.received[2].start, 2ms);
}

TEST(Line, AStrictStationSeesGapsShorterThanACharacter) {
  // At 19200 baud the silence is little longer than a character: a gap of 749,999 ns is only detected 1.3 ms
  // after the last stop bit, and still must not end the frame.
  for (const SimTime gap : {749'999ns, 750'000ns}) {
    LineRig rig(kQuietWire);
    FakeSlave slave(1, kReply, {.strict = true, .silence = 750us});
    rig.line.attach(slave);
    rig.send({kRequest.begin(), kRequest.begin() + 3}, 0ns);
    rig.run(1'718'750ns + gap - 1ns);
    rig.send({kRequest.begin() + 3, kRequest.end()}, 1'718'750ns + gap);
    rig.run(1s);
    EXPECT_EQ(slave.served_at.size(), gap < 750us ? 1u : 0u);
  }
}

// --- several stations ----------------------------------------------------------------------------

TEST(Line, EveryStationReceivesTheHostAndNoneTheReply) {
  LineRig rig(kQuietWire);
  FakeSlave one(1, kReply);
  FakeSlave two(2, kReply);
  rig.line.attach(one);
  rig.line.attach(two);
  rig.send(kRequest, 0ns);
  rig.run(1s);
  EXPECT_EQ(rig.out, kReply);
  EXPECT_EQ(one.received.size(), kRequest.size());
  EXPECT_EQ(two.received.size(), kRequest.size());
  EXPECT_EQ(one.others, 0);
  EXPECT_EQ(two.others, 1);
}

TEST(Line, TheNewsOfAReplyComesWithItsFirstCharacter) {
  LineRig rig(kQuietWire);
  FakeTalker one;
  FakeTalker two;
  rig.line.attach(one);
  rig.line.attach(two);
  one.says[0ns] = {hex("11 22"), hex("33")};
  rig.line.run(572'915ns);
  EXPECT_EQ(two.others, 0);
  rig.line.run(572'916ns);
  EXPECT_EQ(two.others, 1);
  rig.line.run(1s);
  EXPECT_EQ(two.others, 1);
  EXPECT_EQ(one.others, 0);
}

TEST(Line, OneStationTalksAfterItself) {
  LineRig rig(kQuietWire);
  FakeTalker talker;
  rig.line.attach(talker);
  talker.says[0ns] = {hex("01 02")};
  talker.says[600us] = {hex("03")};
  rig.run(1s);
  EXPECT_EQ(rig.out, hex("01 02 03"));
  EXPECT_EQ(rig.out_at, (std::vector<SimTime>{572'916ns, 1'145'833ns, 1'718'750ns}));
  EXPECT_EQ(rig.line.counters().collisions, 0u);
}

TEST(Line, TwoStationsAtOnceAreGarbled) {
  struct Case {
    SimTime second_at;
    const char* first;
    const char* second;
    const char* out;
    bool collides;
  };
  const std::vector<Case> cases = {
      {0us, "0F F0 FF", "33 33 33", "03 30 33", true},
      {300us, "0F F0 FF", "33", "03 F0 FF", true},            // within the first character
      {600us, "0F F0 FF", "33", "0F 30 FF", true},            // within the second
      {600us, "0F F0 FF", "33 33 33", "0F 30 33 33", true},   // and continues after it
      {1'718'750ns, "0F F0 FF", "33", "0F F0 FF 33", false},  // right after it
      {1'718'749ns, "0F F0 FF", "33", "0F F0 33", true},      // a nanosecond earlier
  };
  for (const Case& collision : cases) {
    LineRig rig(kQuietWire);
    FakeTalker first;
    FakeTalker second;
    rig.line.attach(first);
    rig.line.attach(second);
    first.says[0ns] = {hex(collision.first)};
    second.says[collision.second_at] = {hex(collision.second)};
    rig.run(1s);
    EXPECT_EQ(rig.out, hex(collision.out)) << collision.second_at.count();
    EXPECT_EQ(rig.line.counters().collisions, collision.collides ? 1u : 0u);
    EXPECT_EQ(rig.warnings.size(), collision.collides ? 1u : 0u);
  }
}

TEST(Line, TwoStationsWithOneAddressCollideAndWarnOnce) {
  LineRig rig(kQuietWire);
  FakeSlave one(1, hex("FF 0F"));
  FakeSlave two(1, hex("F0 FF"));
  rig.line.attach(one);
  rig.line.attach(two);
  for (int i = 0; i < 3; ++i) {
    rig.send(kRequest, i * 1s);
    rig.run((i + 1) * 1s);
  }
  EXPECT_EQ(rig.out, hex("F0 0F F0 0F F0 0F"));
  EXPECT_EQ(rig.line.counters().collisions, 3u);
  ASSERT_EQ(rig.warnings.size(), 1u);
  EXPECT_EQ(rig.warnings[0], "line rs485: two stations replied at once; their replies are garbled");
  rig.line.host_opened();
  rig.send(kRequest, 9s);
  rig.run(10s);
  EXPECT_EQ(rig.warnings.size(), 2u);
}

TEST(Line, BothDirectionsAreIndependent) {
  LineRig rig(kQuietWire);
  FakeTalker talker;
  rig.line.attach(talker);
  talker.says[0ns] = {hex("01 02")};
  rig.send(hex("AA BB"), 100us);
  rig.run(1s);
  EXPECT_EQ(rig.out, hex("01 02"));
  EXPECT_EQ(rig.out_at.back(), 1'145'833ns);
  EXPECT_EQ(talker.received, hex("AA BB"));
}

TEST(Line, AtEqualTimesCharactersPrecedeStationsInOrder) {
  LineRig rig(kQuietWire);
  std::vector<int> order;
  struct Watcher : FakeTalker {
    std::vector<int>* log = nullptr;
    int id = 0;
    void receive(const TimedByte&) override { log->push_back(id); }
    void run(SimTime now, Transmitter& out) override {
      log->push_back(10 + id);
      FakeTalker::run(now, out);
    }
  } first, second;
  first.log = second.log = &order;
  first.id = 1;
  second.id = 2;
  rig.line.attach(first);
  rig.line.attach(second);
  first.says[572'916ns] = {{}};
  second.says[572'916ns] = {{}};
  rig.send({0x00}, 0ns);
  rig.run(1s);
  EXPECT_EQ(order, (std::vector{1, 2, 11, 12}));
}

// --- instant -------------------------------------------------------------------------------------

TEST(LineInstant, ServesARequestInOneCall) {
  LineRig rig(kInstant);
  FakeSlave slave(1, kReply, {.silence = 0ns, .patience = 10ms});
  rig.line.attach(slave);
  rig.send(kRequest, 3s);
  EXPECT_EQ(rig.line.due(), 3s);
  rig.line.run(3s);
  const auto output = rig.line.output();
  EXPECT_EQ(Bytes(output.begin(), output.end()), kReply);
  EXPECT_EQ(slave.served_at, std::vector<SimTime>{3s});
  EXPECT_EQ(rig.line.due(), std::nullopt);
}

TEST(LineInstant, ServesPipelinedRequestsToSeveralStationsInOrder) {
  LineRig rig(kInstant);
  const RtuFraming framing{.silence = 0ns, .patience = 10ms};
  FakeSlave one(1, hex("11"), framing);
  FakeSlave two(2, hex("22"), framing);
  rig.line.attach(one);
  rig.line.attach(two);
  const Bytes to_two = hex("02 03 00 01 00 01 D5 F9");
  Bytes lump;
  for (int i = 0; i < 128; ++i) {
    const Bytes& request = i % 2 == 0 ? to_two : kRequest;
    lump.insert(lump.end(), request.begin(), request.end());
  }
  ASSERT_EQ(lump.size(), rig.line.room());
  rig.send(lump, 0ns);
  rig.run(0ns);
  ASSERT_EQ(rig.out.size(), 128u);
  for (std::size_t i = 0; i < rig.out.size(); ++i) EXPECT_EQ(rig.out[i], i % 2 == 0 ? 0x22 : 0x11) << i;
  EXPECT_EQ(one.others, 64);
  EXPECT_EQ(two.others, 64);
  EXPECT_EQ(rig.line.counters().collisions, 0u);
}

}  // namespace line_test
}  // namespace understudy::pty
