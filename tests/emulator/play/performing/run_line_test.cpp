// write, expect and send: which requests go over the line, in which order, and how their replies are judged.
#include "pty/rtu_crc.h"
#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::play {
namespace runner_line_test {

/// An executor in virtual time whose host's requests are recorded: "write 1 0x1002: 200 5", "read 1 0x0E04:
/// 2".
class WrittenDown final : public Executor {
 public:
  WrittenDown(std::unique_ptr<Executor> executor, std::vector<std::string>& requests)
      : executor_(std::move(executor)), requests_(requests) {}

  HostReply read(std::size_t line, int station, Table table, std::uint16_t first, int count) override {
    char text[64];
    std::snprintf(text, sizeof text, "read %d 0x%04X: %d", station, first, count);
    requests_.emplace_back(text);
    return executor_->read(line, station, table, first, count);
  }
  HostReply write(std::size_t line, int station, Table table, std::uint16_t first,
                  std::span<const std::uint16_t> words) override {
    char text[64];
    std::snprintf(text, sizeof text, "write %d 0x%04X:", station, first);
    requests_.emplace_back(text);
    for (const std::uint16_t word : words) requests_.back() += " " + std::to_string(word);
    return executor_->write(line, station, table, first, words);
  }
  HostReply write_message(std::size_t line, int station, std::uint16_t first,
                          std::span<const std::uint16_t> words) override {
    requests_.push_back("message of " + std::to_string(words.size()));
    return executor_->write_message(line, station, first, words);
  }
  std::vector<std::uint8_t> exchange(std::size_t line, std::span<const std::uint8_t> bytes,
                                     std::size_t wanted, SimTime within) override {
    requests_.push_back("exchange " + std::to_string(bytes.size()));
    return executor_->exchange(line, bytes, wanted, within);
  }
  void send_text(std::size_t line, const std::string& text) override { executor_->send_text(line, text); }
  std::vector<std::string> exchange_text(std::size_t line, const std::optional<std::string>& text,
                                         const world::LinesWanted& wanted, SimTime within) override {
    return executor_->exchange_text(line, text, wanted, within);
  }
  void with_world(const std::function<void(world::World&)>& act) override { executor_->with_world(act); }
  bool run_until(const Awaited& awaited, SimTime deadline) override {
    return executor_->run_until(awaited, deadline);
  }
  void advance(SimTime by) override { executor_->advance(by); }
  SimTime now() override { return executor_->now(); }
  Tick tick_of_last_write() override { return executor_->tick_of_last_write(); }

