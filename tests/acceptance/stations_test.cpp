// Which stations answer on a line: addresses, broadcast, rotary switch 0, several stations.
#include <gtest/gtest.h>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace stations_test {

constexpr std::chrono::milliseconds kSilence{150};  // no reply takes this long on these lines

TEST(Broadcast, IsAppliedWithoutAReply) {
  const RunningUnderstudy daemon;
  ModbusHost host(daemon.port(), {.station = 0, .patience = kSilence});
  EXPECT_FALSE(host.write(kAaxisSpeed, 123));
  EXPECT_EQ(host.error(), ETIMEDOUT);
  host.set_station(1);
  host.set_patience(kPatience);
  EXPECT_EQ(host.read(kAaxisSpeed), Registers{123});
}

TEST(RotarySwitch, AtZeroAnswersAnyAddress) {
  const RunningUnderstudy daemon({"--station", "0"});
  ModbusHost host(daemon.port());
  for (const int station : {1, 7, 15, 247}) {
    host.set_station(station);
    EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001}) << "station " << station;
  }
}

TEST(RotarySwitch, AtSevenAnswersSevenAlone) {
  const RunningUnderstudy daemon({"--station", "7"});
  ModbusHost host(daemon.port(), {.station = 1, .patience = kSilence});
  EXPECT_TRUE(host.read(kHardwareCode).empty());
  EXPECT_EQ(host.error(), ETIMEDOUT);
  host.set_station(7);
  host.set_patience(kPatience);
  EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
}

constexpr const char* kTwoStations = R"(understudy: 1
lines:
  rs485:
    link: ./shared.port
    stations:
      - { name: feeder, model: simple2-r3, address: 1 }
      - { name: turner, model: simple2-r3, address: 2 }
)";

TEST(TwoStations, ShareALineAndKeepTheirRegisters) {
  const auto daemon = RunningUnderstudy::of_bench(kTwoStations);
  EXPECT_EQ(daemon->ports().size(), 1U);
  EXPECT_EQ(daemon->ports()[0].line, "rs485");
  EXPECT_EQ(daemon->port(), daemon->folder() / "shared.port");
  ModbusHost host(daemon->port());
  for (int round = 1; round <= 5; ++round) {
    for (const int station : {1, 2}) {
      host.set_station(station);
      EXPECT_TRUE(host.write(kAaxisSpeed, 100 * station + round)) << modbus_strerror(host.error());
    }
    for (const int station : {1, 2}) {
      host.set_station(station);
      EXPECT_EQ(host.read(kAaxisSpeed), Registers{static_cast<std::uint16_t>(100 * station + round)});
    }
  }
}

TEST(TwoStations, BothHearABroadcast) {
  const auto daemon = RunningUnderstudy::of_bench(kTwoStations);
  ModbusHost host(daemon->port(), {.station = 0, .patience = kSilence});
  EXPECT_FALSE(host.write(kAaxisSpeed, 321));
  host.set_patience(kPatience);
  for (const int station : {1, 2}) {
    host.set_station(station);
    EXPECT_EQ(host.read(kAaxisSpeed), Registers{321}) << "station " << station;
  }
}

TEST(TwoStations, LeaveAnAbsentOneToItsTimeout) {
  const auto daemon = RunningUnderstudy::of_bench(kTwoStations);
  ModbusHost host(daemon->port(), {.station = 3, .patience = kSilence});
  EXPECT_TRUE(host.read(kHardwareCode).empty());
  EXPECT_EQ(host.error(), ETIMEDOUT);
  host.set_station(2);
  host.set_patience(kPatience);
  EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
}

TEST(TwoLines, AreTwoPorts) {
  const auto daemon = RunningUnderstudy::of_bench(R"(understudy: 1
lines:
  left: { link: left.port, stations: [ { name: a, model: simple2-r3 } ] }
  right: { link: right.port, baud: 115200, stations: [ { name: b, model: simple2-r3 } ] }
)");
  ASSERT_EQ(daemon->ports().size(), 2U);
  EXPECT_EQ(daemon->ports()[1].line, "right");
  ModbusHost left(daemon->ports()[0].link);
  ModbusHost right(daemon->ports()[1].link, {.baud = 115200});
  EXPECT_TRUE(left.write(kAaxisSpeed, 1));
  EXPECT_TRUE(right.write(kAaxisSpeed, 2));
  EXPECT_EQ(left.read(kAaxisSpeed), Registers{1});
  EXPECT_EQ(right.read(kAaxisSpeed), Registers{2});
}

}  // namespace stations_test
}  // namespace understudy::acceptance
