// Campaigns over host programs: exec SCENARIO -- COMMAND.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace host_campaign_test {

/// A host that moves an axis. It sends each request again if no answer comes, also the one that starts the
/// move. A careful one looks whether the axis moves first.
constexpr const char* kHost = R"(
import os, select, sys, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
settings = termios.tcgetattr(port)
settings[4] = settings[5] = termios.B19200
termios.tcsetattr(port, termios.TCSANOW, settings)
def crc(data):
    value = 0xFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0xA001 if value & 1 else 0)
    return value.to_bytes(2, "little")
def ask(text, size):
    request = bytes.fromhex("01" + text)
    os.write(port, request + crc(request))
    answer = b""
    while len(answer) < size and select.select([port], [], [], 0.2)[0]:
        answer += os.read(port, 100)
    return answer if len(answer) == size else None
def status():
    while True:
        answer = ask("0300000001", 7)
        if answer:
            return int.from_bytes(answer[3:5], "big")
def put(register, value):
    while not ask(f"06{register:04X}{value:04X}", 8):
        if register == 0x1005 and sys.argv[1] == "careful" and status() & 16:
            return
put(0x1014, 1)
put(0x1002, int(os.environ.get("SPEED", "200")))
put(0x1000, int(sys.argv[2]))
put(0x1005, 1)
while status() & 16:
    time.sleep(0.02)
print("moved", sys.argv[2])
)";

constexpr const char* kHead =
    "understudy: 1\nname: a move\n"
    "bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n";

class HostCampaign : public testing::Test {
 protected:
  Finished exec(const std::string& rest, const Words& command, const Words& flags = {"--host-time"}) {
    scenario_ = folder_.write("campaign.yaml", kHead + rest);
    Words words{"exec", scenario_};
    words.insert(words.end(), flags.begin(), flags.end());
    words.emplace_back("--");
    words.insert(words.end(), command.begin(), command.end());
    return understudy(words);
  }
  Words host(const std::string& kind, const std::string& pulses = "${pulses}") const {
    return {"/usr/bin/python3", folder_.write("host.py", kHost), kind, pulses};
  }
  std::string text_of(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Returns how long the only case in rows.jsonl took.
  double simulated_s() const {
    const std::string text = text_of("rows.jsonl");
    const std::string key = "\"simulated_s\":";
    const std::size_t at = text.find(key);
    return at == std::string::npos ? -1 : std::stod(text.substr(at + key.size()));
  }
  const PrivateFolder& folder() const { return folder_; }

 private:
  PrivateFolder folder_;
  std::string scenario_;
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

constexpr const char* kLostReplies =
    "vary:\n"
    "  pulses: [ 3200, 6400 ]\n"
    "  nth: { from: 1, to: 5, step: 1 }\n"
    "steps:\n"
    "  - inject: { drop: feeder, nth: \"${nth}\" }\n"
    "  - host: { exits: 0, within: 60s }\n"
    "  - assert: feeder.A.pulses == ${pulses}\n";

TEST_F(HostCampaign, FindsAMoveThatIsMadeTwice) {
  // The fourth request starts the move. If its answer is lost, the host sends it again.
  const Finished naive =
      exec(kLostReplies, host("naive"), {"--host-time", "--seed", "3", "--failures", folder() / "found"});
  EXPECT_EQ(naive.exit_code, 1) << naive.errors;
  EXPECT_TRUE(has(naive.output, "(pulses=3200, nth=4)")) << naive.output;
  EXPECT_TRUE(has(naive.output, "feeder.A.pulses is ")) << naive.output;
  EXPECT_TRUE(has(naive.output, "also:     the command printed: moved 3200")) << naive.output;
  EXPECT_TRUE(has(naive.output, "2 failed in the same way")) << naive.output;
  EXPECT_TRUE(has(naive.output, "8 passed, 2 failed")) << naive.output;
  EXPECT_TRUE(has(naive.output, "to run this case alone: understudy exec ")) << naive.output;
  EXPECT_TRUE(has(naive.output, " --host-time --seed 3 --filter ")) << naive.output;
  EXPECT_TRUE(has(naive.output, " naive '${pulses}'\n")) << naive.output;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder() / "found"), {}), 1);
  EXPECT_EQ(exec(kLostReplies, host("careful")).exit_code, 0);
}