 private:
  std::unique_ptr<Executor> executor_;
  std::vector<std::string>& requests_;
};

std::vector<std::string> requests_of(const std::string& steps) {
  std::vector<std::string> requests;
  const RunOptions options{.make_executor = [&](const Scenario& scenario) {
    return std::make_unique<WrittenDown>(make_free_executor(scenario), requests);
  }};
  const ScenarioResult result = played(steps, "", options);
  EXPECT_TRUE(has_passed(result)) << steps << why(result);
  return requests;
}

TEST(RunnerOverTheLine, NeighboursThatAscendShareARequest) {
  struct Case {
    const char* step;
    std::vector<std::string> requests;
  };
  const std::vector<Case> cases = {
      {"write: { feeder.Aaxis_Speed: 200 }", {"write 1 0x1002: 200"}},
      {"write: { feeder.Aaxis_Speed: 200, feeder.Aaxis_AccTime: 5 }", {"write 1 0x1002: 200 5"}},
      // The written order counts, so descending addresses need a request each.
      {"write: { feeder.Aaxis_AccTime: 5, feeder.Aaxis_Speed: 200 }",
       {"write 1 0x1003: 5", "write 1 0x1002: 200"}},
      {"write: { feeder.Aaxis_Speed: 200, feeder.Aaxis_DecTime: 5 }",
       {"write 1 0x1002: 200", "write 1 0x1004: 5"}},
      // 32 bits, low word first: 100000 = 0x1_86A0, and -1 has all bits set.
      {"write: { feeder.Aaxis_Pulse: 100000 }", {"write 1 0x1000: 34464 1"}},
      {"write: { feeder.Aaxis_Pulse: -1 }", {"write 1 0x1000: 65535 65535"}},
      {"write: { feeder.Aaxis_Pulse: 7, feeder.Aaxis_Speed: 8, feeder.Baxis_Pulse: 9, feeder.Baxis_Speed: 1 "
       "}",
       {"write 1 0x1000: 7 0 8", "write 1 0x1006: 9 0 1"}},
      {"write: { feeder.Aaxis_Pulse_H: 1 }", {"write 1 0x1001: 1"}},
      {"write: { feeder.Aaxis_Pulse_L: 2, feeder.Aaxis_Pulse_H: 1 }", {"write 1 0x1000: 2 1"}},
      {"write: { feeder.0x1002: 3, feeder.Aaxis_AccTime: 4 }", {"write 1 0x1002: 3 4"}},
      {"write: { feeder.Aaxis_Speed: 2 * 50 + 1 }", {"write 1 0x1002: 101"}},
      {"expect: { feeder.HW_Code: 0xC001 }", {"read 1 0x0001: 1"}},
      {"expect: { feeder.HW_Code: 0xC001, feeder.Version: 152 }", {"read 1 0x0001: 2"}},
      {"expect: { feeder.Version: 152, feeder.HW_Code: 0xC001 }", {"read 1 0x0002: 1", "read 1 0x0001: 1"}},
      {"expect: { feeder.STATUS.4: 0, feeder.STATUS.5: 0, feeder.STATUS: 0 }", {"read 1 0x0000: 1"}},
      {"expect: { feeder.Cord_A: 0, feeder.Cord_B: 0, feeder.Analog_A: 0 }", {"read 1 0x0E04: 5"}},
      {"expect: { feeder.Cord_A_L: 0, feeder.Cord_A: 0 }", {"read 1 0x0E04: 2"}},
      {"expect: { feeder.STATUS: 0, feeder.Aaxis_Mode: 0 }", {"read 1 0x0000: 1", "read 1 0x0004: 1"}},
  };
  for (const Case& c : cases)
    EXPECT_EQ(requests_of(std::string("  - ") + c.step + "\n"), c.requests) << c.step;
}

TEST(RunnerOverTheLine, NoMoreThanARequestHolds) {
  // The program's cells: 4 * 256 neighbours.
  std::string write = "  - write: {";
  std::string expect = "  - expect: {";
  for (int i = 0; i < 130; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "feeder.0x%04X", 0x4000 + i);
    write += std::string(i == 0 ? " " : ", ") + name + ": 0";
    expect += std::string(i == 0 ? " " : ", ") + name + ": 0";
  }
  const auto requests = requests_of(write + " }\n" + expect + " }\n");
  ASSERT_EQ(requests.size(), 4U);
  EXPECT_EQ(requests[0].substr(0, 15), "write 1 0x4000:");
  EXPECT_EQ(requests[1], "write 1 0x407B: 0 0 0 0 0 0 0");  // the first one reads 123
  EXPECT_EQ(requests[2], "read 1 0x4000: 125");
  EXPECT_EQ(requests[3], "read 1 0x407D: 5");
}

