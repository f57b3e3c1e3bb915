// Every rule with its limit. At 19200 8E1 a character takes 11 bits, 572,916.7 ns. A request of 8 characters
// ends after 4,583,333 ns; a Simple2-R3 waits for 0.75 ms of silence and then replies, at 5,333,333 ns. The
// reply of 7 characters ends 4,010,416 ns later, at 9,343,749 ns.
#include "emulator/play/lint/lint.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include "emulator/world/bench_file/bench_file.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::play {
namespace lint_test {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using Texts = std::vector<std::string>;

constexpr SimTime kRequestEnds{4'583'333};
constexpr SimTime kReplyEnds{9'343'749};

Bytes framed(Bytes bytes) {
  const std::size_t size = bytes.size();
  bytes.resize(size + 2);
  pty::append_rtu_crc(bytes, size);
  return bytes;
}

const Bytes kRead = framed({1, 3, 0, 1, 0, 1});  // HW_Code

class LintTest : public testing::Test {
 protected:
  explicit LintTest(const std::string& timing = "wire")
      : world_(world::parse_bench(models::all_models(),
                                  "understudy: 1\nlines: { rs485: { baud: 19200, timing: " + timing +
                                      ", stations: [ { name: feeder, model: simple2-r3, address: 1 } ] } }\n",
                                  "test.yaml", "/tmp"),
               {}, {}),
        lint_(world_) {
    world_.host_settings(0, pty::HostSettings{.baud = 19200, .stop_bits = 1});
  }

  void send(const Bytes& bytes, SimTime at) {
    world_.advance_to(at);
    world_.receive(0, bytes, at);
  }
  Texts findings_at(SimTime end) {
    world_.advance_to(end);
    return lint_.findings();
  }
  /// A write of one register, with the time that it takes.
  void write(int address, int value, SimTime at) {
    send(framed({1, 6, static_cast<std::uint8_t>(address >> 8), static_cast<std::uint8_t>(address),
                 static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)}),
         at);
  }

  world::World world_;
  Lint lint_;
};

TEST_F(LintTest, HasNothingToSayOfAHostThatWaitsAsLongAsItMust) {
  send(kRead, 0ns);
  send(kRead, kReplyEnds + 750us);
  EXPECT_EQ(findings_at(1s), Texts{});
}

TEST_F(LintTest, ReportsRequestsThatFollowTooSoon) {
  send(kRead, 0ns);
  send(kRead, kReplyEnds + 700us);                       // 10,043,749 ns
  send(kRead, kReplyEnds + 700us + kReplyEnds + 300us);  // after the second reply
  EXPECT_EQ(findings_at(1s), Texts{"rs485: 2 requests began before the line had been silent for 750us (after "
                                   "300us at worst); first at 10.043749ms"});
}

TEST_F(LintTest, ReportsRequestsThatDoNotWaitForTheAnswer) {
  send(kRead, 0ns);
  send(kRead, kRequestEnds + 400us);  // the reply starts 350 us later
  const Texts findings = findings_at(1s);
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[1],
            "rs485: 1 request began before the reply to the previous request; first at 4.983333ms");
}

TEST_F(LintTest, ReportsAHostThatTalksIntoTheAnswer) {
  send(kRead, 0ns);
  send(kRead, 6ms);  // the reply has started at 5.3 ms
  EXPECT_EQ(findings_at(1s), Texts{"rs485: 1 request began before the line had been silent for 750us (while "
                                   "a station was sending at worst); first at 6ms"});
}

TEST_F(LintTest, ReportsGapsWithinAFrame) {
  // Four characters are over after 2,291,666 ns.
  const SimTime half{2'291'666};
  const auto send_in_halves = [&](SimTime at, SimTime gap) {
    send({kRead.begin(), kRead.begin() + 4}, at);
    send({kRead.begin() + 4, kRead.end()}, at + half + gap);
  };
  send_in_halves(0ns, 700us);
  EXPECT_EQ(findings_at(1s), Texts{});
  send_in_halves(1s, 800us);
  send_in_halves(2s, 3ms);
  EXPECT_EQ(
      findings_at(3s),
      Texts{"rs485: 2 requests had gaps of more than 750us between two bytes (3ms at worst); first at 1s"});
}

TEST_F(LintTest, ReportsStationsThatAreNotThere) {
  send(framed({9, 3, 0, 1, 0, 1}), 0ns);
  send(framed({9, 3, 0, 1, 0, 1}), 100ms);
  send(framed({7, 3, 0, 1, 0, 1}), 200ms);
  send(kRead, 300ms);
  Bytes broken = framed({8, 3, 0, 1, 0, 1});
  broken.back() ^= 1;  // the addressee is unknown
  send(broken, 400ms);
  EXPECT_EQ(findings_at(1s), (Texts{"rs485: 1 request to station 7, which does not exist; first at 200ms",
                                    "rs485: 2 requests to station 9, which does not exist; first at 0s"}));
}

TEST_F(LintTest, ADeviceWithoutPowerIsThereAllTheSame) {
  world_.switch_power(0, false);
  send(kRead, 10ms);
  EXPECT_EQ(findings_at(1s), Texts{});
}

