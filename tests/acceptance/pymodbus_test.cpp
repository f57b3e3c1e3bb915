// pymodbus as the host, at 8N1: the programs are in hosts/pymodbus_host.py. What they write is also checked
// through the control socket.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace pymodbus_test {

// Debian's packages belong to this interpreter; another one earlier in PATH does not find them.
constexpr const char* kPython = "/usr/bin/python3";
constexpr const char* kPackages = "/usr/lib/python3/dist-packages";

class Pymodbus : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    const std::filesystem::path packages = kPackages;
    for (const auto& [module, package] :
         {std::pair{"pymodbus", "python3-pymodbus"}, std::pair{"serial_asyncio", "python3-serial-asyncio"}}) {
      if (!std::filesystem::exists(packages / module)) GTEST_SKIP() << package << " is not installed";
    }
  }

  static std::string baud() { return std::to_string(GetParam()); }

  /// Runs the case with `daemon`, which must receive it without a warning.
  static void expect_well(const RunningUnderstudy& daemon, const std::string& name) {
    const Finished finished =
        run({kPython, std::string(TEST_FACTS) + "/hosts/pymodbus_host.py", daemon.port(), baud(), name});
    EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
    EXPECT_EQ(daemon.errors(), "");
  }
};

TEST_P(Pymodbus, ReadsAndWritesEveryType) {
  const RunningUnderstudy daemon({"--baud", baud()});
  expect_well(daemon, "types");
  // DOUT_ALL 55 hex, then DOUT_1 set: 57 hex, which is 87.
  EXPECT_EQ(daemon.ctl({"get", "Aaxis_Pulse", "Aaxis_Speed", "Aaxis_Resoultion", "DOUT_ALL"}).output,
            "Aaxis_Pulse -500\nAaxis_Speed 200\nAaxis_Resoultion 3200\nDOUT_ALL 87\n");
}

TEST_P(Pymodbus, SeesEachRefusalAsAnException) {
  const RunningUnderstudy daemon({"--baud", baud()});
  expect_well(daemon, "exceptions");
  // 2 reads of 0x1000 to 0x101D, and for each of 19 cases one refused request and one read of HW_Code.
  EXPECT_EQ(daemon.requests(), 2 + 2 * 19);
}

TEST_P(Pymodbus, RunsPollsAndStopsMoves) {
  const RunningUnderstudy daemon({"--baud", baud()});
  expect_well(daemon, "motion");
  EXPECT_EQ(daemon.ctl({"get", "Cord_B"}).output, "Cord_B -1600\n");
}

TEST_P(Pymodbus, ComesAndGoes) {
  const RunningUnderstudy daemon({"--baud", baud()});
  expect_well(daemon, "reopening");
  EXPECT_EQ(daemon.ctl({"set", "Aaxis_Speed=0"}).exit_code, 0);
  expect_well(daemon, "reopening");  // another process, not only another client
  EXPECT_EQ(daemon.requests(), 2 * (20 * 2 + 5));
}

TEST_P(Pymodbus, OpensWithEvenParityWhereItIsNotStrict) {
  const RunningUnderstudy daemon({"--baud", baud()});
  expect_well(daemon, "even_parity");
}

TEST_P(Pymodbus, SendsWithoutAPauseFromAsyncio) {
  const RunningUnderstudy daemon({"--baud", baud()});
  expect_well(daemon, "asynchronous");
  EXPECT_EQ(daemon.requests(), 3 * (20 * 2 + 1));
}

TEST_P(Pymodbus, BroadcastsToEveryStationWithoutWaiting) {
  std::string stations;
  for (const char* address : {"1", "2", "3"})
    stations +=
        std::string("      - { name: s") + address + ", model: simple2-r3, address: " + address + " }\n";
  const auto daemon = RunningUnderstudy::of_bench("understudy: 1\nlines:\n  rs485:\n    baud: " + baud() +
                                                  "\n    stations:\n" + stations);
  expect_well(*daemon, "broadcast");
  EXPECT_EQ(daemon->ctl({"get", "s1.Aaxis_Pulse", "s2.Aaxis_Pulse", "s3.Aaxis_Pulse"}).output,
            "s1.Aaxis_Pulse -500\ns2.Aaxis_Pulse -500\ns3.Aaxis_Pulse -500\n");
}

INSTANTIATE_TEST_SUITE_P(At, Pymodbus, testing::Values(19200, 115200),
                         [](const auto& parameter) { return std::to_string(parameter.param) + "Baud8N1"; });

}  // namespace pymodbus_test
}  // namespace understudy::acceptance
