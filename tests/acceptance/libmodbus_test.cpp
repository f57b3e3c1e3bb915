// libmodbus as the host, at both speeds of the device, with even parity and without.
#include <gtest/gtest.h>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace libmodbus_test {

using Clock = std::chrono::steady_clock;

class Libmodbus : public testing::TestWithParam<HostSetup> {
 protected:
  RunningUnderstudy daemon_{{"--baud", std::to_string(GetParam().baud)}};
};

TEST_P(Libmodbus, ReadsAndWrites) {
  ModbusHost host(daemon_.port(), GetParam());
  ASSERT_TRUE(host.connected());
  EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
  EXPECT_EQ(host.read_input(kHardwareCode), Registers{0xC001});
  EXPECT_TRUE(host.write(kAaxisSpeed, 200));
  EXPECT_TRUE(host.write(kAaxisPulse, Registers{0xFE0C, 0xFFFF}));  // -500
  EXPECT_EQ(host.read(kAaxisPulse, 3), (Registers{0xFE0C, 0xFFFF, 200}));
  EXPECT_EQ(host.read_input(kAaxisPulse, 3), (Registers{0xFE0C, 0xFFFF, 200}));
  EXPECT_EQ(host.read(0x1000, 30).size(), 30U);
  EXPECT_EQ(host.read(0x4000, 125).size(), 125U);
}

TEST_P(Libmodbus, GetsEachExceptionAndCarriesOn) {
  ModbusHost host(daemon_.port(), GetParam());
  struct Refused {
    const char* what;
    std::function<bool()> request;
    int error;
  };
  const std::vector<Refused> cases = {
      {"write a coil", [&] { return host.write_bit(0, true); }, EMBXILFUN},
      {"read a hole", [&] { return !host.read(kHole).empty(); }, EMBXILADD},
      {"read across a hole", [&] { return !host.read(0x0000, 6).empty(); }, EMBXILADD},
      {"read beyond the last address", [&] { return !host.read(0xFFFF, 2).empty(); }, EMBXILADD},
      {"write a read-only register", [&] { return host.write(kHardwareCode, 1); }, EMBXILADD},
      {"write AccTime 3001", [&] { return host.write(kAaxisAccTime, 3001); }, EMBXILVAL},
      {"write 3001 behind good values",
       [&] {
         return host.write(kAaxisPulse, Registers{1, 0, 2, 3001});
       },
       EMBXILVAL},
      {"read 0 registers",
       [&] {
         return host.request({1, 3, 0x10, 0, 0, 0});
       },
       EMBXILVAL},
      {"read 126 registers",
       [&] {
         return host.request({1, 3, 0x40, 0, 0, 126});
       },
       EMBXILVAL},
      {"write 2 registers with 3 bytes",
       [&] {
         return host.request({1, 0x10, 0x10, 0, 0, 2, 3, 0, 1, 0});
       },
       EMBXILVAL},
  };
  for (const Refused& refused : cases) {
    EXPECT_FALSE(refused.request()) << refused.what;
    EXPECT_EQ(host.error(), refused.error) << refused.what << ": " << modbus_strerror(host.error());
    EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001}) << "after: " << refused.what;
  }
  EXPECT_EQ(host.read(kAaxisPulse, 4), (Registers{0, 0, 0, 0})) << "a refused request changes nothing";
}

TEST_P(Libmodbus, ConnectsAndClosesFiftyTimes) {
  for (int time = 1; time <= 50; ++time) {
    ModbusHost host(daemon_.port(), GetParam());
    ASSERT_TRUE(host.connected()) << "time " << time << ": " << modbus_strerror(host.error());
    ASSERT_EQ(host.read(kHardwareCode), Registers{0xC001}) << "time " << time;
  }
  EXPECT_EQ(daemon_.requests(), 50);
  EXPECT_EQ(daemon_.errors(), "");
}

TEST_P(Libmodbus, RunsAMoveToItsEnd) {
  ModbusHost host(daemon_.port(), GetParam());
  EXPECT_TRUE(host.write(kAaxisSvon, 1));
  EXPECT_TRUE(host.write(kAaxisPulse, Registers{3200, 0, 600, 1, 1, 1}));  // pulses to Move_INC at once
  EXPECT_TRUE(host.is_moving());
  EXPECT_TRUE(eventually([&] { return !host.is_moving(); }));
  EXPECT_EQ(host.read_long(kCordA), 3200);
}

INSTANTIATE_TEST_SUITE_P(
    At, Libmodbus,
    testing::Values(HostSetup{.baud = 19200, .parity = 'E'}, HostSetup{.baud = 19200, .parity = 'N'},
                    HostSetup{.baud = 115200, .parity = 'E'}, HostSetup{.baud = 115200, .parity = 'N'}),
    [](const auto& parameter) {
      return std::to_string(parameter.param.baud) + "Baud8" + parameter.param.parity + "1";
    });

// The manual's worked example: 10 revolutions at 200 RPM take 3.05 s; a stopwatch confirmed it.
TEST(ManualsExample, Takes3050MillisecondsByTheHostsClock) {
  const RunningUnderstudy daemon;
  ModbusHost host(daemon.port());
  ASSERT_TRUE(host.write(kAaxisSvon, 1));
  ASSERT_TRUE(host.write(kAaxisPulse, Registers{32000, 0, 200, 5, 5}));
  ASSERT_TRUE(host.write(kAaxisMoveInc, 1));
  const auto started = Clock::now();
  EXPECT_TRUE(host.is_moving()) << "right after the reply";
  ASSERT_TRUE(eventually([&] { return !host.is_moving(); }));
  const auto taken = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - started);
  EXPECT_NEAR(static_cast<double>(taken.count()), 3050, 40);
  EXPECT_EQ(host.read_long(kCordA), 32000);
}

}  // namespace libmodbus_test
}  // namespace understudy::acceptance