TEST(RunnerOverTheLine, ABitIsReadWithItsRegisterAndWrittenBack) {
  EXPECT_EQ(requests_of("  - write: { feeder.DOUT_ALL: 0x41 }\n"
                        "  - write: { feeder.DOUT_ALL.3: 1, feeder.DOUT_ALL.0: 0 }\n"
                        "  - expect: { feeder.DOUT_ALL: 0x48 }\n"),
            (std::vector<std::string>{"write 1 0x0DF0: 65", "read 1 0x0DF0: 1", "write 1 0x0DF0: 73",
                                      "read 1 0x0DF0: 1", "write 1 0x0DF0: 72", "read 1 0x0DF0: 1"}));
  // Bit 31 of a 32-bit register, which has two words.
  EXPECT_EQ(requests_of("  - write: { feeder.Aaxis_Pulse: 5 }\n"
                        "  - write: { feeder.Aaxis_Pulse.31: 1 }\n"
                        "  - expect: { feeder.Aaxis_Pulse: -2147483643, feeder.Aaxis_Pulse.31: 1 }\n"),
            (std::vector<std::string>{"write 1 0x1000: 5 0", "read 1 0x1000: 2", "write 1 0x1000: 5 32768",
                                      "read 1 0x1000: 2"}));
}

TEST(RunnerOverTheLine, ValuesAreEvaluatedWhenTheStepIsPlayed) {
  passing(
      "  - write: { feeder.Aaxis_Speed: 200 }\n"
      "  - write: { feeder.Baxis_Speed: feeder.Aaxis_Speed + 1, feeder.Aaxis_AccTime: feeder.Aaxis_Speed / 2 "
      "}\n"
      "  - expect: { feeder.Baxis_Speed: 201, feeder.Aaxis_AccTime: 100 }\n");
  const Failure failure = failing("  - write: { feeder.Aaxis_Speed: feeder.STATUS - 1 }\n");
  EXPECT_EQ(failure.what, "feeder.Aaxis_Speed: -1 does not fit; expected 0 to 65535");
  EXPECT_EQ(failing("  - write: { feeder.Aaxis_Speed: (feeder.STATUS + 1) / 2.0 }\n").what,
            "feeder.Aaxis_Speed: 0.5 is not a whole number; expected one");
}

TEST(RunnerOverTheLine, ExceptionsAreExpectedOrTold) {
  passing(
      "  - { write: { feeder.Aaxis_Speed: 40000 }, exception: 3 }\n"
      "  - { write: { feeder.HW_Code: 1 }, exception: 2 }\n"
      "  - { expect: { feeder.0x0999: 0 }, exception: 2 }\n"
      "  - expect: { feeder.Aaxis_Speed: 0 }\n");
  Failure failure = failing("  - { write: { feeder.Aaxis_Speed: 40000 }, exception: 2 }\n");
  EXPECT_EQ(failure.expected, "write feeder.Aaxis_Speed: exception 2 (illegal data address)");
  EXPECT_EQ(failure.came, "write feeder.Aaxis_Speed: exception 3 (illegal data value)");
  failure = failing("  - { write: { feeder.Aaxis_Speed: 1 }, exception: 3 }\n");
  EXPECT_EQ(failure.what, "write feeder.Aaxis_Speed: done; expected exception 3 (illegal data value)");
  failure = failing("  - expect: { feeder.0x0999: 0 }\n");
  EXPECT_EQ(failure.what, "read feeder.0x0999: exception 2 (illegal data address); expected success");
}

TEST(RunnerOverTheLine, AnAnswerMayBeExpectedNotToCome) {
  // Each of the requests of a step: the two registers are not neighbours.
  passing(
      "  - inject: { drop: feeder, times: 4 }\n"
      "  - { write: { feeder.Aaxis_Speed: 200, feeder.Aaxis_Pulse: 5 }, reply: nothing }\n"
      "  - assert: time >= 1s\n"
      "  - { expect: { feeder.Aaxis_Speed: 1 }, reply: nothing, within: 20ms }\n"
      "  - assert: time < 1100ms\n"
      "  - { write: { feeder.Aaxis_SVON: 1 }, reply: nothing, within: 20ms }\n"
      "  - expect: { feeder.Aaxis_Speed: 200, feeder.Aaxis_Pulse: 5, feeder.Aaxis_SVON: 1 }\n");
  passing(
      "  - power: { feeder: off }\n"
      "  - { expect: { feeder.HW_Code: 0 }, reply: nothing, within: 50ms }\n");
  Failure failure = failing("  - { write: { feeder.Aaxis_Speed: 200 }, reply: nothing }\n");
  EXPECT_EQ(failure.what, "write feeder.Aaxis_Speed: done; expected no reply");
  EXPECT_EQ(failure.expected, "write feeder.Aaxis_Speed: no reply");
  failure = failing(
      "  - inject: { exception: feeder, code: 4 }\n"
      "  - { write: { feeder.Aaxis_Speed: 1 }, reply: nothing }\n");
  EXPECT_EQ(failure.what, "write feeder.Aaxis_Speed: exception 4 (device failure); expected no reply");
  failure = failing("  - { expect: { feeder.Aaxis_Speed: 0 }, reply: nothing }\n");
  EXPECT_EQ(failure.what, "read feeder.Aaxis_Speed: done; expected no reply");
}

