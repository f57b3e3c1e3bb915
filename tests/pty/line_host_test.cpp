// The effect of a host's settings, of closing and of not reading on a line.
#include <gtest/gtest.h>

#include "pty/line.h"
#include "tests/pty/fake_station.h"

namespace understudy::pty {
namespace line_host_test {

using namespace std::chrono_literals;

const Bytes kRequest = hex("01 03 00 01 00 01 D5 CA");
const Bytes kReply = hex("01 03 02 C0 01 29 84");
const LineOptions kEnforcing{};
const LineOptions kTolerating{.settings = {}, .timing = Timing::wire, .enforce_settings = false};

TEST(LineHost, DemandsABaud) {
  EXPECT_THROW(Line("x", {.settings = {.baud = 0}}, nullptr), std::invalid_argument);
}

TEST(LineHost, AStationIsDeafToOtherSettings) {
  struct Case {
    HostSettings host;
    bool is_received;
    const char* warning;
  };
  const std::vector<Case> cases = {
      {{.baud = 19200}, true, ""},
      {{.baud = 9600},
       false,
       "line rs485: the host set 9600 baud, 1 stop bit; the station expects 19200 8E1, so it receives "
       "nothing"},
      {{.baud = 19200, .stop_bits = 2},
       false,
       "line rs485: the host set 19200 baud, 2 stop bits; the station expects 19200 8E1, so it receives "
       "nothing"},
      // Differences that a pseudo-terminal hides.
      {{.baud = 19200, .data_bits = 8, .parity = Parity::even}, true, ""},
      {{.baud = 19200, .data_bits = 8}, true, ""},
      {{.baud = 19200, .data_bits = 8, .parity = Parity::none},
       false,
       "line rs485: the host set 19200 8N1; the station expects 19200 8E1, so it receives nothing"},
      {{.baud = 19200, .data_bits = 8, .parity = Parity::odd},
       false,
       "line rs485: the host set 19200 8O1; the station expects 19200 8E1, so it receives nothing"},
      {{.baud = 19200, .data_bits = 7, .parity = Parity::even},
       false,
       "line rs485: the host set 19200 7E1; the station expects 19200 8E1, so it receives nothing"},
      {{.baud = 19200, .data_bits = 8, .parity = Parity::mark},
       false,
       "line rs485: the host set 19200 8M1; the station expects 19200 8E1, so it receives nothing"},
  };
  for (const Case& host : cases) {
    LineRig rig(kEnforcing);
    FakeSlave slave(1, kReply);
    rig.line.attach(slave);
    rig.line.host_opened();
    rig.line.host_settings(host.host);
    rig.send(kRequest, 0s);
    rig.run(1s);
    rig.send(kRequest, 1s);
    rig.run(2s);
    EXPECT_EQ(rig.out.size(), host.is_received ? 2 * kReply.size() : 0);
    EXPECT_EQ(rig.line.counters().bytes_unheard, host.is_received ? 0 : 2 * kRequest.size());
    EXPECT_EQ(rig.warnings,
              host.is_received ? std::vector<std::string>{} : std::vector<std::string>{host.warning});
  }
}

TEST(LineHost, ReceivesASpeedWithinTheTolerance) {
  struct Case {
    std::int64_t tolerance_ppm;
    int baud;
    bool is_received;
  };
  for (const Case& each :
       {Case{20'000, 18'816, true}, Case{20'000, 18'815, false}, Case{20'000, 19'584, true},
        Case{20'000, 19'585, false}, Case{0, 19'200, true}, Case{0, 19'201, false},
        Case{100'000, 21'120, true}, Case{100'000, 21'121, false}}) {
    LineRig rig({.settings = {}, .baud_tolerance_ppm = each.tolerance_ppm});
    FakeSlave slave(1, kReply);
    rig.line.attach(slave);
    rig.line.host_settings(HostSettings{.baud = each.baud});
    rig.send(kRequest, 0s);
    rig.run(1s);
    EXPECT_EQ(rig.out, each.is_received ? kReply : Bytes{}) << each.tolerance_ppm << " " << each.baud;
  }
}

/// Counts start bits.
class StartBits final : public LineObserver {
 public:
  int count = 0;
  void on_start_bit(SimTime) override { ++count; }
  void on_character(const TimedByte&, bool) override {}
  void on_nothing_more() override {}
  void on_transmission(const Transmission&) override {}
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime) override {}
};

// The second write comes while the first character is on the wire, which takes 573 us.
TEST(LineHost, JudgesEachCharacterOnceAtItsStartBit) {
  const Bytes first{kRequest[0]};
  const Bytes rest(kRequest.begin() + 1, kRequest.end());
  for (const bool is_corrected : {false, true}) {
    LineRig rig(kEnforcing);
    FakeSlave slave(1, kReply);
    StartBits start_bits;
    rig.line.attach(slave);
    rig.line.add_observer(start_bits);
    rig.line.host_settings(HostSettings{.baud = 9600});
    rig.send(first, 0s);
    rig.run(100us);
    if (is_corrected) rig.line.host_settings(HostSettings{.baud = 19200});
    rig.send(rest, 100us);
    rig.run(1s);
    EXPECT_EQ(rig.line.counters().bytes_unheard, is_corrected ? 1 : kRequest.size());
    EXPECT_EQ(slave.received.size(), is_corrected ? rest.size() : 0);
    EXPECT_EQ(start_bits.count, static_cast<int>(kRequest.size()));
    rig.line.remove_observer(start_bits);
  }
}

Bytes values_of(const std::vector<TimedByte>& received) {
  Bytes values;
  for (const TimedByte& byte : received) values.push_back(byte.value);
  return values;
}

// A character of 19200 8E1 takes 573 us: at 2 ms the fourth is on the wire, and stays there.
TEST(LineHost, TakesBackWhatIsNotOnTheWire) {
  LineRig rig(kEnforcing);
  FakeSlave slave(1, kReply);
  rig.line.attach(slave);
  rig.send(kRequest, 0s);
  rig.run(2ms);
  rig.line.host_purged();
  rig.line.host_purged();
  EXPECT_EQ(rig.line.room(), Line::kInputCapacity - 1);
  rig.send({0x55}, 2ms);
  rig.run(1s);
  Bytes received(kRequest.begin(), kRequest.begin() + 4);
  received.push_back(0x55);
  EXPECT_EQ(values_of(slave.received), received);
  rig.line.host_purged();  // nothing is there
  rig.send(kRequest, 1s);
  rig.run(2s);
  EXPECT_EQ(rig.out, kReply);
}

// The next host cannot take back what the previous one has left.
TEST(LineHost, TakesBackNothingOfTheHostBefore) {
  LineRig rig(kEnforcing);
  FakeSlave slave(1, kReply);
  rig.line.attach(slave);
  rig.send(kRequest, 0s);
  rig.line.host_closed();
  rig.line.host_opened();
  rig.send({0x55}, 0s);
  rig.line.host_purged();
  rig.run(1s);
  EXPECT_EQ(values_of(slave.received), kRequest);
}

// The length of 0x41 is only known after silence.
TEST(LineHost, NothingMoreIsServedAtThatMoment) {
  LineRig rig({.settings = {}, .timing = Timing::instant});
  FakeSlave slave(1, kReply, {.patience = 10ms});
  rig.line.attach(slave);
  rig.send(hex("01 41 01 02 03 1D 5D"), 1s);
  rig.run(1s);
  EXPECT_EQ(rig.out, Bytes{});
  rig.line.nothing_more(1s);
  const auto sent = rig.line.output();
  EXPECT_EQ(Bytes(sent.begin(), sent.end()), kReply);
}

TEST(LineHost, WarnsAgainForTheNextHostOnly) {
  LineRig rig(kEnforcing);
  FakeSlave slave(1, kReply);
  rig.line.attach(slave);
  for (int host = 0; host < 2; ++host) {
    rig.line.host_opened();
    rig.line.host_settings(HostSettings{.baud = 9600});
    rig.send(kRequest, host * 1s);
    rig.run(host * 1s + 1s);
    rig.line.host_closed();
    EXPECT_EQ(rig.warnings.size(), host + 1u);
  }
}

TEST(LineHost, ReceivesAHostThatSetNoSpeedAndWarnsOnce) {
  LineRig rig(kEnforcing);
  FakeSlave slave(1, kReply);
  rig.line.attach(slave);
  rig.send(kRequest, 0s);
  rig.run(1s);
  EXPECT_EQ(rig.out, kReply);
  EXPECT_EQ(rig.warnings,
            std::vector<std::string>{
                "line rs485: the host has not set a speed; its bytes are assumed to arrive intact"});
}

TEST(LineHost, ReceivesEveryHostWhereSettingsAreNotEnforced) {
  LineRig rig(kTolerating);
  FakeSlave slave(1, kReply);
  rig.line.attach(slave);
  rig.line.host_settings(HostSettings{.baud = 300, .stop_bits = 2});
  rig.send(kRequest, 0s);
  rig.run(1s);
  EXPECT_EQ(rig.out, kReply);
  EXPECT_TRUE(rig.warnings.empty());
}

TEST(LineHost, OnlyTheStationsWithOtherSettingsAreDeaf) {
  LineRig rig(kEnforcing);
  FakeSlave one(1, kReply);
  FakeSlave two(2, kReply);
  two.listens_to.baud = 9600;
  rig.line.attach(one);
  rig.line.attach(two);
  rig.line.host_settings(HostSettings{.baud = 19200});
  rig.send(kRequest, 0s);
  rig.run(1s);
  EXPECT_EQ(rig.out, kReply);
  EXPECT_TRUE(two.received.empty());
  EXPECT_EQ(rig.line.counters().bytes_unheard, 0u);
  EXPECT_EQ(rig.warnings,
            std::vector<std::string>{"line rs485: the host set 19200 baud, 1 stop bit; station 2 of the line "
                                     "expects 9600 8E1, so it receives nothing"});
  two.listens_to.baud = 19200;  // as after a change of its own settings
  rig.send(kRequest, 1s);
  rig.run(2s);
  EXPECT_EQ(two.received.size(), kRequest.size());
}

TEST(LineHost, TakesNoMoreThanItHasRoomFor) {
  LineRig rig(kTolerating);
  FakeSlave slave(9, {});
  rig.line.attach(slave);
  EXPECT_EQ(rig.line.room(), 1024u);
  rig.send(Bytes(1000, 0x55), 0s);
  EXPECT_EQ(rig.line.room(), 24u);
  rig.send(Bytes(100, 0x66), 0s);
  EXPECT_EQ(rig.line.room(), 0u);
  rig.line.run(572'916ns);
  EXPECT_EQ(rig.line.room(), 1u);
  rig.run(10s);
  EXPECT_EQ(rig.line.room(), 1024u);
  EXPECT_EQ(slave.received.size(), 1024u);
  EXPECT_EQ(slave.received.back().value, 0x66);
  EXPECT_EQ(rig.line.counters().bytes_in, 1024u);
}

TEST(LineHost, KeepsTheOldestOutputOfAHostThatDoesNotRead) {
  for (const Timing timing : {Timing::wire, Timing::instant}) {
    LineRig rig({.settings = {}, .timing = timing, .enforce_settings = false});
    FakeTalker talker;
    rig.line.attach(talker);
    for (int i = 0; i < 20; ++i) talker.says[i * 1s] = {Bytes(256, static_cast<std::uint8_t>(i))};
    rig.line.run(100s);
    const auto output = rig.line.output();
    ASSERT_EQ(output.size(), 4096u);
    EXPECT_EQ(output.front(), 0);
    EXPECT_EQ(output.back(), 15);
    EXPECT_EQ(rig.line.counters().bytes_out, 4096u);
    EXPECT_EQ(rig.line.counters().bytes_discarded, 4u * 256);
    rig.line.take_output(10);
    EXPECT_EQ(rig.line.output().size(), 4086u);
    talker.says[200s] = {Bytes(20, 0xEE)};
    EXPECT_EQ(rig.line.due(), std::nullopt);  // it sent more without being asked: the line learns of it
    rig.line.due_changed();
    EXPECT_EQ(rig.line.due(), 200s);
    rig.line.run(300s);
    EXPECT_EQ(rig.line.output().size(), 4096u);
    EXPECT_EQ(rig.line.output().back(), 0xEE);
    EXPECT_EQ(rig.line.output()[0], 0);
  }
}

/// Takes all there is, when nothing else has room.
class Taker final : public LineObserver {
 public:
  explicit Taker(Line& line) : line_(line) { line_.add_observer(*this); }
  void on_output_full() override {
    taken.insert(taken.end(), line_.output().begin(), line_.output().end());
    line_.take_output(line_.output().size());
  }
  void on_start_bit(SimTime) override {}
  void on_character(const TimedByte&, bool) override {}
  void on_nothing_more() override {}
  void on_transmission(const Transmission&) override {}
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime) override {}

  Bytes taken;

 private:
  Line& line_;
};

TEST(LineHost, NothingIsLostToAnObserverThatTakesIt) {
  for (const Timing timing : {Timing::wire, Timing::instant}) {
    LineRig rig({.settings = {}, .timing = timing, .enforce_settings = false});
    FakeTalker talker;
    rig.line.attach(talker);
    Taker taker(rig.line);
    for (int i = 0; i < 40; ++i) talker.says[i * 1s] = {Bytes(256, static_cast<std::uint8_t>(i))};
    rig.line.run(100s);
    EXPECT_EQ(taker.taken.size(), 8192u) << "twice what the line stores";
    EXPECT_EQ(rig.line.output().size(), 40u * 256 - 8192);
    EXPECT_EQ(rig.line.output().back(), 39);
    EXPECT_EQ(rig.line.counters().bytes_discarded, 0u);
    rig.line.remove_observer(taker);
  }
}

TEST(LineHost, AStationThatTalksTooFastStaysBounded) {
  LineRig rig(kTolerating);
  FakeTalker talker;
  rig.line.attach(talker);
  for (int i = 0; i < 1000; ++i) talker.says[i * 1us] = {Bytes(100, 0x01)};
  rig.run(1h);
  EXPECT_GE(rig.out.size(), 4096u);
  EXPECT_LE(rig.out.size(), 4196u);
  EXPECT_EQ(rig.out.size() + rig.line.counters().bytes_discarded, 100'000u);
}

TEST(LineHost, AClosedHostGetsNothingMoreButIsServed) {
  LineRig rig(kTolerating);
  FakeSlave slave(1, kReply);
  rig.line.attach(slave);
  rig.line.host_opened();
  rig.send(kRequest, 0s);
  rig.line.run(6ms);  // the reply is on the wire, its first character has been sent
  EXPECT_EQ(rig.line.output().size(), 1u);
  rig.send(kRequest, 6ms);
  rig.line.host_closed();
  EXPECT_TRUE(rig.line.output().empty());
  rig.line.run(1s);
  EXPECT_EQ(slave.served_at.size(), 2u);  // what it had written was served
  EXPECT_TRUE(rig.line.output().empty());
  rig.line.host_opened();
  rig.send(kRequest, 1s);
  rig.run(2s);
  EXPECT_EQ(rig.out, kReply);
}

TEST(LineHost, AHostThatWritesAndClosesKeepsItsOwnSettings) {
  LineRig rig(kEnforcing);
  FakeSlave slave(1, kReply);
  rig.line.attach(slave);
  rig.line.host_opened();
  rig.line.host_settings(HostSettings{.baud = 19200});
  rig.send(kRequest, 0s);
  rig.line.host_closed();
  rig.run(1s);
  EXPECT_EQ(slave.served_at.size(), 1u);
  EXPECT_TRUE(rig.warnings.empty());
}

}  // namespace line_host_test
}  // namespace understudy::pty
