// Hosts in simulated time that die, fork, never wait again, or wait for nothing, and two hosts on two lines.
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "tests/acceptance/at_terminal.h"
#include "tests/acceptance/host_time_rig.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace host_time_test {

TEST_F(HostTime, GoesOnWhenPartOfAHostDies) {
  const Finished child = exec({"sh", "-c", "sleep 1000 & sleep 5; kill -KILL $!; sleep 60; date -u +%T"});
  EXPECT_EQ(child.output, "00:01:05\n") << child.errors;
  const Finished parent = exec({"sh", "-c", "sleep 1000 & exec sh -c 'sleep 3; kill -SEGV $$'"});
  EXPECT_EQ(parent.exit_code, 128 + SIGSEGV) << parent.errors;
  const Finished thread = python(R"(
import os, threading, time
threading.Thread(target=lambda: (time.sleep(3), os._exit(7))).start()
time.sleep(100)
)");
  EXPECT_EQ(thread.exit_code, 7) << thread.errors;
}

TEST_F(HostTime, EndsWaitsThatSomethingElsewhereEnds) {
  const std::string spin = "while :; do :; done";
  const Process load({"sh", "-c", spin});
  for (int run = 0; run < 3; ++run) {
    const Finished host = exec({WOKEN_HOST}, {"--timeout", "60s"});
    EXPECT_EQ(host.exit_code, 0) << host.errors;
    EXPECT_EQ(host.output, "286 cells\n");
  }
}

TEST_F(HostTime, EndsTheChildrenOfPythonWhenTheirTimeIsOver) {
  const Finished host = python(R"(
import multiprocessing, os, signal, subprocess, time
began = time.monotonic()
def tell(what):
    global began
    print(what, round(time.monotonic() - began, 1))
    began = time.monotonic()
try:
    subprocess.run(["sleep", "40"], timeout=3)
except subprocess.TimeoutExpired:
    tell("run")
for end in ("terminate", "kill"):
    child = subprocess.Popen(["sleep", "40"])
    time.sleep(3)
    getattr(child, end)()
    child.wait()
    tell(end)
child = multiprocessing.get_context("fork").Process(target=time.sleep, args=[40])
child.start()
time.sleep(3)
child.terminate()
child.join()
tell("multiprocessing")
)");
  EXPECT_EQ(host.output, "run 3.0\nterminate 3.0\nkill 3.0\nmultiprocessing 3.0\n") << host.errors;
}

// Another thread waits while the command begins.
TEST_F(HostTime, KnowsTheCommandsOfAHostBeforeTheyGreet) {
  const Finished host = python(R"(
import ctypes, os, threading, time
libc = ctypes.CDLL(None)
libc.popen.restype = ctypes.c_void_p
libc.popen.argtypes = [ctypes.c_char_p, ctypes.c_char_p]
libc.pclose.argtypes = [ctypes.c_void_p]
threading.Thread(target=lambda: time.sleep(1000), daemon=True).start()
def popen():
    streams = [libc.popen(b"sleep 2; exit 5", b"r"), libc.popen(b"read line; sleep 1; exit 6", b"w")]
    return [os.waitstatus_to_exitcode(libc.pclose(stream)) for stream in reversed(streams)]
for run in range(10):
    began = time.monotonic()
    ends = [os.waitstatus_to_exitcode(os.system("sleep 3; exit 7")), *popen()]
    print(ends, round(time.monotonic() - began, 1), os.system("kill -TERM $$"))
os._exit(0)
)");
  std::string expected;
  for (int run = 0; run < 10; ++run) expected += "[7, 6, 5] 5.0 15\n";
  EXPECT_EQ(host.output, expected) << host.errors;
}