TEST(RunnerOverTheLine, AnUnexpectedValueIsReportedWithWhatWentBefore) {
  const Failure failure = failing(
      "  - write: { feeder.Aaxis_Pulse: -5, feeder.Aaxis_Speed: 200 }\n"
      "  - expect: { feeder.Aaxis_Pulse: 5, feeder.Aaxis_Speed: 190 +- 5, feeder.HW_Code: 0xC001 }\n");
  EXPECT_EQ(failure.what, "feeder.Aaxis_Pulse is -5; expected 5");
  EXPECT_EQ(failure.expected, "feeder.Aaxis_Pulse = 5, feeder.Aaxis_Speed = 190 +- 5");
  EXPECT_EQ(failure.came, "feeder.Aaxis_Pulse = -5, feeder.Aaxis_Speed = 200");
  EXPECT_EQ(failure.details, std::vector<std::string>{"feeder.Aaxis_Speed is 200; expected 190 +- 5"});
  // A write of 3 words has 15 characters: 8,593,750 ns, + 750,000, and 8 of its reply: 4,583,333. The read
  // starts 2,005,209 later: 8 characters, 750,000; and its reply has 11.
  EXPECT_EQ(failure.frames, (std::vector<std::string>{
                                "0s rs485 -> write 0x1000 feeder.Aaxis_Pulse = -5, Aaxis_Speed = 200",
                                "9.34375ms rs485 <- done",
                                "15.932292ms rs485 -> read 0x1000 feeder.Aaxis_Pulse, Aaxis_Speed",
                                "21.265625ms rs485 <- feeder.Aaxis_Pulse = -5, Aaxis_Speed = 200",
                                "29.572917ms rs485 -> read 0x0001 feeder.HW_Code",
                                "34.90625ms rs485 <- feeder.HW_Code = 49153",
                            }));
  EXPECT_EQ(failure.state, (std::vector<std::string>{
                               "feeder: STATUS 0 (0x0000), Aaxis_Mode 0, Baxis_Mode 0, Cord_A 0, Cord_B 0, "
                               "PROG_MAIN_RunTime_Status 0, PROG_MAIN_NowLine 0, EEPROM_Writing 0",
                               "feeder.A: pulses 0, speed 0, position 0",
                               "feeder.B: pulses 0, speed 0, position 0",
                           }));
}

TEST(RunnerOverTheLine, TheLastTenFramesAreReported) {
  std::string steps;
  for (int i = 0; i < 30; ++i) steps += "  - write: { feeder.Aaxis_Speed: " + std::to_string(i) + " }\n";
  const Failure failure = failing(steps + "  - expect: { feeder.Aaxis_Speed: 7 }\n");
  ASSERT_EQ(failure.frames.size(), 10U);
  EXPECT_NE(failure.frames[0].find("-> write 0x1002 feeder.Aaxis_Speed = 26"), std::string::npos)
      << failure.frames[0];
  EXPECT_NE(failure.frames[9].find("<- feeder.Aaxis_Speed = 29"), std::string::npos) << failure.frames[9];
}

