// A real host, libmodbus on a real pty, with faults on its line from `understudy ctl` and from a bench.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace wire_faults_test {

using Json = nlohmann::json;
using namespace std::chrono_literals;

std::string obeyed(const RunningUnderstudy& daemon, const Words& words) {
  const Finished finished = daemon.ctl(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  return finished.output;
}

const Registers kCode{0xC001};
Registers ask_code(ModbusHost& host) { return host.read(kHardwareCode); }

TEST(WireFaults, ADroppedReplyIsATimeoutOfTheHostAndTheNextOneComes) {
  const RunningUnderstudy daemon;
  ModbusHost host(daemon.port());
  EXPECT_EQ(obeyed(daemon, {"inject", "drop", "device", "function=3", "nth=2"}), "fault 1\n");
  EXPECT_EQ(host.read(kHardwareCode), kCode);
  EXPECT_TRUE(host.write(kAaxisSpeed, 200)) << "another function";
  EXPECT_TRUE(host.in_vain(ask_code).empty());
  EXPECT_EQ(host.error(), ETIMEDOUT);
  EXPECT_EQ(host.read(kHardwareCode), kCode);
  EXPECT_EQ(obeyed(daemon, {"list"}), "1 drop device function=3 nth=2: seen 4, matched 3, hit 1\n");
}

TEST(WireFaults, ADroppedRequestIsNotCarriedOut) {
  const RunningUnderstudy daemon;
  ModbusHost host(daemon.port());
  obeyed(daemon, {"inject", "drop", "line", "of=request", "address=Aaxis_Speed"});
  EXPECT_FALSE(host.in_vain([](ModbusHost& asked) { return asked.write(kAaxisSpeed, 200); }));
  EXPECT_EQ(host.error(), ETIMEDOUT);
  obeyed(daemon, {"clear", "all"});
  EXPECT_EQ(host.read(kAaxisSpeed), Registers{0});
}

TEST(WireFaults, AWrongChecksumIsOneForTheHost) {
  const RunningUnderstudy daemon;
  ModbusHost host(daemon.port());
  obeyed(daemon, {"inject", "corrupt_checksum", "device", "times=1"});
  EXPECT_TRUE(host.read(kHardwareCode).empty());
  EXPECT_EQ(host.error(), EMBBADCRC);
  EXPECT_EQ(host.read(kHardwareCode), kCode);
}

TEST(WireFaults, ADelayIsATimeoutOrNotByTheHostsPatience) {
  const RunningUnderstudy daemon;
  obeyed(daemon, {"inject", "delay", "device", "by=400ms", "times=2"});
  ModbusHost host(daemon.port(), {.patience = 2000ms});
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(host.read(kHardwareCode), kCode);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 400ms);
  host.set_patience(100ms);
  EXPECT_TRUE(host.read(kHardwareCode).empty());
  EXPECT_EQ(host.error(), ETIMEDOUT);
}

TEST(WireFaults, ExceptionsAreWhatTheHostCallsThem) {
  const RunningUnderstudy daemon;
  ModbusHost host(daemon.port());
  obeyed(daemon, {"inject", "exception", "device", "code=4", "nth=1"});
  obeyed(daemon, {"inject", "busy", "device", "function=6", "times=2"});
  EXPECT_TRUE(host.read(kHardwareCode).empty());
  EXPECT_EQ(host.error(), EMBXSFAIL);
  for (int i = 0; i < 2; ++i) {
    EXPECT_FALSE(host.write(kAaxisSpeed, 200));
    EXPECT_EQ(host.error(), EMBXSBUSY);
  }
  EXPECT_EQ(host.read(kAaxisSpeed), Registers{0});
  EXPECT_TRUE(host.write(kAaxisSpeed, 200));
  EXPECT_EQ(host.read(kAaxisSpeed), Registers{200});
}