// Libc, or a system call of the host's own, starts some of them. They greet the bench only when they wait.
TEST_F(HostTime, FindsProcessesThatNobodyTellsItOf) {
  const std::string spin = "while :; do :; done";
  const Process load({"sh", "-c", spin});
  for (const char* const threads : {"alone", "threads"}) {
    for (int run = 0; run < 3; ++run) {
      const Finished host = exec({FORKING_HOST, threads}, {"--timeout", "60s"});
      EXPECT_EQ(host.exit_code, 0) << host.errors;
      EXPECT_EQ(host.output, "11 ways\n") << threads;
    }
  }
}

TEST_F(HostTime, TellsOfAHostInTheBackground) {
  const Finished host = exec({"sh", "-c", std::string(FORKING_HOST) + " background; sleep 5"});
  EXPECT_EQ(host.exit_code, 0) << host.errors;
  EXPECT_TRUE(std::regex_search(
      host.errors,
      std::regex("^understudy: forking_host \\(process [0-9]+\\) continues in the background although "
                 "the command has ended, and simulated time ends with the command; expected a host that "
                 "runs in the foreground\n$")))
      << host.errors;
}

// The shell that became understudy had started it.
TEST_F(HostTime, LeavesOtherChildrenOfItsProcessAlone) {
  const std::string spin = "while :; do :; done";
  const std::string command = std::string(UNDERSTUDY_BINARY) + " exec " + bench() +
                              " --host-time --timeout 30s -- sh -c 'sleep 5; kill '$!'; date -u +%T'";
  const Finished host = run({"sh", "-c", "timeout 60 sh -c '" + spin + "' & exec " + command});
  EXPECT_EQ(host.output, "00:00:05\n") << host.errors;
  EXPECT_EQ(host.errors, "");
}

// A host whose process becomes another program without the library ends soon, or sleeps.
TEST_F(HostTime, TellsWhichHostsDroppedTheLibrary) {
  const std::string spawns =
      "import os, time\n"
      "os.waitpid(os.posix_spawn('/bin/true', ['true'], {}), 0)\n";
  const std::string part = "of the host did not load our library, so it ran in real time";
  struct Case {
    Words command;
    int exit_code;
    std::string message;
  };
  const std::vector<Case> cases{
      {{"env", "-u", "LD_PRELOAD", "date"}, 125, "env: did not load our library"},
      {{"env", "-i", "/bin/true"}, 125, "env: did not load our library"},
      {{"env", "-i", "sleep", "0.1"}, 125, "env: did not load our library"},
      {{"env", "-i", "/bin/false"}, 125, "env: did not load our library"},
      {{"sh", "-c", "exec env -i true"}, 125, "sh: did not load our library"},
      {{"sh", "-c", "env -i true; exit 0"}, 125, "sh: did not load our library"},
      {{"sh", "-c", "env -i true; sleep 1; exit 0"}, 0, part},
      {{"sh", "-c", "env -i true; sleep 1; exit 3"}, 3, part},
      {{kPython, "-c", spawns}, 125, part},
      {{kPython, "-c", spawns + "time.sleep(1)"}, 0, part},
      {{"env", "true"}, 0, ""},
      {{"sh", "-c", "exec true"}, 0, ""},
      {{"sh", "-c", "/no/such/program; exec /no/such/program"}, 127, "/no/such/program: not found"},
  };
  for (int run = 0; run < 5; ++run) {
    for (const Case& each : cases) {
      const Finished host = exec(each.command);
      const std::string what = testing::PrintToString(each.command) + host.errors;
      EXPECT_EQ(host.exit_code, each.exit_code) << what;
      EXPECT_NE(host.errors.find(each.message), std::string::npos) << what;
      const bool is_told = host.errors.find("did not load") != std::string::npos;
      EXPECT_EQ(is_told, each.message.find("did not load") != std::string::npos) << what;
    }
  }
}

// Its end is often noticed before its greeting.
TEST_F(HostTime, TakesAHostThatIsOverAtOnce) {
  for (int run = 0; run < 20; ++run) {
    const Finished host = exec({"true"});
    ASSERT_EQ(host.exit_code, 0) << host.errors;
  }
}