TEST_F(HostCampaign, HasTheSameRowsWithAnyNumberOfJobs) {
  const std::string spin = "while :; do :; done";
  const Process load({"sh", "-c", spin});
  for (const char* const jobs : {"1", "3"}) {
    const std::string rows = folder() / ("rows" + std::string(jobs) + ".jsonl");
    exec(kLostReplies, host("naive"),
         {"--host-time", "--jobs", jobs, "--results", rows, "--failures", folder() / "found"});
  }
  EXPECT_EQ(std::ranges::count(text_of("rows1.jsonl"), '\n'), 10);
  EXPECT_EQ(text_of("rows1.jsonl"), text_of("rows3.jsonl"));
  EXPECT_TRUE(has(text_of("rows1.jsonl"), R"("parameters":{"pulses":3200,"nth":4},"verdict":"failed")"));
}

TEST_F(HostCampaign, SkipsCasesThatRanBefore) {
  const std::string rows = folder() / "rows.jsonl";
  const Words flags{"--host-time", "--results", rows, "--resume"};
  EXPECT_EQ(exec(kLostReplies, host("careful"), flags).exit_code, 0);
  const Finished again = exec(kLostReplies, host("careful"), flags);
  EXPECT_TRUE(has(again.output, "10 skipped, because they ran earlier")) << again.output;
  // Another command makes other results.
  const Finished other = exec(kLostReplies, host("naive"), flags);
  EXPECT_TRUE(has(other.output, "8 passed, 2 failed")) << other.output;
}

TEST_F(HostCampaign, PlaysCasesAgainIfTheHostHasChanged) {
  const std::string rest =
      "vary: { case: [ 1, 2 ] }\nsteps: [ { host: { exits: 0, within: 6s } }, { say: \"${case}\" } ]\n";
  const Words flags{"--host-time", "--results", folder() / "changed.jsonl", "--resume"};
  const Words command{"sh", folder().write("host.sh", "exit 0\n")};
  EXPECT_EQ(exec(rest, command, flags).exit_code, 0);
  EXPECT_TRUE(has(exec(rest, command, flags).output, "2 skipped, because they ran earlier"));
  folder().write("host.sh", "exit 1\n");
  const Finished changed = exec(rest, command, flags);
  EXPECT_EQ(changed.exit_code, 1);
  EXPECT_TRUE(has(changed.output, "2 failed")) << changed.output;
}

TEST_F(HostCampaign, DistinguishesAHostThatHangsFromOneThatFails) {
  const std::string rest = "steps: [ { host: { exits: 0, within: 60s } } ]\n";
  const Finished spins = exec(rest, {"sh", "-c", "while :; do :; done"}, {"--host-time", "--timeout", "1s"});
  EXPECT_EQ(spins.exit_code, 1);
  EXPECT_TRUE(has(spins.output, "the command was stopped because it took longer than 1s")) << spins.output;
}

TEST_F(HostCampaign, PutsValuesIntoTheEnvironment) {
  const Finished finished = exec(
      "parameters: { limit: 250 }\n"
      "vary: { speed: [ 200, 300 ] }\n"
      "environment: { SPEED: \"${speed}\", LIMIT: \"${limit * 2}\" }\n"
      "steps:\n"
      "  - never: feeder.Aaxis_Speed == 300\n"
      "  - wait: { until: feeder.A.pulses == 3200, within: 60s }\n",
      {"sh", "-c", "test $LIMIT = 500 && exec /usr/bin/python3 " + host("naive")[1] + " naive 3200"});
  EXPECT_TRUE(has(finished.output, "FAIL  ")) << finished.output;
  EXPECT_TRUE(has(finished.output, "(speed=300)")) << finished.output;
  EXPECT_TRUE(has(finished.output, "1 passed, 1 failed")) << finished.output << finished.errors;
}

TEST_F(HostCampaign, JudgesTheEndOfTheCommand) {
  struct Row {
    const char* steps;
    Words command;
    const char* message;  // empty: it passes
  };
  const std::string forever = "while :; do sleep 1; done";
  const std::vector<Row> rows{
      {"- say: nothing", {"true"}, ""},
      {"- say: nothing",
       {"sh", "-c", "echo lost >&2; exit 3"},
       "the command ended with exit code 3; expected 0"},
      {"- say: nothing", {"sh", "-c", "echo lost >&2; exit 3"}, "also:     the command printed: lost"},
      {"- host: { exits: 3, within: 5s }", {"sh", "-c", "sleep 4; exit 3"}, ""},
      {"- host: { within: 5s }",
       {"sh", "-c", "sleep 4; exit 3"},
       "the command ended with exit code 3; expected 0"},
      {"- host: { within: 5s }", {"sh", "-c", forever}, "the command did not end within 5s"},
      {"- advance: 20s\n  - host: stop", {"sh", "-c", forever}, ""},
      {"- host: stop\n  - advance: 10s\n  - assert: feeder.STATUS.4 == 1",
       {"sh", "-c", forever},
       "'feeder.STATUS.4 == 1' does not hold"},
      {"- assert: feeder.STATUS.4 == 1", {"sh", "-c", forever}, "'feeder.STATUS.4 == 1' does not hold"},
      {"- advance: 1ms",
       {"/usr/bin/python3", "-c", "while True: pass"},
       "the command was stopped because it took longer than 2s"},
  };
  for (const Row& row : rows) {
    const bool is_late = std::string(row.message).ends_with("longer than 2s");
    const Finished finished = exec("steps:\n  " + std::string(row.steps) + "\n", row.command,
                                   {"--host-time", "--timeout", is_late ? "2s" : "60s"});
    EXPECT_EQ(finished.exit_code, *row.message == '\0' ? 0 : 1)
        << row.steps << finished.output << finished.errors;
    EXPECT_TRUE(has(finished.output, row.message)) << row.steps << finished.output;
  }
}