TEST(RunnerOverTheLine, WithoutPowerThereIsNoReply) {
  const ScenarioResult result = played("  - power: { feeder: off }\n  - expect: { feeder.STATUS: 0 }\n");
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->what, "read feeder.STATUS: no reply; expected success");
  EXPECT_EQ(result.failure->at, SimTime{504'583'333});  // 8 characters and 500 ms
  EXPECT_EQ(result.failure->state[0], "feeder: no power");
}

TEST(RunnerOverTheLine, SentBytesAreAnsweredExactly) {
  passing(
      "  - send: { bytes: 01 03 00 01 00 01 D5 CA, reply: 01 03 02 C0 01 29 84, within: 100ms }\n"
      "  - send: { bytes: 01 03 00 01 00 01 +crc, reply: 01 03 02 C0 01 +crc }\n"
      "  - send: { bytes: 01 03 00 01 00 01 D5 CB, reply: nothing, within: 30ms }\n"
      "  - send: { bytes: 01 03 00 01 00 01 D5 CA, within: 30ms }\n");
  Failure failure = failing("  - send: { bytes: 01 03 00 01 00 01 +crc, reply: 01 03 02 C0 02 +crc }\n");
  EXPECT_EQ(failure.came, "01 03 02 C0 01 29 84");
  EXPECT_EQ(failure.expected.substr(0, 14), "01 03 02 C0 02");
  EXPECT_EQ(failure.details, std::vector<std::string>{"that is: feeder.HW_Code = 49153"});
  failure = failing("  - send: { bytes: 01 03 00 01 00 01 +crc, reply: nothing, within: 30ms }\n");
  EXPECT_EQ(failure.what, "the reply is 01 03 02 C0 01 29 84; expected nothing");
  // A longer reply than expected is a different reply.
  failure = failing("  - send: { bytes: 01 03 00 01 00 01 +crc, reply: 01 03 02 C0 01 }\n");
  EXPECT_EQ(failure.came, "01 03 02 C0 01 29");
  failure = failing("  - send: { bytes: 09 03 00 01 00 01 +crc, reply: 09 }\n");
  EXPECT_EQ(failure.came, "nothing");
}

TEST(RunnerOverTheLine, TheGapKeepsRequestsApart) {
  const auto end_of = [](const std::string& more) {
    return passing("  - write: { feeder.Aaxis_Speed: 1 }\n  - write: { feeder.Aaxis_Speed: 2 }\n", more)
        .simulated;
  };
  // Twice 9,916,666, with t3.5 between.
  EXPECT_EQ(end_of(""), SimTime{2 * 9'916'666 + 2'005'209});
  EXPECT_EQ(end_of("gap: 15ms\n"), SimTime{2 * 9'916'666 + 2'005'209 + 15'000'000});
}

TEST(RunnerLine, AFailureReportsWhatFaultsDid) {
  const Failure failure = failing(
      "  - inject: { drop: feeder, function: 3, nth: 1 }\n"
      "  - inject: { stall: feeder.A }\n"
      "  - send: { bytes: 01 03 00 01 00 01 +crc, reply: 01 03 02 C0 01 +crc, within: 20ms }\n");
  ASSERT_EQ(failure.frames.size(), 2U);
  EXPECT_NE(failure.frames[0].find("-> read 0x0001 feeder.HW_Code"), std::string::npos) << failure.frames[0];
  EXPECT_TRUE(failure.frames[1].ends_with("rs485 <- (fault 1 drop: not sent)")) << failure.frames[1];
  ASSERT_GE(failure.state.size(), 2U);
  EXPECT_EQ(failure.state.rbegin()[1], "fault 1 drop feeder function=3 nth=1: hit 1 of 1 that matched");
  EXPECT_EQ(failure.state.back(), "fault 2 stall feeder.A: in force");
}

}  // namespace runner_line_test
}  // namespace understudy::emulator::play