TEST(WireFaults, OfABenchReachTheBytesOnThePty) {
  const auto daemon = RunningUnderstudy::of_bench(
      "understudy: 1\n"
      "lines:\n"
      "  line:\n"
      "    link: ./port\n"
      "    stations: [ { name: feeder, model: simple2-r3, address: 1 } ]\n"
      "faults:\n"
      "  - { truncate: feeder, keep: 3, nth: 1 }\n"
      "  - { noise: feeder, before: FF 00, after: 55, nth: 2 }\n"
      "  - { duplicate: line, after: 50ms, nth: 3 }\n"
      "  - { collision: line, with: 00 FF, nth: 4 }\n");
  Host host(daemon->port());
  EXPECT_EQ(exchange(host, kReadHardwareCode, 3), pty::hex("01 03 02"));
  EXPECT_TRUE(is_silent(host));
  EXPECT_EQ(exchange(host, kReadHardwareCode, 10), pty::hex("FF 00 01 03 02 C0 01 29 84 55"));
  EXPECT_EQ(exchange(host, kReadHardwareCode, 14), pty::hex("01 03 02 C0 01 29 84 01 03 02 C0 01 29 84"));
  EXPECT_EQ(exchange(host, kReadHardwareCode, 7), pty::hex("00 03 02 C0 01 29 84"));
  EXPECT_EQ(exchange(host, kReadHardwareCode, 7), kHardwareCodeReply);
  const Json faults = Json::parse(obeyed(*daemon, {"--json", "list"}))["faults"];
  for (const Json& fault : faults) {
    EXPECT_EQ(fault["hits"], 1) << fault;
    EXPECT_EQ(fault["seen"], 5) << fault;
  }
}

TEST(WireFaults, AConditionOfTheMachineDecidesWhichReplyIsLost) {
  const RunningUnderstudy daemon;
  ModbusHost host(daemon.port());
  obeyed(daemon, {"inject", "drop", "device", "when=device.A.pulses > 12000", "times=1"});
  EXPECT_TRUE(host.write(kAaxisSvon, 1));
  EXPECT_TRUE(host.write(kAaxisPulse, Registers{0x7D00, 0, 200, 5, 5}));
  EXPECT_TRUE(host.write(kAaxisMoveInc, 1));
  int answered = 0;
  const auto coordinate = [](ModbusHost& asked) { return asked.read(kCordA, 2); };
  while (!host.in_vain(coordinate, 2'000ms).empty() && answered < 10'000) ++answered;
  EXPECT_EQ(host.error(), ETIMEDOUT);
  EXPECT_GT(answered, 0);
  EXPECT_GT(host.read_long(kCordA), 12'000);
}

TEST(WireFaults, ThatAreWrongAreRefusedWithOneLine) {
  const RunningUnderstudy daemon;
  const auto refused = [&](const Words& words) {
    const Finished finished = daemon.ctl(words);
    EXPECT_EQ(finished.exit_code, 2);
    return finished.errors;
  };
  EXPECT_EQ(refused({"inject", "dorp", "device"}),
            "understudy: ctl inject: 'dorp' is not a fault; the nearest is 'drop'\n");
  EXPECT_EQ(refused({"inject", "drop", "device", "nht=3"}),
            "understudy: ctl inject: drop: nht: is not a field here; the nearest is 'nth'\n");
  EXPECT_EQ(refused({"inject", "drop", "device", "when=device.A.puls > 3"}),
            "understudy: ctl inject: drop: when: column 1 of 'device.A.puls > 3': axis A has no 'puls'; the "
            "nearest "
            "is 'pulses'\n");
  EXPECT_EQ(refused({"inject", "drop", "device", "nth=3", "nth=4"}),
            "understudy: ctl inject: 'nth' is given twice; expected it only once\n");
  EXPECT_EQ(obeyed(daemon, {"list"}), "");
}

}  // namespace wire_faults_test
}  // namespace understudy::acceptance
