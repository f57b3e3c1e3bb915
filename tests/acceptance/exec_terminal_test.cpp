// `understudy exec` at a terminal: the command controls it, and Ctrl-C and Ctrl-Z act as in a shell.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include "tests/acceptance/at_terminal.h"

namespace understudy::acceptance {
namespace exec_terminal_test {

class ExecAtTerminal : public testing::Test {
 protected:
  Words exec(const std::string& script) const {
    const std::string bench = folder_.write("bench.yaml",
                                            "understudy: 1\nlines:\n  rs485: { stations: [ { name: feeder, "
                                            "model: simple2-r3, address: 1 } ] }\n");
    return {UNDERSTUDY_BINARY, "exec", bench, "--record", folder_ / "recording", "--",
            "/bin/sh",         "-c",   script};
  }

 private:
  PrivateFolder folder_;
};

TEST_F(ExecAtTerminal, LetsTheCommandReadIt) {
  AtTerminal terminal(exec("echo name?; read name; echo hello $name"));
  ASSERT_TRUE(terminal.shows("name?"));
  terminal.type("feeder\n");
  EXPECT_TRUE(terminal.shows("hello feeder")) << terminal.screen();
  EXPECT_EQ(terminal.wait(kPatience), 0);
}

TEST_F(ExecAtTerminal, EndsTheCommandOnCtrlC) {
  AtTerminal terminal(exec("echo ready; exec sleep 600"));
  ASSERT_TRUE(terminal.shows("ready"));
  terminal.type("\x03");
  EXPECT_EQ(terminal.wait(kPatience), 128 + SIGINT);
}

TEST_F(ExecAtTerminal, LeavesCtrlCToACommandThatWantsIt) {
  AtTerminal terminal(
      exec("trap 'echo again; read x; exit 6' INT; echo ready; while :; do sleep 0.02; done"));
  ASSERT_TRUE(terminal.shows("ready"));
  terminal.type("\x03");
  ASSERT_TRUE(terminal.shows("again"));
  terminal.type("\n");
  EXPECT_EQ(terminal.wait(kPatience), 6);
}

TEST_F(ExecAtTerminal, StopsOnCtrlZAndContinues) {
  if (run({"bash", "-c", "true"}).exit_code != 0) GTEST_SKIP() << "bash is not installed";
  std::string line;
  // It does not fork: a shell that is stopped between vfork() and exec() of a child never reports that.
  for (const std::string& word :
       exec("trap 'echo go''ne; exit 4' INT; echo re''ady; while :; do read -r x && echo got \"$x\"; done")) {
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += quoted + "' ";
  }
  AtTerminal shell({"bash", "--norc", "--noprofile", "-i"});
  shell.type("PS1='prompt''> '\n");
  ASSERT_TRUE(shell.shows("prompt> "));
  shell.type(line + "\n");
  ASSERT_TRUE(shell.shows("ready")) << shell.screen();
  shell.type("\x1a");
  ASSERT_TRUE(shell.shows("Stopped")) << shell.screen();
  ASSERT_TRUE(shell.shows("prompt> ")) << shell.screen();
  shell.type("fg\n");
  // The shell prints the job before it gives it the terminal. A key that is pressed between has no effect.
  shell.type("line\n");
  ASSERT_TRUE(shell.shows("got line")) << shell.screen();
  shell.type("\x03");
  ASSERT_TRUE(shell.shows("gone")) << shell.screen();
  shell.type("echo code=$?\n");
  EXPECT_TRUE(shell.shows("code=4")) << shell.screen();
  shell.type("exit\n");
  EXPECT_EQ(shell.wait(kPatience), 0);
}

}  // namespace exec_terminal_test
}  // namespace understudy::acceptance
