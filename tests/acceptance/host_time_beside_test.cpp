// Hosts in simulated time beside scenarios and over TCP, and what recordings tell of their waits.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/acceptance/host_time_rig.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace host_time_test {

using Json = nlohmann::json;

// The scenario beside it drops the host's second request from 0.538 s on, and ends long after the host.
constexpr const char* kScenarioBeside = R"(understudy: 1
name: beside
bench: bench.yaml
steps:
  - advance: 37ms
  - input: { feeder.DIN_3: on }
  - wait: { until: feeder.DIN_3 == 1, within: 5s }
  - advance: 500ms
  - inject: { drop: feeder, nth: 2 }
  - advance: 60s
  - input: { feeder.DIN_3: off }
  - wait: { until: feeder.A.pulses == 1, within: 5s }
)";

TEST_F(HostTime, MeetsAScenarioAtTheSameMomentsInEachRun) {
  const std::string beside = folder().write("beside.yaml", kScenarioBeside);
  const std::string spin = "while :; do :; done";
  const Process load({"sh", "-c", spin});
  const std::string script = R"(
import os, select, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
settings = termios.tcgetattr(port)
settings[4] = settings[5] = termios.B19200
termios.tcsetattr(port, termios.TCSANOW, settings)
before = None
for i in range(150):
    os.write(port, bytes.fromhex("010300010001D5CA"))
    answer = b""
    while len(answer) < 7 and select.select([port], [], [], 0.1)[0]:
        answer += os.read(port, 7)
    if answer != before:
        print(f"{time.monotonic() - 3600:.4f} {answer.hex()}")
    before = answer
    time.sleep(0.01)
)";
  std::string first;
  for (const char* const name : {"first", "second"}) {
    const std::string recording = folder() / name;
    const Finished host = python(script, {"--with", beside, "--record", recording});
    EXPECT_EQ(host.exit_code, 1);  // nobody moves the axis
    EXPECT_NE(host.errors.find("FAIL"), std::string::npos) << host.errors;
    EXPECT_NE(host.errors.find("beside.yaml: beside (at 65.538s)"), std::string::npos) << host.errors;
    const std::string all = host.output + text_of(recording);
    if (first.empty()) first = all;
    EXPECT_EQ(all, first);
    // The first answer, silence, and the answer again.
    EXPECT_EQ(std::ranges::count(host.output, '\n'), 3) << host.output;
  }
}

TEST_F(HostTime, GivesUpAScenarioWithTheHost) {
  const std::string beside = folder().write("beside.yaml", kScenarioBeside);
  const Finished killed = exec({"sh", "-c", "sleep 1; kill -KILL $$"}, {"--with", beside});
  EXPECT_EQ(killed.exit_code, 128 + 9);
  EXPECT_NE(killed.errors.find("beside.yaml: did not run to its end"), std::string::npos) << killed.errors;
  const Finished late = python("while True: pass", {"--with", beside, "--timeout", "1s"});
  EXPECT_EQ(late.exit_code, 124);
  EXPECT_NE(late.errors.find("beside.yaml: did not run to its end"), std::string::npos) << late.errors;
}

// A host with blocking sockets and one with timeouts; a gateway's exception after its own time; a second
// master; a connection that is closed and made again; a port that the bench does not have.
TEST_F(HostTime, ReachesLinesOverTcp) {
  const Finished host = python_twice(R"(
import socket, time
def ask(connection, station):
    connection.sendall(bytes([0, 1, 0, 0, 0, 6, station, 3, 0, 1, 0, 1]))
began = time.monotonic()
first = socket.create_connection(("192.168.77.5", 502))
first.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
ask(first, 1)
print(first.recv(100).hex(), first.getpeername(), time.monotonic() - began < 0.02)
second = socket.create_connection(("192.168.77.5", 502), timeout=0.5)
ask(first, 9)
ask(second, 1)
try:
    second.recv(100)
except TimeoutError:
    print("late", round(time.monotonic() - began, 1))
print(first.recv(100).hex(), round(time.monotonic() - began, 1))
print(second.recv(7, socket.MSG_WAITALL).hex(), second.recv(4).hex())
first.close()
second.close()
again = socket.create_connection(("192.168.77.5", 502))
ask(again, 1)
time.sleep(1)
print(again.recv(100).hex())
again.shutdown(socket.SHUT_WR)
print(again.recv(100))
try:
    socket.create_connection(("127.0.0.1", 502))
except OSError as error:
    print(type(error).__name__)
)",
                                     {"--listen", "modbus-tcp://192.168.77.5:502", "--no-pty"});
  EXPECT_EQ(host.output,
            "000100000005010302c001 ('192.168.77.5', 502) True\n"
            "late 0.5\n"
            "00010000000309830b 1.0\n"
            "00010000000501 0302c001\n"
            "000100000005010302c001\n"
            "b''\n"
            "ConnectionRefusedError\n");
}