TEST_F(HostTime, TakesAChildThatPollsInsteadOfItsParent) {
  const Finished host = python_twice(R"(
import os, select, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
settings = termios.tcgetattr(port)
settings[4] = settings[5] = termios.B19200
termios.tcsetattr(port, termios.TCSANOW, settings)
began = time.monotonic()
child = os.fork()
if child == 0:
    for poll in range(10):
        os.write(port, bytes.fromhex("010300010001D5CA"))
        answer = b""
        while len(answer) < 7 and select.select([port], [], [], 2)[0]:
            answer += os.read(port, 7)
        time.sleep(1)
    os._exit(answer.hex() == "010302c0012984")
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), round(time.monotonic() - began))
)");
  EXPECT_EQ(host.output, "1 10\n");
}

TEST_F(HostTime, TellsOnceThatAHostWaitsForNothing) {
  for (const char* const wait : {"signal.pause()", "select.select([], [], [])", "select.poll().poll()"}) {
    const Finished host = python(std::string("import select, signal\n") + wait, {"--timeout", "4s"});
    EXPECT_EQ(host.exit_code, 124);
    EXPECT_NE(host.errors.find("the host waits for something outside the bench, such as standard input or "
                               "another machine, so the clock is stopped\n"),
              std::string::npos)
        << wait << ": " << host.errors;
  }
}

TEST_F(HostTime, LetsAHostReadItsTerminal) {
  AtTerminal terminal({UNDERSTUDY_BINARY, "exec", bench(), "--host-time", "--", "/bin/sh", "-c",
                       "sleep 60; echo name?; read name; sleep 60; echo hello $name at $(date -u +%T)"});
  ASSERT_TRUE(terminal.shows("name?"));
  ASSERT_TRUE(terminal.shows("so the clock is stopped")) << terminal.screen();
  terminal.type("feeder\n");
  EXPECT_TRUE(terminal.shows("hello feeder at 00:02:00")) << terminal.screen();
  EXPECT_EQ(terminal.wait(kPatience), 0);
}

// Both poll for as long, never at the same moment.
TEST_F(HostTime, KeepsTwoHostsOnTwoLinesApart) {
  const std::string two = folder().write("two.yaml", R"(understudy: 1
lines:
  left: { stations: [ { name: feeder, model: simple2-r3 } ] }
  right: { stations: [ { name: lift, model: simple2-r3 } ] }
)");
  const std::string script = folder().write("host.py", R"(
import os, select, sys, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT_" + sys.argv[1]], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
settings = termios.tcgetattr(port)
settings[4] = settings[5] = termios.B19200
termios.tcsetattr(port, termios.TCSANOW, settings)
time.sleep(float(sys.argv[2]))
good = 0
for poll in range(20):
    os.write(port, bytes.fromhex("010300010001D5CA"))
    answer = b""
    while len(answer) < 7 and select.select([port], [], [], 1)[0]:
        answer += os.read(port, 7)
    good += answer.hex() == "010302c0012984"
    time.sleep(float(sys.argv[3]))
print(sys.argv[1], good, round(time.monotonic() - 3600, 1), flush=True)
)");
  const std::string command = std::string(kPython) + " " + script;
  const std::string both = command + " LEFT 0.0101 0.0201 & " + command + " RIGHT 0.0303 0.0607; wait";
  const std::string spin = "while :; do :; done";
  const Process load({"sh", "-c", spin});
  const Finished hosts =
      understudy({"exec", two, "--host-time", "--twice", "--timeout", "50s", "--", "sh", "-c", both});
  EXPECT_EQ(hosts.exit_code, 0) << hosts.errors;
  EXPECT_EQ(hosts.errors, "understudy: exec: 2 runs, all the same\n");
  // A request and its reply take 15 characters of 11 bits at 19,200 baud, and the device's silence.
  EXPECT_EQ(hosts.output, "LEFT 20 0.6\nRIGHT 20 1.4\nLEFT 20 0.6\nRIGHT 20 1.4\n");
}

}  // namespace host_time_test
}  // namespace understudy::acceptance