TEST_F(LintTest, ReportsWritesToWhatCanOnlyBeRead) {
  write(0x0001, 5, 0ns);                                            // HW_Code
  send(framed({1, 0x10, 0x0E, 0x04, 0, 2, 4, 0, 0, 0, 0}), 100ms);  // Cord_A, both words
  write(0x1014, 1, 200ms);                                          // Aaxis_SVON may be written
  const Texts findings = findings_at(1s);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings.front(), "rs485: 1 write to feeder.HW_Code, which is read-only; first at 0s");
  for (const std::string& finding : findings) EXPECT_EQ(finding.find("SVON"), std::string::npos) << finding;
}

constexpr int kKept = 0x0A04;  // DIN0_Aaxis_Alarm, 0 or 1, kept in EEPROM

TEST_F(LintTest, ReportsEepromRegistersThatAreChangedRepeatedly) {
  for (int i = 0; i < 11; ++i) write(kKept, 1 - i % 2, i * 10s);
  // 10 s apart; 100,000 of them are 1,000,000 s, 11.57 days.
  EXPECT_EQ(findings_at(200s),
            Texts{"rs485: 11 changes of feeder.DIN0_Aaxis_Alarm, which is stored in EEPROM: at this rate its "
                  "100000 writes last for 11.5 days; first at 0s"});
}

TEST_F(LintTest, TenChangesAreNoWear) {
  for (int i = 0; i < 10; ++i) write(kKept, 1 - i % 2, i * 10s);
  EXPECT_EQ(findings_at(200s), Texts{});
}

TEST_F(LintTest, ChangesThatLastForAYearAreNoWear) {
  // A year is 31,536,000 s, so they are 315.36 s apart.
  for (int i = 0; i < 20; ++i) write(kKept, 1 - i % 2, i * 316s);
  EXPECT_EQ(findings_at(7000s), Texts{});
}

TEST_F(LintTest, TheSameValueAgainIsNoWear) {
  for (int i = 0; i < 50; ++i) write(kKept, 1, i * 1s);
  EXPECT_EQ(findings_at(60s), Texts{});
}

TEST_F(LintTest, ARefusedValueIsNoWear) {
  for (int i = 0; i < 50; ++i) write(kKept, 2 + i, i * 1s);  // it can be 0 or 1
  EXPECT_EQ(findings_at(60s), Texts{});
}

TEST_F(LintTest, WhatIsNotKeptDoesNotWear) {
  for (int i = 0; i < 50; ++i) write(0x1001, i, i * 1s);  // the low half of Aaxis_Pulse
  EXPECT_EQ(findings_at(60s), Texts{});
}

class InstantLintTest : public LintTest {
 protected:
  InstantLintTest() : LintTest("instant") {}
};

TEST_F(InstantLintTest, WhereBytesTakeNoTimeTheHostIsNotHeldToAny) {
  send(kRead, 0ns);
  send(kRead, 0ns);
  send({kRead.begin(), kRead.begin() + 4}, 1s);
  send({kRead.begin() + 4, kRead.end()}, 1s + 5ms);
  send(framed({9, 3, 0, 1, 0, 1}), 2s);
  EXPECT_EQ(findings_at(3s), Texts{"rs485: 1 request to station 9, which does not exist; first at 2s"});
}

// --- in scenarios ----------------------------------------------------------------------------------

RunOptions with_lint(bool with_hash = false) {
  RunOptions options{.with_hash = with_hash};
  options.observers.push_back([](world::World& world) { return std::make_unique<Lint>(world); });
  return options;
}

const std::string kAbsent = "  - send: { bytes: 05 03 00 01 00 01 +crc, reply: nothing, within: 20ms }\n";

TEST(LintOfScenarios, IsInTheirResults) {
  EXPECT_EQ(played(kServoOn + kExampleMove, "", with_lint()).lint_findings, Texts{});
  const ScenarioResult result = played(kAbsent + kServoOn + kAbsent, "", with_lint());
  EXPECT_EQ(result.lint_findings, Texts{"rs485: 2 requests to station 5, which does not exist; first at 0s"});
}

TEST(LintOfScenarios, ContinuesBehindARestoreWithoutTakingItForHaste) {
  const ScenarioResult result = played(
      "  - snapshot: begin\n" + kServoOn + "  - advance: 1s\n" + kServoOn + "  - restore: begin\n" + kServoOn,
      "", with_lint());
  EXPECT_TRUE(has_passed(result));
  EXPECT_EQ(result.lint_findings, Texts{});
}

TEST(LintOfScenarios, ChangesNothing) {
  const std::string steps = kServoOn + kExampleMove + kAbsent +
                            "  - wait: { until: feeder.STATUS.4 == 0, within: 4s, poll: 7ms }\n";
  const ScenarioResult without = played(steps, "", {.with_hash = true});
  EXPECT_EQ(played(steps, "", with_lint(true)).outcome_hash, without.outcome_hash);
}

}  // namespace lint_test
}  // namespace understudy::emulator::play