// The host waits for long, and reacts to the signal before time advances.
TEST_F(HostCampaign, StopsAHostInTheMiddleOfItsWait) {
  const std::string handler = "import signal, sys, threading, time\n";
  const std::string reacts =
      "def stop(*_):\n  time.sleep(3)\n  sys.exit(0)\nsignal.signal(signal.SIGTERM, stop)\n";
  const std::string threads =
      "threading.Thread(target=time.sleep, args=[3600], daemon=True).start()\nthreading.Event().wait(3600)\n";
  struct Row {
    Words command;
    double simulated_s;
  };
  const std::vector<Row> rows{
      {{"sleep", "36000"}, 20.001},
      {{"sh", "-c", "sleep 36000 & sleep 3600; :"}, 20.001},
      {{"/usr/bin/python3", "-c", handler + reacts + "time.sleep(3600)\n"}, 23.001},
      {{"/usr/bin/python3", "-c", handler + reacts + threads}, 23.001},
      {{"sh", "-c", "trap 'sleep 4; exit 1' TERM; while :; do sleep 3600; done"}, 24.001},
      {{"sleep", "5"}, 20.0},
  };
  for (const Row& row : rows) {
    std::filesystem::remove(folder() / "rows.jsonl");
    const Finished finished = exec("steps: [ advance: 20s, host: stop ]\n", row.command,
                                   {"--host-time", "--results", folder() / "rows.jsonl"});
    EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
    EXPECT_NEAR(simulated_s(), row.simulated_s, 1e-6) << testing::PrintToString(row.command);
  }
}

// Nothing waits for the end of the command, but the case has not ended before that.
TEST_F(HostCampaign, ChecksConditionsUntilTheCommandHasEnded) {
  struct Row {
    const char* steps;
    const char* parameters;
    const char* message;  // empty: it passes
    double simulated_s;
  };
  const std::string sleeps = "sleep ${seconds}";
  const std::vector<Row> rows{
      {"- never: time > 2s\n  - advance: 1s", "5", "never 'time > 2s'", 2.001},
      {"- always: time < 2s\n  - say: nothing", "5", "always 'time < 2s'", 2.0},
      {"- never: time > 6s\n  - advance: 1s", "5.0005", "", 5.0005},
      {"- never: time > 6s\n  - advance: 7s", "5", "never 'time > 6s'", 6.001},
      {"- never: { what: time > 2s, name: early }\n  - advance: 1s\n  - end: early", "5", "", 5.0},
      {"- say: nothing", "3.25", "", 3.25},
      {"- never: time > 2s\n  - host: { within: 10s }", "5", "never 'time > 2s'", 2.001},
      {"- host: { within: 10s }\n  - never: time > 6s\n  - advance: 2s", "5", "never 'time > 6s'", 6.001},
  };
  for (const Row& row : rows) {
    std::filesystem::remove(folder() / "rows.jsonl");
    const Finished finished =
        exec("vary: { seconds: [ " + std::string(row.parameters) + " ] }\nsteps:\n  " + row.steps + "\n",
             {"sh", "-c", sleeps}, {"--host-time", "--results", folder() / "rows.jsonl"});
    EXPECT_EQ(finished.exit_code, *row.message == '\0' ? 0 : 1)
        << row.steps << finished.output << finished.errors;
    EXPECT_TRUE(has(finished.output, row.message)) << row.steps << finished.output;
    EXPECT_NEAR(simulated_s(), row.simulated_s, 1e-6) << row.steps << text_of("rows.jsonl");
  }
}

