// `understudy poll`, the small Modbus master, with a running daemon.
#include <gtest/gtest.h>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace poll_test {

class Poll : public testing::Test {
 protected:
  Finished poll(Words words) const {
    words.insert(words.begin(), {"poll", daemon_.port()});
    return understudy(words);
  }
  void expect_printed(const Words& words, const std::string& printed) const {
    const Finished finished = poll(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    EXPECT_EQ(finished.output, printed);
    EXPECT_EQ(finished.errors, "");
  }
  void expect_failed(const Words& words) const {
    const Finished finished = poll(words);
    EXPECT_EQ(finished.exit_code, 1) << testing::PrintToString(words);
    EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
  }

  RunningUnderstudy daemon_;
};

TEST_F(Poll, ReadsByName) {
  expect_printed({"--model", "simple2-r3", "HW_Code", "Version", "STATUS.4", "Aaxis_Resoultion"},
                 "HW_Code 49153\nVersion 152\nSTATUS.4 0\nAaxis_Resoultion 3200\n");
}

TEST_F(Poll, ReadsByAddressAndRange) {
  expect_printed({"0x0001", "2"}, "0x0001 49153\n2 152\n");
  expect_printed({"0x0001:2"}, "0x0001 49153\n0x0002 152\n");
  expect_printed({"--function", "4", "0x0001"}, "0x0001 49153\n");
}

TEST_F(Poll, WritesAndReadsBack) {
  expect_printed({"--model", "simple2-r3", "Aaxis_Speed=200", "Aaxis_Pulse=-70000"}, "");
  expect_printed({"--model", "simple2-r3", "Aaxis_Speed", "Aaxis_Pulse"},
                 "Aaxis_Speed 200\nAaxis_Pulse -70000\n");
  expect_printed({"0x1002=0x12C"}, "");
  expect_printed({"0x1000:3"}, "0x1000 61072\n0x1001 65534\n0x1002 300\n");
  expect_printed({"--type", "s32", "0x1000=-500", "0x1000"}, "0x1000 -500\n");
  expect_printed({"--type", "u32", "0x1000"}, "0x1000 4294966796\n");
}

TEST_F(Poll, RunsAMoveToItsEnd) {
  expect_printed({"--model", "simple2-r3", "Aaxis_SVON=1", "Aaxis_Pulse=3200", "Aaxis_Speed=600",
                  "Aaxis_Move_INC=1", "STATUS.4"},
                 "STATUS.4 1\n");
  EXPECT_TRUE(eventually([&] {
    return poll({"--model", "simple2-r3", "STATUS.4"}).output == "STATUS.4 0\n";
  }));
  expect_printed({"--model", "simple2-r3", "Cord_A"}, "Cord_A 3200\n");
}

TEST_F(Poll, PollsAgainAndAgain) {
  expect_printed({"--times", "3", "--every", "10ms", "2"}, "2 152\n2 152\n2 152\n");
}

TEST_F(Poll, FailsOnAnExceptionWithOneLine) {
  expect_failed({"0x0003"});
  expect_failed({"0x0001=1"});
  expect_failed({"0x1003=3001"});
  expect_failed({"--model", "simple2-r3", "Aaxis_AccTime=3001"});
}

TEST_F(Poll, ReportsTheTablesRangeOfWhatNoWordHolds) {
  EXPECT_EQ(poll({"--model", "simple2-r3", "Aaxis_Speed=70000"}).errors,
            "understudy: poll: 70000 does not fit into Aaxis_Speed; expected 0 to 32768\n");
  EXPECT_EQ(poll({"0x1002=70000"}).errors,
            "understudy: poll: 70000 does not fit into 0x1002; expected -32768 to 65535\n");
}

TEST_F(Poll, FailsOnSilenceWithOneLine) { expect_failed({"--station", "9", "--timeout", "100ms", "2"}); }

TEST_F(Poll, ReportsWhoWasAskedWhereAndHow) {
  const std::string before = "understudy: poll: 2: " + daemon_.port() + ": station ";
  EXPECT_EQ(poll({"--station", "9", "--timeout", "100ms", "2"}).errors,
            before + "9 did not answer within 100ms at 19200 8E1\n");
  EXPECT_EQ(
      poll({"--baud", "9600", "--stop-bits", "2", "--parity", "none", "--timeout", "100ms", "2"}).errors,
      before + "1 did not answer within 100ms at 9600 8N2\n");
  EXPECT_EQ(poll({"0x0003"}).errors, "understudy: poll: 0x0003: " + daemon_.port() +
                                         ": station 1 answered with exception 2 (Illegal data address)\n");
  // The daemon knows the reason, and reports it once.
  poll({"--station", "9", "--timeout", "100ms", "2"});
  EXPECT_TRUE(eventually([&] {
    return daemon_.errors().find(
               "understudy: line line: a host sends requests to station 9, which does not exist; the line "
               "has 1 "
               "(device)\n") != std::string::npos;
  })) << daemon_.errors();
  EXPECT_EQ(daemon_.errors().find("station 9"), daemon_.errors().rfind("station 9"));
  EXPECT_NE(daemon_.errors().find("the host set 9600"), std::string::npos) << daemon_.errors();
}

TEST(PollByModel, AsksTheNumberThatItHasFromTheFactory) {
  for (const auto& [model, name] : {std::pair<std::string, std::string>{"super-40nc", "D8117"},
                                    {"simple2-r3", "HW_Code"},
                                    {"rs-m8194h", "1"}}) {
    const auto daemon = RunningUnderstudy::of_model(model);
    const Finished finished = understudy({"poll", daemon->port(), "--model", model, name});
    EXPECT_EQ(finished.exit_code, 0) << model << finished.errors;
  }
}

TEST_F(Poll, WorksWithoutParity) { expect_printed({"--parity", "none", "2"}, "2 152\n"); }

}  // namespace poll_test
}  // namespace understudy::acceptance