// A thread waits for a connection that another one closes, and then for that thread's end.
TEST_F(HostTime, WakesAThreadWhoseConnectionIsClosed) {
  const Finished host = python_twice(R"(
import socket, threading, time
def read(connection):
    try:
        while connection.recv(100): pass
    except OSError: pass
for n in range(5):
    connection = socket.create_connection(("127.0.0.1", 5020))
    connection.settimeout(5)
    reader = threading.Thread(target=read, args=[connection])
    reader.start()
    time.sleep(1)
    began = time.monotonic()
    connection.shutdown(socket.SHUT_RDWR)
    connection.close()
    reader.join(7)
    print(round(time.monotonic() - began, 1))
    time.sleep(0.3)
)",
                                     {"--listen", "rtu://127.0.0.1:5020"});
  EXPECT_EQ(host.output, "0.0\n0.0\n0.0\n0.0\n0.0\n");
}

// A request that is answered, a pause, and one to a station that is not there.
constexpr const char* kAsker = R"(
import os, select, sys, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
settings = termios.tcgetattr(port)
settings[4] = settings[5] = termios.B19200
termios.tcsetattr(port, termios.TCSANOW, settings)
def ask(request):
    os.write(port, bytes.fromhex(request))
    answer = b""
    while len(answer) < 7 and select.select([port], [], [], 0.5)[0]:
        answer += os.read(port, 7)
ask("010300010001D5CA")
time.sleep(2)
ask("090300010001D442")
select.select([port], [], [], 0.25)
)";

TEST_F(HostTime, RecordsWhatAHostWaitsFor) {
  python_twice(kAsker);
  const std::string recording = text_of(folder() / "first");
  for (const char* const part : {R"("do":"wait","since":0,"thread":1,"text":"waits for a reply"})",
                                 R"("text":"sleeps"})", R"("text":"waits for a reply in vain"})"}) {
    EXPECT_NE(recording.find(part), std::string::npos) << part;
  }
  const std::string report = folder() / "report.html";
  const Finished again = understudy({"replay", folder() / "first", "--report", report});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  for (const char* const part :
       {"what the host waits for", "sleeps, 2s</title>", "in vain, 500ms</title>", "in vain, 250ms</title>"})
    EXPECT_NE(text_of(report).find(part), std::string::npos) << part;
}

/// The waits in a recording as spans of the control socket.
Json waits_in(const std::string& recording) {
  Json waits = Json::array();
  for (const std::string& line : lines_of(text_of(recording))) {
    const Json entry = Json::parse(line);
    if (entry.value("do", "") != "wait") continue;
    Json wait{{"lane", "host"},
              {"kind", "wait"},
              {"begin_ns", entry["since"]},
              {"end_ns", entry["t"]},
              {"text", entry["text"]}};
    if (entry["text"].get<std::string>().ends_with("in vain")) wait["bad"] = true;
    waits.push_back(wait);
  }
  return waits;
}

// The host then waits for a file, with the clock stopped.
TEST_F(HostTime, TellsWhatItWaitsForWhileItRuns) {
  const std::string gate = folder() / "gate";
  ASSERT_EQ(mkfifo(gate.c_str(), 0600), 0);
  const std::string socket = folder() / "control";
  const std::string recording = folder() / "recording";
  Process host({UNDERSTUDY_BINARY, "exec", bench(), "--host-time", "--control", socket, "--record", recording,
                "--", kPython, "-c", kAsker + ("print('asked', flush=True)\nopen('" + gate + "').read()\n")});
  ASSERT_TRUE(eventually([&] { return host.output() == "asked\n"; })) << host.errors();
  const Finished shown = understudy({"ctl", "--control", socket, "spans"});
  EXPECT_EQ(shown.exit_code, 0) << shown.errors;
  const auto lines = lines_of(shown.output);
  ASSERT_EQ(lines.size(), 4U) << shown.output;
  EXPECT_TRUE(lines[0].starts_with("0s host: waits for a reply, ")) << lines[0];
  EXPECT_TRUE(lines[1].ends_with(" host: sleeps, 2s")) << lines[1];
  EXPECT_TRUE(lines[2].ends_with(" host: waits for a reply in vain, 500ms")) << lines[2];
  EXPECT_TRUE(lines[3].ends_with(" host: waits for a reply in vain, 250ms")) << lines[3];
  const Finished part = understudy({"ctl", "--control", socket, "spans", "from=1s", "to=2s"});
  EXPECT_EQ(part.output, lines[1] + "\n") << part.errors;
  const Finished spans = understudy({"ctl", "--control", socket, "--json", "spans"});
  std::ofstream(gate) << "go on";
  EXPECT_EQ(host.wait(kPatience), 0) << host.errors();
  EXPECT_EQ(Json::parse(spans.output)["spans"], waits_in(recording));
}

}  // namespace host_time_test
}  // namespace understudy::acceptance