// The condition is also that of a scenario beside a host.
TEST_F(HostCampaign, ChecksConditionsBesideAHostUntilItHasEnded) {
  const std::string bench = folder().write(
      "bench.yaml",
      "understudy: 1\nlines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n");
  const std::string beside = folder().write(
      "beside.yaml", "understudy: 1\nname: beside\nbench: bench.yaml\nsteps: [ { never: time > 2s } ]\n");
  for (const char* const seconds : {"1", "3"}) {
    const Finished finished =
        understudy({"exec", bench, "--host-time", "--with", beside, "--", "sleep", seconds});
    const bool is_broken = std::string(seconds) == "3";
    EXPECT_EQ(finished.exit_code, is_broken ? 1 : 0) << finished.errors;
    EXPECT_EQ(has(finished.errors, "never 'time > 2s'"), is_broken) << finished.errors;
  }
}

TEST_F(HostCampaign, HuntsForWhatHappensAfterTheLastStep) {
  const std::string hunted =
      folder().write("hunted.yaml", std::string(kHead) +
                                        "steps: [ advance: 1ms ]\n"
                                        "hunt:\n"
                                        "  may: [ inject: { slow: feeder, by: { between: [ 1ms, 5ms ] } } ]\n"
                                        "  never: feeder.A.pulses > 50\n");
  const Words host = this->host("careful", "3200");
  const Finished finished = understudy({"hunt", hunted, "--courses", "3", "--found", folder() / "found", "--",
                                        host[0], host[1], host[2], host[3]});
  EXPECT_EQ(finished.exit_code, 1) << finished.output << finished.errors;
  EXPECT_TRUE(has(finished.output, "never 'feeder.A.pulses > 50'")) << finished.output;
}

TEST_F(HostCampaign, SaysNothingAboutThePortsOfItsCases) {
  const Finished finished =
      exec("vary: { at: [ 10ms, 20ms ] }\nsteps:\n  - inject: { unplug: rs485, at: \"${at}\", for: 10ms }\n",
           {"sleep", "1"});
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  EXPECT_EQ(finished.errors, "");
}

TEST_F(HostCampaign, RunsInRealTimeToo) {
  const Finished finished =
      exec("vary: { seconds: [ 0.1, 0.2 ] }\nsteps:\n  - advance: 50ms\n  - host: { within: 30s }\n",
           {"sleep", "${seconds}"}, {});
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  EXPECT_TRUE(has(finished.output, "2 passed")) << finished.output;
}

TEST_F(HostCampaign, RefusesWhatDoesNotFit) {
  const std::string nothing = "steps:\n  - say: nothing\n";
  struct Row {
    std::string rest;
    Words command;
    Words flags;
    int exit_code;
    const char* message;
  };
  const std::vector<Row> rows{
      {"steps:\n  - write: { feeder.Aaxis_SVON: 1 }\n",
       {"true"},
       {},
       2,
       "campaign.yaml:5: write feeder.Aaxis_SVON=1: uses a line, which belongs to the host program"},
      {nothing, {"echo", "${speed}"}, {}, 2, "the command's '${speed}': "},
      {nothing, {"no-such-program"}, {}, 127, "exec: no-such-program: cannot be started; expected a program"},
      {nothing,
       {"true"},
       {"--with", "x.yaml"},
       2,
       "exec: --with: cannot be used with the cases of a scenario"},
      {nothing, {"true"}, {"--nv", "."}, 2, "exec: --nv: cannot be used with the cases of a scenario"},
      {nothing, {"true"}, {"--timeout", "soon"}, 2, "--timeout: 'soon' is not a duration"},
      {nothing, {"true"}, {"--hash"}, 2, "--hash: no two runs in real time are the same"},
  };
  for (const Row& row : rows) {
    const Finished finished = exec(row.rest, row.command, row.flags);
    EXPECT_EQ(finished.exit_code, row.exit_code) << row.message << finished.errors;
    EXPECT_TRUE(has(finished.errors, row.message)) << row.message << finished.errors;
  }
  const std::string bench = folder().write(
      "bench.yaml",
      "understudy: 1\nlines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n");
  const Finished of_bench = understudy({"exec", bench, "--jobs", "2", "--", "true"});
  EXPECT_EQ(of_bench.exit_code, 2);
  EXPECT_TRUE(has(of_bench.errors, "exec: --jobs: applies only to the cases of a scenario"))
      << of_bench.errors;
  exec("steps:\n  - host: stop\n", {"true"});
  const Finished run = understudy({"run", folder() / "campaign.yaml"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(
      has(run.errors,
          "campaign.yaml:5: host stop: no command runs alongside this scenario; expected `understudy exec "))
      << run.errors;
}

}  // namespace host_campaign_test
}  // namespace understudy::acceptance
