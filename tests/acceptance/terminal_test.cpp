// Output that is only for people at a terminal.
#include <gtest/gtest.h>

#include "tests/acceptance/at_terminal.h"

namespace understudy::acceptance {
namespace terminal_test {

const std::string kBench =
    "understudy: 1\nname: \"day ${i}\"\ncases: [ { i: 1 }, { i: 2 } ]\n"
    "bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
    "steps:\n";

class Terminal : public testing::Test {
 protected:
  std::string scenario(const std::string& steps) const { return folder_.write("day.yaml", kBench + steps); }
  PrivateFolder folder_;
};

TEST_F(Terminal, VerdictsAreColoured) {
  AtTerminal run({UNDERSTUDY_BINARY, "run", scenario("  - expect: { feeder.HW_Code: \"49152 + ${i}\" }\n")},
                 {{"TERM", "xterm"}, {"NO_COLOR", ""}});
  EXPECT_TRUE(run.shows("\x1b[32mok\x1b[0m ")) << run.screen();
  EXPECT_TRUE(run.shows("\x1b[1;31mFAIL\x1b[0m ")) << run.screen();
  EXPECT_EQ(run.wait(kPatience), 1);
}

TEST_F(Terminal, NothingIsColouredElsewhereOrWhereItIsUnwanted) {
  const std::string file = scenario("  - expect: { feeder.HW_Code: \"49152 + ${i}\" }\n");
  EXPECT_EQ(understudy({"run", file}).output.find('\x1b'), std::string::npos);
  for (const Environment& environment : {Environment{{"NO_COLOR", "1"}}, Environment{{"TERM", "dumb"}}}) {
    AtTerminal run({UNDERSTUDY_BINARY, "run", file}, environment);
    EXPECT_TRUE(run.shows("1 passed, 1 failed")) << run.screen();
    EXPECT_EQ(run.screen().find('\x1b'), std::string::npos);
  }
}

TEST_F(Terminal, ALongRunReportsHowFarItHasCome) {
  // In real time, so that it takes as long on every machine.
  const Words run{"run", "--real-time", "--jobs", "1", scenario("  - advance: 3s\n")};
  Words command{UNDERSTUDY_BINARY};
  command.insert(command.end(), run.begin(), run.end());
  AtTerminal at_terminal(command, {{"TERM", "xterm"}, {"CI", ""}});
  EXPECT_TRUE(at_terminal.shows("0 of 2 played, ")) << at_terminal.screen();
  EXPECT_TRUE(at_terminal.shows("1 of 2 played, ")) << at_terminal.screen();
  EXPECT_TRUE(at_terminal.shows("\r\x1b[K")) << "it is cleared";
  EXPECT_TRUE(at_terminal.shows("2 passed, 0 failed")) << at_terminal.screen();
  EXPECT_EQ(understudy(run).output.find("played"), std::string::npos) << "no terminal";
}

TEST_F(Terminal, FramesContinueUntilCtrlC) {
  const RunningUnderstudy daemon;
  AtTerminal frames({UNDERSTUDY_BINARY, "ctl", "--control", daemon.control(), "frames"});
  for (int speed : {7, 8}) {
    const std::string value = std::to_string(speed);
    EXPECT_EQ(understudy({"poll", daemon.port(), "--model", "simple2-r3", "Aaxis_Speed=" + value}).exit_code,
              0);
    EXPECT_TRUE(frames.shows("s line -> write 0x1002 device.Aaxis_Speed = " + value)) << frames.screen();
    EXPECT_TRUE(frames.shows("s line <- done")) << frames.screen();
  }
  frames.type("\x03");
  EXPECT_EQ(frames.wait(kPatience), 0);
}

}  // namespace terminal_test
}  // namespace understudy::acceptance
